"""Spectra of a run's channels: over frequency, over orders of the crank, and as they change."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from exu_press.mechanism import GROUND
from exu_press.numerics.arrays import Array, lengths
from exu_press.quantities.uncertain import significant
from exu_press.result import Result
from exu_press.result.column import column_of
from exu_press.result.windows import settled_part, whole_revolutions
from exu_press.scene import mechanism_of
from exu_press.scene.joint import TouchingJoint
from exu_press.signals.spectrum import Spectrogram, Spectrum, amplitude_spectrum, spectrogram
from exu_press.terminal.columns import columns

__all__ = ["DEFAULT", "Mark", "Spectra", "marks_of", "spectra"]

DEFAULT = "slider_acceleration"

FEWEST_CELLS = 512
"""In a revolution, however long the steps are: orders up to 255."""

WINDOWS_A_REVOLUTION = 12.0

STRONGEST = 5
"""Lines that are printed."""


@dataclass(frozen=True)
class Mark:
    """A natural frequency.

    Attributes:
        name: of its owner.
        frequency: Hz.
    """

    name: str
    frequency: float


@dataclass(frozen=True)
class Spectra:
    """Spectra of one curve.

    Attributes:
        name: of the channel, with its column.
        unit: of the amplitudes.
        over_time: amplitudes over frequency, Hz; at constant speed of whole revolutions, as
            `over_angle`, unless a window is asked for.
        over_angle: amplitudes over orders, multiples of the crank's frequency; None where the run
            has no whole revolution.
        changing: over frequency, Hz, in windows about instants.
        angle: crank angle at the windows' centres, deg.
        revolutions: whole ones in `over_angle`.
        crank: frequency of the crank, Hz.
        needed: revolutions with which `over_time` would resolve it.
    """

    name: str
    unit: str
    over_time: Spectrum
    over_angle: Spectrum | None
    changing: Spectrogram
    angle: Array
    revolutions: int
    crank: float
    needed: int

    def lines(self) -> list[str]:
        """Return the lines of the terminal."""
        lines = [f"{self.name}, amplitudes in {self.unit}"]
        for spectrum, unit in ((self.over_time, "Hz"), (self.over_angle, "orders")):
            if spectrum is None:
                lines.append("  no order spectrum: the run has no whole revolution")
                continue
            lines.append(
                f"  over {unit}: {spectrum.cells} cells, window {spectrum.window}, resolution "
                f"{spectrum.resolution:.4g} {unit}, error of the resampling "
                f"{significant(spectrum.error, 2)} {self.unit}"
            )
            every_line = spectrum.window == "boxcar" and self.revolutions == 1
            rows = [
                (f"{spectrum.frequency[k]:.5g} {unit}", f"{spectrum.amplitude[k]:.4g} {self.unit}")
                for k in _strongest(spectrum, every_line)
            ]
            lines += columns(rows, indent=4)
        if self.over_time.resolution > self.crank:
            number = f"{self.needed} revolution{'s' * (self.needed > 1)}"
            lines.append(
                f"  the crank's {self.crank:.4g} Hz lies below the resolution; {number} after "
                "`settle` would resolve it"
            )
        return lines


def _strongest(spectrum: Spectrum, every_line: bool) -> list[int]:
    """Return the places of the highest peaks (lines) above resolution and error, by frequency."""
    padded = np.concatenate([[0.0], spectrum.amplitude, [0.0]])
    higher = (padded[1:-1] > padded[:-2]) & (padded[1:-1] >= padded[2:])
    peaks = np.flatnonzero(higher | every_line)
    peaks = peaks[spectrum.frequency[peaks] >= spectrum.resolution * (1.0 - 1e-9)]
    peaks = peaks[spectrum.amplitude[peaks] > spectrum.error]
    highest = peaks[np.argsort(spectrum.amplitude[peaks])[::-1][:STRONGEST]]
    return sorted(highest.tolist())


def spectra(
    run: Result, names: Sequence[str] = (DEFAULT,), *, window: str | None = None
) -> list[Spectra]:
    """Return the spectra of channels, of the part that quantities are read from (after `settle`).

    Args:
        names: of channels; NAME.x is a column of one with columns.
        window: of the spectrum over frequency; None takes whole revolutions without a window at
            constant speed, else the flat top. The order spectrum is of whole revolutions, and needs
            none where the motion repeats itself in each of them.
    """
    result = settled_part(run)
    return [_spectra(result, name, window) for name in names]


def _spectra(result: Result, name: str, window: str | None) -> Spectra:
    values, unit = column_of(result, name)
    time, angle = result.time, result["crank_angle"]
    turns = (angle - angle[0]) / (2.0 * np.pi)
    cells = max(len(time), int(FEWEST_CELLS * abs(turns[-1])))
    whole = whole_revolutions(float(turns[-1]))
    over_angle = None
    if whole and (np.diff(turns) > 0.0).all():
        last = int(np.searchsorted(turns, whole - 1e-9)) + 1
        x, y = turns[:last], values[:last]
        if last >= len(turns) or x[-1] > whole + 1e-9:  # ends a rounding beside it, or behind it
            y = np.append(y[:-1], np.interp(whole, turns, values))
            x = np.append(x[:-1], float(whole))
        over_angle = amplitude_spectrum(
            x, y, window="boxcar", cells=max(len(x), FEWEST_CELLS * whole)
        )
    period = float(time[-1] - time[0]) / abs(float(turns[-1]))
    by_revolutions = window is None and result.scene.drive is None
    if by_revolutions and over_angle is not None:
        over_time = over_angle.rescale(1.0 / period)
    else:
        over_time = amplitude_spectrum(time, values, window=window or "flattop", cells=cells)
    lobe = over_time.resolution * float(time[-1] - time[0])
    needed = 1 if by_revolutions else math.ceil(lobe)
    width = min(period / WINDOWS_A_REVOLUTION, 0.5 * float(time[-1] - time[0]))
    changing = spectrogram(time, values, width, cells=cells)
    centres = np.degrees(np.interp(changing.x, time, angle))
    return Spectra(
        name, unit, over_time, over_angle, changing, centres, whole, 1.0 / period, needed
    )


def marks_of(run: Result) -> list[Mark]:
    """Return natural frequencies: of flexible bodies, and of journals on their contacts.

    A flexible body's are those with its interfaces held. A journal's is sqrt(k / m) / (2 pi): k
    the contact's stiffness at the joint's mean force while the surfaces touch, m the reduced mass
    of the two bodies that the joint connects (of the one where the other is the frame).
    """
    marks = [
        Mark(f"{name.replace('_', ' ')}, mode {number}", frequency)
        for name, solid in run.info.get("solids", {}).items()
        for number, frequency in enumerate(solid.get("frequencies", ()), start=1)
    ]
    return [*marks, *_on_contacts(settled_part(run))]


def _on_contacts(result: Result) -> Iterator[Mark]:
    scene, mechanism = result.scene, mechanism_of(result.scene)
    compliance = {body.name: 1.0 / body.mass for body in mechanism.bodies} | {GROUND: 0.0}
    for joint in mechanism.joints:
        kind = scene.joints[joint.name]
        law = kind.normal_contact(scene.angular_speed) if isinstance(kind, TouchingJoint) else None
        if law is None:
            continue
        distance = lengths(result[f"{joint.name}_eccentricity"])
        touches = distance > kind.clearance
        mobility = compliance[joint.journal] + compliance[joint.bearing]
        if not touches.any() or mobility == 0.0:
            continue
        steps = np.gradient(result.time)
        forces = lengths(result[f"{joint.name}_force"])
        mean = float((forces * steps)[touches].sum() / steps[touches].sum())

        def excess_force(depth: float, law: object = law, mean: float = mean) -> float:
            return float(law.force(depth, 0.0, 1.0)[0]) - mean  # type: ignore[attr-defined]

        bound = kind.clearance
        while excess_force(bound) < 0.0:
            bound *= 2.0
        depth = float(brentq(excess_force, 0.0, bound, xtol=1e-15))
        stiffness = float(law.force(depth, 0.0, 1.0)[1])
        label = f"{joint.name.replace('_', ' ')} on its contact"
        yield Mark(label, float(np.sqrt(stiffness * mobility)) / (2.0 * np.pi))
