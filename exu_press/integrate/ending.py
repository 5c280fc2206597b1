"""How a run ended: its status, and the reason in words, with what to try."""

import math
from collections.abc import Iterator

from exu_press.integrate.outcome import Status
from exu_press.integrate.resolution import unresolved
from exu_press.integrate.settings import smallest_step
from exu_press.integrate.stepping import StepControl
from exu_press.integrate.watch import Watch
from exu_press.joints import overlay_of
from exu_press.model import Model
from exu_press.scene import Scene

__all__ = ["how_it_ended"]

THIN = 1e-6
"""m; the damping of a film of 1e-7 m, 1e17 N s/m, makes 10 N of a speed's last digit."""

SPENT = 1e-3
"""Film thickness over clearance at which a run that gets no further has lost its film."""

WIDE_CIRCLE = 0.3
"""Of the friction circle's radius, in crank radii."""


def how_it_ended(
    model: Model, watch: Watch, end_time: float, control: StepControl | None, failure: str
) -> tuple[Status, str]:
    """Return status and reason of a run.

    Args:
        model: as the run left it.
        watch: what looked on.
        end_time: how far it came, s.
        control: of its steps, if they followed a tolerance.
        failure: what Exudyn said, if it failed.
    """
    scene = model.scene
    if end_time >= scene.duration * (1.0 - 1e-9):
        return _resolution(model)
    where = _place(model, end_time)
    if watch.interrupted:
        return Status.INTERRUPTED, f"interrupted {where}"
    if watch.over_budget:
        return Status.TOO_MANY_STEPS, (
            f"{watch.max_steps} steps were used up {where}, "
            f"{end_time / scene.duration:.1%} of the run; try fewer revolutions, a larger "
            f"{'solver.step' if control is None else 'solver.tolerance'} or solver.max_steps"
            f"{_seizing(model)}"
        )
    for name, ratio in _spent_films(model):
        return Status.FILM_BROKE_DOWN, (
            f"film broke down {where}, eccentricity ratio {ratio:.4f} ({name}); "
            "try film.at_contact = 'mixed', or a larger film.viscosity or film.length"
        )
    if control is not None and not control.error <= 1.0:
        return Status.STEP_TOO_SMALL, (
            f"the tolerance needs a step below {smallest_step(scene):.2g} s {where}"
            f"{_busiest_joint(model)}; "
            f"try a larger solver.tolerance or a smaller solver.min_step{_seizing(model)}"
        )
    key = "solver.step" if control is None else "solver.tolerance"
    return Status.NOT_CONVERGED, (
        f"Newton's method did not converge {where}{_busiest_joint(model)}, down to a step of "
        f"{smallest_step(scene):.2g} s; try a smaller {key}{_seizing(model)}{_thin_film(scene)}"
        + (f" [{failure.strip().splitlines()[0]}]" if failure.strip() else "")
    )


def _spent_films(model: Model) -> Iterator[tuple[str, float]]:
    """Yield the films that end the run, with their eccentricity ratios at its end."""
    film = model.scene.film
    if film is None or film.at_contact != "stop":
        return
    for name, joint in model.clearance_joints.items():
        if joint.outside is not None:
            yield name, joint.outside
        elif name == "crank_pin":
            gap = overlay_of(model.mbs).state(joint).gap
            if gap < SPENT * joint.clearance:
                yield name, 1.0 - gap / joint.clearance


def _resolution(model: Model) -> tuple[Status, str]:
    """Return status and reason of a run that reached its end."""
    worst = unresolved(model)
    solver = model.scene.solver
    if worst is None or solver is None:
        return Status.COMPLETED, ""
    help_ = (
        f"solver.step = {worst.step_needed:.0e}"
        if solver.tolerance is None
        else f"solver.tolerance = {0.1 * solver.tolerance:.0e}"
    )
    return Status.UNDER_RESOLVED, (
        f"under-resolved {_place(model, worst.time)}: {worst.what}; peaks are the step's; "
        f"try {help_}"
    )


def _place(model: Model, time: float) -> str:
    """Return time and crank angle in words."""
    scene = model.scene
    degrees = math.degrees(scene.start_angle + scene.angular_speed * time) % 360.0
    return f"at t = {time:.6g} s, crank angle {degrees:.2f} deg"


def _busiest_joint(model: Model) -> str:
    """Return in words which clearance joint carries the largest force at the end, if one does."""
    if not model.clearance_joints:
        return ""
    overlay = overlay_of(model.mbs)
    forces = {n: math.hypot(*overlay.state(j).force) for n, j in model.clearance_joints.items()}
    name = max(forces, key=lambda name: forces[name] if math.isfinite(forces[name]) else -1.0)
    return f", {name} carrying {forces[name]:.3g} N"


def _seizing(model: Model) -> str:
    """Return in words that the crank pin's friction circle is wide enough to seize.

    Near dead centre the rod's force passes within it: friction then holds the pin fast, whatever
    the force, and a crank that turns at constant speed makes it grow without bound.
    """
    scene = model.scene
    size, friction, contact = scene.press or scene.slider_crank, scene.friction, scene.contact
    if size is None or friction is None or contact is None or friction.law == "none":
        return ""
    circle = contact.radius * math.sin(math.atan(friction.mu_static))
    if "crank_pin" not in model.clearance_joints or circle < WIDE_CIRCLE * size.crank_radius:
        return ""
    return (
        f"; the crank pin seizes near dead centre (friction circle {circle:.2g} m, crank radius "
        f"{size.crank_radius:.2g} m): try a smaller friction.mu_static or contact.radius"
    )


def _thin_film(scene: Scene) -> str:
    """Return in words that a film is so thin that rounding moves its forces, or nothing."""
    clearance = None if scene.clearance is None else scene.clearance.crank_pin
    if scene.film is None or clearance is None or clearance >= THIN:
        return ""
    return "; a film this thin is too stiff for rounded speeds: try a larger clearance.crank_pin"
