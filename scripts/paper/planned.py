"""The runs of the study with one reading of the damping, and what they give."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from exu_press.scene import Scene
from paper import clearance as choosing
from paper.comparison import observed
from paper.damping import DIMENSIONAL, directory_of, with_damping
from paper.plan import Plan
from paper.published import Published, published
from paper.readings import OBSERVED
from paper.report import Findings
from paper.rows import choice_row, number_rows, trend_rows
from paper.runs import paper_runs, rigid_twin
from paper.sensitivity import Tornado, tornado_of
from paper.settings import AS_THEY_ARE, FLEXIBLE, Setting
from paper.side_by_side import computed_peaks, distances_by_setting, peaks_of
from paper.tasks import observe, run_file

__all__ = ["Amount", "Planned"]

FLEXIBLE_NUMBERS = ("acceleration_lubricated", "acceleration_200um")
"""What the flexible sensitivity study looks at: the first of the runs, and the widest clearance."""

TOLERANCE = 1e-2
"""Of what is varied or chosen from: with it the rigid peaks over 1 ms are within 1 % of those at
1e-4, in a third of the time of 1e-3. The table's own runs, and their rigid twins, have 1e-3."""


@dataclass(frozen=True)
class Amount:
    """How much is run.

    Attributes:
        rigid_only: leave flexible bodies out.
        revolutions: length of the paper's runs and of what is varied.
        strokes: length of the rigid runs that a clearance is chosen from.
        settings: what is varied on rigid bodies.
        alike, separate: clearances to choose from, m.
        mesh_size: of the parts whose frequencies are compared, m.
    """

    rigid_only: bool
    revolutions: float
    strokes: float
    settings: tuple[Setting, ...]
    alike: tuple[float, ...]
    separate: tuple[float, ...]
    mesh_size: float


@dataclass(frozen=True)
class Varied:
    """The runs of one scene with each setting: their numbers in the plan."""

    baseline: int
    settings: tuple[tuple[Setting, int], ...]


class Planned:
    """Everything that is run with one reading; `findings` when the plan has been run."""

    def __init__(self, plan: Plan, amount: Amount, directory: Path, damping: str) -> None:
        """Add the runs to a plan; trends and flexible bodies are varied by default alone.

        Args:
            plan: of all readings.
            amount: how much is run.
            directory: of the study.
            damping: a key of `damping.DAMPINGS`.
        """
        self._plan, self._amount, self._damping = plan, amount, damping
        place = directory_of(directory, damping)
        self._bodies = "rigid" if amount.rigid_only else "flexible"
        self._beside = published().beside(self._bodies)
        scenes = {
            name: with_damping(scene, damping)
            for name, scene in paper_runs(
                rigid_only=amount.rigid_only, revolutions=amount.revolutions
            ).items()
        }
        self._runs = {
            name: plan.add({"scene": scene.to_dict(), "save": str(run_file(place, name))})
            for name, scene in scenes.items()
        }
        computed = computed_peaks(self._beside.numbers)
        coarser = {n.run: scenes[n.run].replace("solver.tolerance", TOLERANCE) for n in computed}
        self._coarser = {
            name: plan.add({"scene": scene.to_dict()}) for name, scene in coarser.items()
        }
        default = damping == DIMENSIONAL
        flexible = _flexible(scenes) if default and not amount.rigid_only else {}
        self._flexible = _vary(plan, flexible, FLEXIBLE)
        self._chosen_for = scenes["clearance 0.1 mm"].replace("solver.tolerance", TOLERANCE)
        self._alike, self._separate = choosing.scenes_of(
            self._chosen_for, amount.alike, amount.separate, amount.strokes
        )
        self._points = {
            scene: plan.add({"scene": scene.to_dict()}) for scene in (*self._alike, *self._separate)
        }
        twins = _rigid_twins(self._beside, scenes, trends=default)
        self._twins = {name: plan.add({"scene": s.to_dict()}) for name, s in twins.items()}
        self._rigid = _vary(plan, twins, amount.settings)

    def findings(self) -> Findings:
        """Return what the runs give."""
        plan, beside = self._plan, self._beside
        _restore(plan, self._runs)
        rigid = _tornados(plan, beside, self._rigid, "rigid")
        flexible = _tornados(plan, beside, self._flexible, "flexible")
        choice = _choice(plan, self._chosen_for, self._alike, self._separate, self._points)
        by_name = {name: plan[number] for name, number in self._runs.items()}
        twins = {name: plan[number] for name, number in self._twins.items()}
        baselines = {name: plan[one.baseline] for name, one in self._rigid.items()}
        coarser = {name: plan[number] for name, number in self._coarser.items()}
        peaks = [peaks_of("rigid", beside.numbers, twins, baselines)]
        if self._bodies == "flexible":
            peaks.insert(0, peaks_of("flexible", beside.numbers, by_name, coarser))
        return Findings(
            damping=self._damping,
            bodies=self._bodies,
            rows=(
                *number_rows(beside.numbers, by_name, {t.number.name: t for t in rigid}),
                *trend_rows(beside.trends, by_name, _series(plan, beside, self._rigid)),
                choice_row(choice),
            ),
            runs=by_name,
            tornados=(*rigid, *flexible),
            choice=choice,
            peaks=tuple(peaks),
            settings=distances_by_setting(
                beside.numbers,
                baselines,
                {
                    name: [(setting, plan[number]) for setting, number in one.settings]
                    for name, one in self._rigid.items()
                },
            ),
            files={name: Path(plan.tasks[number]["save"]) for name, number in self._runs.items()},
        )


