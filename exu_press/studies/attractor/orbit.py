"""A motion that goes on revolution by revolution, from section to section."""

import copy
import math
from collections.abc import Sequence

import numpy as np

from exu_press.errors import InputError
from exu_press.integrate import SolverStatus
from exu_press.joints.joint import ClearanceJoint
from exu_press.mechanism.parts import DRIVE
from exu_press.model import build
from exu_press.model.continuation import go_on_from, state_of
from exu_press.model.settings import scales
from exu_press.model.state import State
from exu_press.numerics.arrays import Array
from exu_press.result import Result, record
from exu_press.scene import Scene, mechanism_of
from exu_press.scene.joint import oil_of

__all__ = ["NoMotion", "Orbit", "require_orbit"]

MOST_REVOLUTIONS = 10.0
"""Revolutions at the scene's speed in which a motor turns the crank once, or not at all."""


class NoMotion(InputError):  # noqa: N818  an end, as that of a run
    """A motion does not reach the next section."""

    exit_status = 3


def require_orbit(scene: Scene) -> None:
    """Raise InputError unless a scene has an orbit: see `Orbit`."""
    motor = scene.drive is not None
    if any(oil_of(joint) is not None for joint in scene.joints.values()):
        raise InputError(
            "film.oil: warms from revolution to revolution, while an orbit is one of the same "
            "press in each; allowed is film.viscosity, as joints.NAME.film.viscosity of a run "
            "has it"
        )
    if scene.drive is not None and scene.drive.has_schedule:
        raise InputError(
            "[drive] starts or stops: an orbit is one of a press that runs; allowed is a drive "
            "that begins 'turning', without start_time, stop_time and stop_angle_deg"
        )
    if motor and scene.solver.tolerance is None:
        raise InputError(
            "solver.step: a motor gets to its section at any instant; allowed is "
            "solver.tolerance, whose steps end there"
        )
    has_guideways = any(guide.guideways is not None for guide in scene.guides.values())
    if not (scene.joints.with_clearance or has_guideways or motor):
        raise InputError(
            "joints: none has clearance, so that the crank alone determines the motion: its "
            "period is one revolution; allowed is a scene with clearance in joints or guides"
        )


class Orbit:
    """A press whose crank is at the section; each advance is one revolution.

    The section is the scene's crank angle at the start. At constant speed the free state there is
    that of journals and balls in their clearances and of bodies in their guideways; with a motor
    also the crank's speed.

    Attributes:
        scene: of one revolution.
        revolutions: done so far.
    """

    def __init__(self, scene: Scene, state: State | None = None) -> None:
        """Start as the scene does, or in a state on the section.

        Raises:
            InputError: nothing is free, oil warms, the press starts or stops, or the scene has a
                motor and fixed steps.
        """
        require_orbit(scene)
        motor = scene.drive is not None
        length = {"revolutions": MOST_REVOLUTIONS if motor else 1.0, "settle": 0.0}
        self.scene = scene.replace(length)
        self._model = model = build(self.scene)
        ways = [end for ends in model.guideways.values() for end in ends]
        self._joints: list[ClearanceJoint] = [*model.clearance_joints.values(), *ways]
        speed = scales(scene).speed
        assert speed is not None
        self._speed: float = speed
        self._state = state
        self.revolutions = 0
        if state is not None:
            go_on_from(model, state)
        self._aim_at_section()
        self._free = self._free_coordinates()

    @property
    def state(self) -> State:
        """The state on the section; before the first advance, that after one revolution."""
        if self._state is None:
            self.advance()
        assert self._state is not None
        return self._state

    def advance(self, *, recorded: bool = False) -> Result | None:
        """Run one revolution; return its record with `recorded`.

        Raises:
            NoMotion: the motion does not reach the next section.
            KeyboardInterrupt: after Ctrl-C.
        """
        model = self._model
        outcome = model.solve()
        if outcome.status is SolverStatus.INTERRUPTED:
            raise KeyboardInterrupt
        if not outcome.status.reached_end:
            raise NoMotion(f"no motion in the long run: {outcome.reason}")
        if model.until is not None and model.crank_angle()[0] < model.until:
            raise NoMotion(
                f"[drive]: the crank does not get to its section at {self.scene.start_angle_deg:g} "
                f"deg within {outcome.end_time - model.begin:.3g} s; allowed is a motor that turns "
                "the press on, as with more torque or inertia"
            )
        result = record(model, outcome) if recorded else None
        self.revolutions += 1
        self.set_state(state_of(model))
        return result

    def set_state(self, state: State) -> None:
        """Continue from another state on the section, at its time."""
        self._state = state
        go_on_from(self._model, state)
        self._aim_at_section()

    def point(self) -> Array:
        """Return the point in the section, (k,), without dimension.

        Of each clearance joint and each end in guideways: the eccentricity over the clearance and
        its rate over the scene's largest speed. Then, with a motor, the crank's speed over the
        scene's.
        """
        parts: list[Sequence[float]] = []
        speed = self._speed
        for joint in self._joints:
            parts.append([block / joint.clearance for block in joint.eccentricity])
            parts.append([block / speed for block in joint.relative_velocity])
        if self.scene.drive is not None:
            parts.append([self._model.crank_angle()[1] / self.scene.angular_speed])
        return np.concatenate([np.asarray(block, dtype=float) for block in parts])

    def close(self) -> None:
        """Release the model: Exudyn's systems and solvers refer to each other."""
        self._model.SC.Reset()

    def towards(self, target: State, share: float) -> State:
        """Return a state between the orbit's own, at share 0, and another, at 1.

        The crank keeps its angle: a difference by roundoff would grow to a shift in time. With a
        motor its speed is interpolated. The joints' internal states are the orbit's own, without
        the path of the last step.
        """
        own = self.state["coordinates"][:2]
        free = self._free, self._free if self.scene.drive is None else 1.0
        q, q_t = (
            np.array(own_values) + share * mask * (np.array(target_values) - np.array(own_values))
            for mask, own_values, target_values in zip(
                free, own, target["coordinates"][:2], strict=True
            )
        )
        state = copy.deepcopy(self.state)
        state["coordinates"][:2] = [q.tolist(), q_t.tolist()]
        for joint in (state["joints"] or {"joints": []})["joints"]:
            joint[1][1:] = [[], [], []]  # the path's eccentricity, velocity and acceleration
        return state

    def _aim_at_section(self) -> None:
        """Let a motor's model, which is on the section, go on to the next one."""
        if self.scene.drive is None:
            return
        turn, start = 2.0 * math.pi, self.scene.start_angle
        done = round((self._model.crank_at_start() - start) / turn)
        self._model.until = start + turn * (done + 1)

    def _free_coordinates(self) -> Array:
        """Return 1.0 for each coordinate that is free, 0.0 for the crank's and its drive's."""
        model = self._model
        free = np.ones(len(model.mbs.systemData.GetODE2Coordinates()))
        crank = mechanism_of(self.scene).crank
        for name, node in model.nodes.items():
            if name in (crank, DRIVE):
                first = model.mbs.GetNodeODE2Index(node)
                size = len(model.mbs.GetNodeParameter(node, "referenceCoordinates"))
                free[first : first + size] = 0.0
        return free
