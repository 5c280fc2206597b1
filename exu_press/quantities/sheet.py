"""Quantities of a sheet that is cut, and of the press's release."""

from collections.abc import Callable
from functools import partial

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.quantities.acceleration import peak
from exu_press.quantities.alternating import remove_alternation
from exu_press.quantities.kind import DIFFERENCE, ENERGY, LOAD
from exu_press.quantities.quantity import Extreme, Owner, Quantity
from exu_press.quantities.reading import Reading
from exu_press.result.energy import work
from exu_press.scene import Scene

__all__ = ["SHEETS", "released_work"]


def _is_sheet(scene: Scene, load: str) -> bool:
    return scene.load[load].kind == "sheet"


def _strokes(run: Reading, load: str) -> list[tuple[Array, Array]]:
    """Return, of each stroke that fractures the sheet, the steps before and after the fracture.

    From the first touch to the fracture, and from there until the punch goes up again: to the end
    of the crack and on to the bottom dead centre, where impacts of the way back have not begun, nor
    has the stripping.
    """
    sheet = run.result.scene.applied_loads[load].sheet
    assert sheet is not None
    depth, strips = _penetration(run, load), run[f"load_{load}_force"] < 0.0
    strokes = []
    inside = np.flatnonzero(np.diff(np.concatenate([[0], (depth > 0.0).astype(int), [0]])))
    for first, end in inside.reshape(-1, 2):
        steps = np.arange(first, end)
        deep = np.flatnonzero(depth[steps] >= sheet.fracture)
        lowest = int(np.argmax(depth[steps]))
        if first > 0 and deep.size and deep[0] < lowest:
            after = steps[deep[0] : lowest + 1]
            while len(after) > 1 and strips[after[-1]]:
                after = after[:-1]
            strokes.append((steps[: deep[0]], after))
    return strokes


def _penetration(run: Reading, load: str) -> Array:
    top = run.result.scene.applied_loads[load].top
    return np.asarray(run.mechanism.bottom + top - run["slider_position"])


def _pull(run: Reading) -> Array:
    """Return the force of the output's joints that lifts it, (n,), N, beyond weight and inertia.

    Its inertia is that of the ideal motion. Loads, springs and friction of guides act beside them.
    The force is without the oscillation from step to step that ideal joints leave in it.
    """
    mechanism = run.mechanism
    output, direction = mechanism.body(mechanism.slider), np.array(mechanism.output.direction)
    pull = -output.mass * (run.once(_ideal)[2] + run.result.scene.gravity * direction[1])
    for joint in mechanism.joints_of(output.name):
        on_output = 1.0 if joint.journal == output.name else -1.0
        pull += on_output * run[f"{joint.name}_force"][:, :2] @ direction
    return remove_alternation(run.time, np.asarray(pull))


def _ideal(run: Reading) -> tuple[Array, Array, Array]:
    """Return the ideal output's position, (n,), m, velocity, m/s, and acceleration, m/s^2.

    That of a crank at the same angle and speed, which a motor's load slows down.
    """
    speed = run["crank_speed"]
    position, velocity, acceleration = run.mechanism.ideal_slider(run["crank_angle"], 1.0)
    deceleration: Array = np.zeros_like(speed)
    if run.result.scene.drive is not None:
        deceleration = np.gradient(speed, run.time) * velocity
    return position, speed * velocity, speed**2 * acceleration + deceleration


def released_work(time: Array, pull: Array, rate: Array) -> float:
    """Return the work on an output that is released, J, until what pressed it pulls.

    Args:
        time: from the fracture on, (n,), s.
        pull: force that lifts the output, (n,), N; negative as long as it is pressed down.
        rate: at which it rises beside the ideal motion, (n,), m/s.
    """
    pulls = np.flatnonzero(pull >= 0.0)
    end = pulls[0] + 1 if pulls.size else len(time)
    return float(work(time[:end], np.minimum(pull[:end], 0.0), rate[:end])[-1])


def _largest(
    read: Callable[[Reading, str, Array, Array], float], run: Reading, load: str
) -> float | None:
    """Return the largest value of all strokes, None where none fractures the sheet."""
    strokes = _strokes(run, load)
    return max((read(run, load, *stroke) for stroke in strokes), default=None)


def _reverse_force(run: Reading, load: str, pressed: Array, released: Array) -> float:
    return max(0.0, float(run.once(_pull)[released].max()))


def _if_determined(
    read: Callable[[Reading, str], float | None], run: Reading, load: str
) -> float | None:
    """Return a value from the forces of the output's joints, None where one is undetermined."""
    joints = run.mechanism.joints_of(run.mechanism.slider)
    known = all(run.channel(f"{joint.name}_force") is not None for joint in joints)
    return read(run, load) if known else None


def _reverse_share(run: Reading, load: str) -> float | None:
    reverse = _largest(_reverse_force, run, load)
    return None if reverse is None else reverse / peak(run[f"load_{load}_force"])


def _downward_acceleration(run: Reading, load: str, pressed: Array, released: Array) -> float:
    return max(0.0, float(-run["slider_acceleration"][released].min()))


def _stack_up(run: Reading, load: str, pressed: Array, released: Array) -> float:
    above = run["slider_position"] - run.once(_ideal)[0]
    highest = above[pressed].max() if pressed.size else above[released[0]]
    return float(highest - above[released].min())


def _released_energy(run: Reading, load: str, pressed: Array, released: Array) -> float:
    rising = run["slider_velocity"] - run.once(_ideal)[1]
    return released_work(run.time[released], run.once(_pull)[released], rising[released])


SHEETS = (
    Quantity("reverse_force", "N",
             "largest pull of the output's joints after the fracture beyond its weight and inertia",
             LOAD, partial(_if_determined, partial(_largest, _reverse_force)), Owner.LOAD,
             _is_sheet, title="reverse load, max", display_unit="kN", is_detail=True,
             extreme=Extreme.LARGEST),
    Quantity("reverse_share", "",
             "reverse load over the largest load; builders of presses allow about 0.1",
             LOAD, partial(_if_determined, _reverse_share), Owner.LOAD, _is_sheet,
             title="over the largest load", is_detail=True, extreme=Extreme.LARGEST),
    Quantity("release_acceleration", "m/s^2",
             "largest downward acceleration of the output after the fracture",
             LOAD, partial(_largest, _downward_acceleration), Owner.LOAD, _is_sheet,
             extreme=Extreme.LARGEST),
    Quantity("snap_through_energy", "J",
             "energy that mechanism and drive give back after the fracture, until they pull",
             ENERGY, partial(_if_determined, partial(_largest, _released_energy)), Owner.LOAD,
             _is_sheet, extreme=Extreme.LARGEST),
    Quantity("stack_up", "m",
             "way by which the output jumps ahead of the ideal motion as clearances change sides",
             DIFFERENCE, partial(_largest, _stack_up), Owner.LOAD, _is_sheet,
             title="stack-up", display_unit="um", is_detail=True, extreme=Extreme.LARGEST),
)  # fmt: skip
