"""A long run: its points in the section, neighbouring motions, and figures by revolution."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.model.state import State
from exu_press.numerics.arrays import Array
from exu_press.quantities import quantities_of
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.result.run import SHORT, run_once
from exu_press.scene import Scene
from exu_press.schema.checks import nearest
from exu_press.solving.solve import scales
from exu_press.studies.attractor.lyapunov import BATCHES, Exponent, combine_exponents
from exu_press.studies.attractor.orbit import NoMotion, Orbit
from exu_press.studies.attractor.period import MOST, Period, period_of
from exu_press.studies.spectrum import column_of
from exu_press.terminal.progress import Progress
from exu_press.verification.distribution import Distribution, discretization_error, finer

__all__ = ["DISTANCES", "Attractor", "attractor"]

DISTANCES = (1e-2, 1e-3)
"""Between neighbouring motions at the beginning of a revolution, without dimension."""

LATER = (0.4, 0.6, 0.8)
"""Shares of the revolutions at which errors are measured, beside the first two."""

PUSH = 0.01
"""Gravity that is added for a revolution, over the crank pin's acceleration."""

NOISE = 1e-12
"""Least distance, without dimension."""

FEWEST = 3
"""Least revolutions after the transient from which anything is known."""

LAST = 4
"""Revolutions at the end whose channels are kept for the pictures."""


