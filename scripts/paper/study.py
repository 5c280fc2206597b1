"""The study: all runs as one batch, then the table, what moves its numbers, and the clearance."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from exu_press.batch import run_batch
from exu_press.output import output_directory
from exu_press.scene import Scene
from paper import clearance as choosing
from paper.comparison import observed
from paper.plan import Plan
from paper.published import Published, published
from paper.readings import OBSERVED
from paper.report import Report
from paper.rows import (
    AS_THEY_ARE,
    choice_row,
    frequency_rows,
    number_rows,
    trend_rows,
)
from paper.runs import REVOLUTIONS, paper_runs, rigid_twin
from paper.sensitivity import Tornado, sensitivity_task, tornado_of
from paper.settings import FLEXIBLE, QUICK, SETTINGS, Setting
from paper.tasks import observe, part_frequencies, run_file

__all__ = ["paper"]

FLEXIBLE_NUMBERS = ("acceleration_lubricated", "acceleration_200um")
"""What the flexible sensitivity study looks at: the first of the runs, and the widest clearance."""

TIME_LIMIT = 300.0  # s for one run

Runs = Mapping[str, Mapping[str, Any]]


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


FULL = Amount(
    rigid_only=False,
    revolutions=REVOLUTIONS,
    strokes=4.0,
    settings=SETTINGS,
    alike=choosing.ALIKE,
    separate=choosing.SEPARATE,
    mesh_size=0.02,
)
REDUCED = Amount(
    rigid_only=True,
    revolutions=0.1,
    strokes=0.1,
    settings=tuple(setting for setting in SETTINGS if setting.factor in QUICK),
    alike=(5e-5, 2e-4),
    separate=(5e-5, 2e-4),
    mesh_size=0.06,
)


@dataclass(frozen=True)
class Varied:
    """The runs of one scene with each setting: their numbers in the plan."""

    baseline: int
    settings: tuple[tuple[Setting, int], ...]


def paper(
    directory: str | Path, *, quick: bool = False, workers: int | None = None, quiet: bool = True
) -> Report:
    """Run section 5, the sensitivity study and the study of the clearance.

    Args:
        directory: for the runs; called again, the study goes on where it was stopped.
        quick: rigid bodies, a tenth of a revolution, three factors: tries the machinery only.
        workers: processes; all cores unless told.
        quiet: False shows the progress on standard error.

    Raises:
        InputError: the directory cannot be used.
    """
    amount = REDUCED if quick else FULL
    beside = published().beside("rigid" if amount.rigid_only else "flexible")
    directory = output_directory(directory)
    run_all = partial(
        run_batch, directory=directory, workers=workers, time_limit=TIME_LIMIT, quiet=quiet
    )
    scenes = paper_runs(rigid_only=amount.rigid_only, revolutions=amount.revolutions)
    plan = Plan()
    runs = {
        name: plan.add({"scene": scene.to_dict(), "save": str(run_file(directory, name))})
        for name, scene in scenes.items()
    }
    varied_flexible = {} if amount.rigid_only else _vary(plan, _flexible(scenes), FLEXIBLE)
    chosen_for = scenes["clearance 0.1 mm"]
    alike, separate = choosing.scenes_of(chosen_for, amount.alike, amount.separate, amount.strokes)
    points = {scene: plan.add({"scene": scene.to_dict()}) for scene in (*alike, *separate)}
    varied = _vary(plan, _rigid_twins(beside, scenes), amount.settings)
    plan.run(lambda tasks: run_all(observe, tasks, label="runs"))
    _restore(plan, runs)

    tasks = [
        {"part": entry.part, "mesh_size": amount.mesh_size, "modes": max(entry.mode_numbers)}
        for entry in beside.frequencies
    ]
    parts = {
        str(task["part"]): row
        for task, row in zip(tasks, run_all(part_frequencies, tasks, label="parts"), strict=True)
    }
    rigid = _tornados(plan, beside, varied, "rigid")
    flexible = _tornados(plan, beside, varied_flexible, "flexible")
    choice = _choice(plan, chosen_for, alike, separate, points)
    by_name = {name: plan[number] for name, number in runs.items()}
    return Report(
        quick=quick,
        rows=(
            *number_rows(beside.numbers, by_name, {t.number.name: t for t in rigid}),
            *trend_rows(beside.trends, by_name, _series(plan, beside, varied)),
            choice_row(choice),
            *frequency_rows(parts),
        ),
        runs=by_name,
        tornados=(*rigid, *flexible),
        choice=choice,
        directory=directory,
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
        (one.clearance.crank_pin or 0.0, one.clearance.balls or 0.0, plan[numbers[one]]["reason"])
        for one, point in found.items()
        if point is None and one.clearance is not None
    ]
    return choosing.choose(
        scene,
        [point for one in alike if (point := found[one])],
        [point for one in separate if (point := found[one])],
        stopped,
    )


def _rigid_twins(paper: Published, scenes: Mapping[str, Scene]) -> dict[str, Scene]:
    """Return the rigid twin of every run with clearance that the paper's rows use, by its name."""
    used = [number.run for number in paper.numbers]
    used += [name for trend in paper.trends for name in trend.runs]
    return {
        name: rigid_twin(scenes[name])
        for name in dict.fromkeys(used)
        if scenes[name].clearance is not None
    }


def _flexible(scenes: Mapping[str, Scene]) -> dict[str, Scene]:
    numbers = [number for number in published().numbers if number.name in FLEXIBLE_NUMBERS]
    return {number.run: scenes[number.run] for number in numbers}


def _vary(
    plan: Plan, scenes: Mapping[str, Scene], settings: tuple[Setting, ...]
) -> dict[str, Varied]:
    """Plan every setting on every scene that has what it changes."""
    return {
        name: Varied(
            plan.add({"scene": scene.to_dict()}),
            tuple(
                (setting, plan.add(sensitivity_task(scene, setting)))
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
        numbers = [{AS_THEY_ARE: (OBSERVED, one.baseline)} for one in runs]
        for known, one in zip(numbers, runs, strict=True):
            for setting, index in one.settings:
                label = f"{setting.factor} = {setting.label}"
                known[label] = (setting.model or OBSERVED, index)
        labels = [label for label in numbers[0] if all(label in known for known in numbers)]
        found[trend.name] = {
            label: [value for value in series if value is not None]
            for label in labels
            if None
            not in (
                series := [
                    observed(plan[known[label][1]], trend.measure, known[label][0])
                    for known in numbers
                ]
            )
        }
    return found
