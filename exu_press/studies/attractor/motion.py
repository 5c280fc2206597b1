"""A long run: its points in the section, neighbouring motions, and figures by revolution."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.model.settings import scales
from exu_press.model.state import State
from exu_press.numerics.arrays import Array
from exu_press.quantities import quantities_of
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.result.column import column_of
from exu_press.result.run import SHORT, run_once
from exu_press.scene import Scene
from exu_press.schema.checks import nearest
from exu_press.studies.attractor.lyapunov import BATCHES, Exponent, combine_exponents
from exu_press.studies.attractor.orbit import NoMotion, Orbit
from exu_press.studies.attractor.period import MOST, Period, period_of
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
        skip: revolutions before the first point.
        points: (n, k) in the section, one a revolution, without dimension (`Orbit.point`).
        error: largest error of a point, by those that revolutions make.
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
                "distances": self.period.distances,
                "error": self.error,
                "finer": self.period.finer,
            },
            "lyapunov_exponent": {
                "per_revolution": self.exponent.value,
                "low": self.exponent.low,
                "high": self.exponent.high,
                "per_second": value,
                "low_per_second": low,
                "high_per_second": high,
                "distances": self.exponent.distances,
                "revolutions": self.exponent.revolutions,
                "motion": self.exponent.sign,
            },
            "figures": dict(self.figures),
            "units": dict(self.units),
            "distributions": {name: d.to_dict() for name, d in self.distributions.items()},
            "points": self.points,
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

    def read(result: Result) -> dict[str, float]:
        there = {name: float(column_of(result, name)[0][-1]) for name in channels}
        return numbers_of(result, quantities) | there

    total = skip + revolutions
    walk = _Walk(scene, start, skip, revolutions, read)
    stopped = ""
    with Progress("attractor", total, "revolutions", quiet=quiet) as progress:
        try:
            for done in range(total):
                walk.turn(done)
                progress.update(done + 1)
        except NoMotion as end:
            if len(walk.values) < FEWEST or len(walk.point_errors) < 2:
                raise
            stopped = f"{end} (after {len(walk.points)} of {total} revolutions)"
    state, values = walk.close(), walk.values
    # the first growth is from a state that did not fit its constraints
    settled = [np.array(series[walk.begin == skip - 1 :]) for series in walk.growths]
    error = max(*walk.point_errors, NOISE)
    if len(values) >= 2 * BATCHES:
        growth_errors = [discretization_error(errors) for errors in walk.growth_errors]
        exponent = combine_exponents(settled, DISTANCES, error, growth_errors)
    else:
        exponent = Exponent(math.nan, -math.inf, math.inf, DISTANCES, len(settled[0]))
    transient, section = np.array(walk.points[:skip]), np.array(walk.points[skip:])
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
            name: _figure_error(walk.differences(name), figures[name], exponent) for name in names
        },
        units=channels | {name: placed.quantity.unit for name, placed in quantities.items()},
        turns=len(values) / (state["time"] - walk.start_time),
        last=walk.last,
        transient=np.linalg.norm(transient - section[-1], axis=1),
        state=state,
        stopped=stopped,
    )


class _Walk:
    """A long run under way: the orbit, what is run beside it, and what is known so far.

    Beside it are neighbours, brought back in every revolution; the orbit with finer steps, in the
    revolutions whose errors are measured; and, once, one that is pushed in another direction.

    Attributes:
        begin: revolution from whose end on neighbours follow.
        points: in the section, one a revolution, those of the transient too.
        values: of each revolution after the transient.
        growths: of each neighbour, its logarithms after the transient.
        point_errors: of the points of the revolutions whose errors are measured.
        growth_errors: of each neighbour, what finer steps change of its logarithms there.
        last: records of the last revolutions.
        start_time: s, at the end of the transient.
    """

    def __init__(
        self,
        scene: Scene,
        start: State | None,
        skip: int,
        revolutions: int,
        read: Callable[[Result], dict[str, float]],
    ) -> None:
        self._orbit = Orbit(scene, start)
        self._neighbours = [Orbit(scene) for _ in DISTANCES]
        self._finer, self._finer_neighbour = Orbit(finer(scene)), Orbit(finer(scene))
        self._pushed = Orbit(_perturbed_scene(scene))
        self._skip, self._read = skip, read
        self.begin = min(1, skip - 1)
        later = (skip + int(share * revolutions) for share in LATER)
        self._checked = {self.begin, skip, skip + 1, *later}
        self.points: list[Array] = []
        self.values: list[dict[str, float]] = []
        self.growths: list[list[float]] = [[] for _ in DISTANCES]
        self.growth_errors: list[list[float]] = [[] for _ in DISTANCES]
        self.point_errors: list[float] = []
        self.last: list[Result] = []
        self.start_time = 0.0
        self._pairs: list[tuple[dict[str, float], dict[str, float]]] = []

    def turn(self, done: int) -> None:
        """Go on by a revolution, of which so many are done.

        Raises:
            NoMotion: it does not get to the section.
        """
        orbit, recorded = self._orbit, done >= self._skip
        if done == self.begin:
            self._pushed.set_state(orbit.state)
        if done in self._checked:
            self._finer.set_state(orbit.state)
        result = orbit.advance(recorded=recorded)
        if done == self._skip - 1:
            self.start_time = orbit.state["time"]
        finer_result = self._finer.advance(recorded=recorded) if done in self._checked else None
        growths: list[float] = []
        finer_growths: list[float] = []
        if done > self.begin:
            for neighbour, distance in zip(self._neighbours, DISTANCES, strict=True):
                if finer_result is not None:
                    self._finer_neighbour.set_state(neighbour.state)
                    self._finer_neighbour.advance()
                    finer_growths.append(_growth(self._finer, self._finer_neighbour, distance))
                neighbour.advance()
                growths.append(_growth(orbit, neighbour, distance))
                _bring_back(orbit, neighbour, neighbour, distance)
        if done == self.begin:  # towards states that fit all constraints
            self._pushed.advance()
            directions = self._pushed, self._finer
            for triple in zip(self._neighbours, directions, DISTANCES, strict=True):
                _bring_back(orbit, *triple)
        self.points.append(orbit.point())
        if result is None:
            return
        self.values.append(self._read(result))
        self.last = [*self.last[-LAST + 1 :], result]
        for index, growth in enumerate(growths):
            self.growths[index].append(growth)
        if finer_result is not None:
            for index, growth in enumerate(finer_growths):
                self.growth_errors[index].append(growths[index] - growth)
            self._pairs.append((self.values[-1], self._read(finer_result)))
            apart = np.linalg.norm(orbit.point() - self._finer.point())
            self.point_errors.append(float(apart))

    def differences(self, name: str) -> list[float]:
        """Return what finer steps change of a figure, in each revolution that is checked."""
        nan = math.nan
        return [usual.get(name, nan) - finest.get(name, nan) for usual, finest in self._pairs]

    def close(self) -> State:
        """Return the state in which the orbit ends, and let all systems go."""
        state = self._orbit.state
        beside = self._finer, self._finer_neighbour, self._pushed
        for system in (self._orbit, *beside, *self._neighbours):
            system.close()
        return state


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
    """Return the logarithm by which a neighbour's distance has grown."""
    return math.log(_distance(orbit, neighbour) / distance)


def _bring_back(orbit: Orbit, neighbour: Orbit, direction: Orbit, distance: float) -> None:
    """Put a neighbour at a distance from the orbit, towards another one."""
    neighbour.set_state(orbit.towards(direction.state, distance / _distance(orbit, direction)))


def _distance(orbit: Orbit, neighbour: Orbit) -> float:
    return max(float(np.linalg.norm(neighbour.point() - orbit.point())), NOISE)


def _unit(scene: Scene, name: str) -> str:
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