@dataclass(frozen=True)
class Attractor:
    """Long-run dynamics of a press.

    Attributes:
        scene: complete.
        skip: revolutions before the first point.
        points: (n, k) in the section, one a revolution, without dimension (`Orbit.point`).
        error: largest error of a point, by those that revolutions make.
        period: after which the motion comes back.
        exponent: largest Lyapunov exponent.
        figures: quantity -> its value in each revolution, (n,); channel -> its value on the
            section.
        step_errors: error of each of these by the integration's steps.
        units: of these.
        turns: revolutions in a second; a motor's in the mean.
        last: records of the last revolutions.
        transient: (skip,) distance of each point of the transient from the last point.
        state: on the section, at the end.
        stopped: why there are fewer revolutions than asked for, or nothing.
    """

    scene: Scene
    skip: int
    points: Array
    error: float
    period: Period
    exponent: Exponent
    figures: Mapping[str, Array]
    step_errors: Mapping[str, float]
    units: Mapping[str, str]
    turns: float
    last: Sequence[Result]
    transient: Array
    state: State
    stopped: str = ""

    @property
    def per_second(self) -> tuple[float, float, float]:
        """The exponent and the ends of its interval, 1/s."""
        return tuple(
            self.turns * x for x in (self.exponent.value, self.exponent.low, self.exponent.high)
        )  # type: ignore[return-value]

    @property
    def distributions(self) -> dict[str, Distribution]:
        """Mean, scatter and percentiles of the figures that three revolutions at least have."""
        known = {name: values[np.isfinite(values)] for name, values in self.figures.items()}
        return {
            name: Distribution.from_values(values, self.step_errors[name])
            for name, values in known.items()
            if len(values) > 2
        }

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of attractor.json."""
        value, low, high = self.per_second
        return {
            "scene": self.scene.to_dict(),
            "skip": self.skip,
            "revolutions": len(self.points),
            "stopped": self.stopped,
            "section_deg": self.scene.start_angle_deg,
            "period": {
                "revolutions": self.period.revolutions,
                "decided": self.period.is_decided,
                "in_words": str(self.period),
                "distances": self.period.distances.tolist(),
                "error": self.error,
                "finer": self.period.finer,
            },
            "lyapunov_exponent": {
                "per_revolution": _finite(self.exponent.value),
                "low": _finite(self.exponent.low),
                "high": _finite(self.exponent.high),
                "per_second": _finite(value),
                "low_per_second": _finite(low),
                "high_per_second": _finite(high),
                "distances": list(self.exponent.distances),
                "revolutions": self.exponent.revolutions,
                "motion": self.exponent.sign,
            },
            "figures": {
                name: [_finite(value) for value in values.tolist()]
                for name, values in self.figures.items()
            },
            "units": dict(self.units),
            "distributions": {
                name: distribution.to_dict() for name, distribution in self.distributions.items()
            },
            "points": self.points.tolist(),
        }


def attractor(
    scene: Scene,
    *,
    revolutions: int = 100,
    skip: int = 30,
    names: Sequence[str] = (),
    most: int = MOST,
    start: State | None = None,
    quiet: bool = True,
) -> Attractor:
    """Return the motion of a press in the long run.

    Args:
        scene: with clearance somewhere, or a motor; its own length is not used. The section is
            its crank angle at the start.
        revolutions: after the transient.
        skip: revolutions of the transient.
        names: of quantities whose values in each revolution are kept, and of channels (NAME.x is a
            column), kept on the section; the headline quantities by default.
        most: revolutions up to which a period is looked for.
        start: state on the section to begin with; the scene's own start by default.
        quiet: False shows the progress.

    Raises:
        InputError: there is no such quantity or channel, there are too few revolutions, or the
            scene has no section.
        NoMotion: a run does not get to the section FEWEST times after the transient.
    """
    if revolutions < max(3 * most, 2 * BATCHES):
        raise InputError(
            f"--revolutions {revolutions}: allowed are at least {max(3 * most, 2 * BATCHES)}, for "
            f"periods up to {most}"
        )
    if skip < 1:
        raise InputError(f"--skip {skip}: allowed is a whole number >= 1")
    declared = quantities_of(scene)
    if not names:
        names = [name for name, placed in declared.items() if placed.quantity.headline]
    quantities = {name: declared[name] for name in names if name in declared}
    channels = {name: _unit(scene, name) for name in names if name not in declared}
    total = skip + revolutions
    orbit = Orbit(scene, start)
    neighbours = [Orbit(scene) for _ in DISTANCES]
    finer_orbit, pushed = Orbit(finer(scene)), Orbit(_perturbed_scene(scene))
    begin = min(1, skip - 1)
    checked = {skip, skip + 1, *(skip + int(share * revolutions) for share in LATER)}
    transient_points: list[Array] = []
    points: list[Array] = []
    values: list[dict[str, float]] = []
    last: list[Result] = []
    growths: list[list[float]] = [[] for _ in DISTANCES]
    point_errors: list[float] = []
    differences: list[dict[str, float]] = []
    stopped = ""

    def read(result: Result) -> dict[str, float]:
        there = {name: float(column_of(result, name)[0][-1]) for name in channels}
        return numbers_of(result, quantities) | there

    with Progress("attractor", total, "revolutions", quiet=quiet) as progress:
        try:
            for done in range(total):
                is_checked = done == begin or done in checked
                if done == begin:
                    pushed.set_state(orbit.state)
                if is_checked:
                    finer_orbit.set_state(orbit.state)
                result = orbit.advance(recorded=done >= skip)
                if done == skip - 1:
                    start_time = orbit.state["time"]
                finer_result = finer_orbit.advance(recorded=done >= skip) if is_checked else None
                if done > begin:
                    growth_of_each = [
                        _growth(orbit, *pair) for pair in zip(neighbours, DISTANCES, strict=True)
                    ]
                if done == begin:  # towards states that fit all constraints
                    pushed.advance()
                    for pair in zip(neighbours, (pushed, finer_orbit), DISTANCES, strict=True):
                        _bring_back(orbit, *pair)
                (points if done >= skip else transient_points).append(orbit.point())
                if result is not None:
                    values.append(read(result))
                    last = [*last[-LAST + 1 :], result]
                    for series, growth in zip(growths, growth_of_each, strict=True):
                        series.append(growth)
                if finer_result is not None and values:
                    finest = read(finer_result)
                    point_errors.append(float(np.linalg.norm(orbit.point() - finer_orbit.point())))
                    differences.append(
                        {n: values[-1].get(n, math.nan) - finest.get(n, math.nan) for n in names}
                    )
                progress.update(done + 1)
        except NoMotion as end:
            if len(values) < FEWEST or len(point_errors) < 2:
                raise
            stopped = f"{end} (after {len(transient_points) + len(points)} of {total} revolutions)"
    state = orbit.state
    turns = len(values) / (state["time"] - start_time)
    for system in (orbit, finer_orbit, pushed, *neighbours):
        system.close()
    # the first growth is from a state that did not fit its constraints
    settled = [np.array(series[begin == skip - 1 :]) for series in growths]
    error = max(*point_errors, NOISE)
    if len(values) >= 2 * BATCHES:
        exponent = combine_exponents(settled, DISTANCES, error)
    else:
        exponent = Exponent(math.nan, -math.inf, math.inf, DISTANCES, len(settled[0]))
    section = np.array(points)
    point_error = error * _error_amplification(exponent)
    most = min(most, len(section) // 3)
    figures = {name: np.array([v.get(name, math.nan) for v in values]) for name in names}
    return Attractor(
        scene=scene,
        skip=skip,
        points=section,
        error=point_error,
        period=period_of(section, point_error, most, diverging=exponent.low > 0.0),
        exponent=exponent,
        figures=figures,
        step_errors={
            name: _figure_error([d[name] for d in differences], figures[name], exponent)
            for name in names
        },
        units=channels | {name: placed.quantity.unit for name, placed in quantities.items()},
        turns=turns,
        last=last,
        transient=np.linalg.norm(np.array(transient_points) - section[-1], axis=1),
        state=state,
        stopped=stopped,
    )


def _figure_error(differences: Sequence[float], values: Array, exponent: Exponent) -> float:
    """Return the error of a figure: of a revolution's own steps, and of the state it begins in.

    The state has the errors of all earlier revolutions. Where neighbours diverge, the figure's
    scatter contains them; where they may diverge, they move it by no more than it scatters.
    """
    own = discretization_error(differences)
    inherited = _error_amplification(exponent) * own
    if exponent.high >= 0.0:
        inherited = min(inherited, max(float(np.ptp(values)), own))
    return own if exponent.low > 0.0 else own + inherited


def _perturbed_scene(scene: Scene) -> Scene:
    """Return a scene that differs a little, to displace a neighbour in another direction.

    Two neighbours in one direction may both follow for long one that grows less than others do.
    """
    speed = scales(scene).speed
    assert speed is not None
    return scene.replace({"gravity": scene.gravity + PUSH * speed * scene.angular_speed})


def _growth(orbit: Orbit, neighbour: Orbit, distance: float) -> float:
    """Advance a neighbour, bring it back to `distance`; return the logarithm of its growth."""
    neighbour.advance()
    return math.log(_bring_back(orbit, neighbour, neighbour, distance) / distance)


def _bring_back(orbit: Orbit, neighbour: Orbit, direction: Orbit, distance: float) -> float:
    """Put a neighbour at a distance from the orbit, towards another one; return their distance."""
    distance_before = max(float(np.linalg.norm(direction.point() - orbit.point())), NOISE)
    neighbour.set_state(orbit.towards(direction.state, distance / distance_before))
    return distance_before


def _unit(scene: Scene, name: str) -> str:
    """Return the unit of a channel.

    Raises:
        InputError: the scene has no quantity and no channel of this name.
    """
    known = run_once(scene.replace({"revolutions": SHORT, "settle": 0.0, "output": None}))
    try:
        return column_of(known, name)[1]
    except InputError as error:
        raise InputError(
            f"--quantity {name}: no quantity{nearest(name, list(quantities_of(scene)))}; {error}"
        ) from None


def _error_amplification(exponent: Exponent) -> float:
    """Return the error of a state due to all revolutions over that due to one."""
    rate = min(exponent.high, -0.05)  # neighbours that do not approach have no period
    return 1.0 / (1.0 - math.exp(rate))


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