def _choice(
    plan: Plan,
    scene: Scene,
    alike: Sequence[Scene],
    separate: Sequence[Scene],
    numbers: Mapping[Scene, int],
) -> choosing.Choice:
    """Return the clearance to choose for a scene, from the runs of `choosing.scenes_of`."""
    found = {one: choosing.point_of(one, plan[numbers[one]]) for one in (*alike, *separate)}
    stopped = [
        (*choosing.clearances_of(one), plan[numbers[one]]["reason"])
        for one, point in found.items()
        if point is None
    ]
    return choosing.choose(
        scene,
        [point for one in alike if (point := found[one])],
        [point for one in separate if (point := found[one])],
        stopped,
    )


def _rigid_twins(
    paper: Published, scenes: Mapping[str, Scene], *, trends: bool
) -> dict[str, Scene]:
    """Return the rigid twins of the runs with clearance that the paper's rows use, by their names.

    Args:
        paper: with the rows.
        scenes: of all runs, by name.
        trends: those of trends too, not of numbers alone.
    """
    used = [number.run for number in paper.numbers]
    used += [name for trend in paper.trends if trends for name in trend.runs]
    return {
        name: rigid_twin(scenes[name])
        for name in dict.fromkeys(used)
        if scenes[name].joints.with_clearance
    }


def _flexible(scenes: Mapping[str, Scene]) -> dict[str, Scene]:
    numbers = [number for number in published().numbers if number.name in FLEXIBLE_NUMBERS]
    return {number.run: scenes[number.run] for number in numbers}


def _vary(
    plan: Plan, scenes: Mapping[str, Scene], settings: tuple[Setting, ...]
) -> dict[str, Varied]:
    """Plan every setting on every scene that has what it changes."""
    scenes = {name: s.replace("solver.tolerance", TOLERANCE) for name, s in scenes.items()}
    return {
        name: Varied(
            plan.add({"scene": scene.to_dict()}),
            tuple(
                (setting, plan.add({"scene": setting.on(scene).to_dict()}))
                for setting in settings
                if setting.applies(scene)
            ),
        )
        for name, scene in scenes.items()
    }


def _restore(plan: Plan, runs: Mapping[str, int]) -> None:
    """Run again what is known as finished but whose result is gone."""
    for number in runs.values():
        task = plan.tasks[number]
        if plan[number].get("readings") and not Path(task["save"]).exists():
            observe(task)


def _tornados(
    plan: Plan, paper: Published, varied: Mapping[str, Varied], bodies: str
) -> list[Tornado]:
    """Return a tornado for every published number whose run has been varied."""
    found = []
    for number in paper.numbers:
        if number.run in varied and (bodies == "rigid" or number.name in FLEXIBLE_NUMBERS):
            one = varied[number.run]
            rows = [(setting, plan[index]) for setting, index in one.settings]
            tornado = tornado_of(number, bodies, plan[one.baseline], rows)
            found += [tornado] if tornado else []
    return found


def _series(
    plan: Plan, paper: Published, varied: Mapping[str, Varied]
) -> dict[str, dict[str, list[float]]]:
    """Return, by trend, the series that every setting makes, by its words; incomplete ones not.

    A trend from rigid to flexible bodies has none, since these runs are all rigid.
    """
    found: dict[str, dict[str, list[float]]] = {}
    for trend in paper.trends:
        if not all(name in varied for name in trend.runs):
            continue
        runs = [varied[name] for name in trend.runs]
        if len({one.baseline for one in runs}) < len(runs):
            continue
        numbers = [{AS_THEY_ARE: (OBSERVED, one.baseline, False)} for one in runs]
        for known, one in zip(numbers, runs, strict=True):
            for setting, index in one.settings:
                known[setting.words] = (setting.model or OBSERVED, index, setting.whole_run)
        labels = [label for label in numbers[0] if all(label in known for known in numbers)]
        found[trend.name] = {
            label: [value for value in series if value is not None]
            for label in labels
            if None
            not in (
                series := [
                    observed(plan[index], trend.measure, model, whole=whole)
                    for model, index, whole in (known[label] for known in numbers)
                ]
            )
        }
    return found
