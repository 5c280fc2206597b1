"""A reduced flexible body: all that is needed to put it into Exudyn and to draw it. Plain arrays.

The body frame is the frame of the geometry. Its modes are mass-normalised and orthogonal to the
six rigid motions (mean-axis frame), so that mass, stiffness and damping matrices are diagonal.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_models.arrays import Array
from fe_models.errors import InputError
from fe_models.part import MOTIONS

__all__ = ["ReducedInterface", "ReducedPart"]


@dataclass(frozen=True)
class ReducedInterface:
    """The mean motion of an interface in modal coordinates q: translation @ q, rotation @ q."""

    face: str
    centre: Array  # (3,) m, undeformed, in the body frame
    axis: Array  # (3,) m, on the axis of a cylinder along z, a sphere's centre; else the centre
    area: float  # m^2
    arm: float  # m, size of the virtual nodes' triangle
    translation: Array  # (3, modes)
    rotation: Array  # (3, modes) rad per unit of q

    def virtual_nodes(self) -> tuple[Array, Array]:
        """Return three points (3, 3) around the centre, and their modes (9, modes).

        Moving rigidly with the mean motion, they stand for the whole face. They are the ends of
        the three axes, moved so that the centre is in their middle; fewer could not show a turn.
        """
        arms = self.arm * (np.eye(3) - 1.0 / 3.0)
        turned = np.cross(self.rotation.T[None, :, :], arms[:, None, :])  # theta x arm
        modes = (self.translation.T[None, :, :] + turned).transpose(0, 2, 1)
        return self.centre + arms, modes.reshape(9, self.translation.shape[1])

    def moved_point(self, point: Sequence[float]) -> tuple[Array, Array]:
        """Return a point (1, 3) that moves rigidly with the mean motion, and its modes (3, n)."""
        arm = np.asarray(point, dtype=float) - self.centre
        turned = np.cross(self.rotation.T, arm).T
        return np.asarray(point, dtype=float)[None, :], self.translation + turned


@dataclass(frozen=True)
class ReducedPart:
    """A part with n modes. Lengths m, masses kg; the modal coordinates q carry sqrt(kg) m.

    nodes, triangles, modes and stress hold the surface only, for pictures and stresses: rows of
    `modes` are x0 y0 z0 x1 ...; rows of `stress` the six components xx yy zz yz xz xy of each node.
    `couplings` are the constant terms of the floating frame, by Exudyn's names.
    """

    name: str
    method: str
    mass: float
    centre_of_mass: Array  # (3,)
    inertia: Array  # (3, 3) kg m^2, about the frame's origin
    frequencies: Array  # (n,) Hz, of the free reduced body
    fixed_interface_frequencies: Array  # Hz, interfaces held in their mean motion
    nodes: Array  # (s, 3)
    triangles: NDArray[np.int64]  # (t, 3)
    modes: Array  # (3 s, n)
    stress: Array  # (6 s, n) Pa per unit of q; empty rows if not computed
    mass_matrix: Array  # (n, n)
    stiffness_matrix: Array  # (n, n)
    flexibility: Array  # (m,) of every loaded motion, exact, m/N or 1/(N m); empty without modes
    couplings: Mapping[str, Array]
    interfaces: tuple[ReducedInterface, ...]
    meta: Mapping[str, Any] = field(default_factory=dict)

    @property
    def mode_count(self) -> int:
        """Return n, the number of modal coordinates."""
        return len(self.frequencies)

    def interface(self, face: str) -> ReducedInterface:
        """Return an interface by the name of its face.

        Raises:
            InputError: there is none of that name.
        """
        for interface in self.interfaces:
            if interface.face == face:
                return interface
        raise InputError(
            f"{self.name}: no interface {face!r}; it has "
            + ", ".join(repr(interface.face) for interface in self.interfaces)
        )

    def participation(self) -> Array:
        """Return each mode's share (m, n) of the static flexibility of each loaded motion.

        The motions are those of meta["motions"], (face, motion). What a row lacks to 1 is left out.
        """
        motions = {
            (interface.face, motion): row
            for interface in self.interfaces
            for motion, row in zip(
                MOTIONS, (*interface.translation, *interface.rotation), strict=True
            )
        }
        moved = np.array([motions[face, motion] for face, motion in self.meta["motions"]])
        omega = 2.0 * np.pi * self.frequencies
        return np.asarray((moved / omega) ** 2 / self.flexibility[:, None])

    def damping_matrix(self, ratio: float) -> Array:
        """Return the matrix (n, n), 1/s, that damps every mode with `ratio` of critical damping.

        Raises:
            InputError: the ratio is not in 0 to 1.
        """
        if not 0.0 <= ratio < 1.0:
            raise InputError(f"{self.name}: damping_ratio = {ratio!r}: must lie in 0 ... 1")
        omega = 2.0 * np.pi * self.frequencies
        return np.diag(2.0 * ratio * omega)

    def von_mises(self, coordinates: Array) -> Array:
        """Return the von Mises stress [Pa] (s,) at the surface nodes for modal coordinates (n,)."""
        xx, yy, zz, yz, xz, xy = (self.stress @ coordinates).reshape(-1, 6).T
        normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
        mises: Array = np.sqrt(0.5 * normal + 3.0 * (yz**2 + xz**2 + xy**2))
        return mises
