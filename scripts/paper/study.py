"""The study: all runs as one batch, then what they give with each reading of the damping."""

from functools import partial
from pathlib import Path

from exu_press.batch import run_batch
from exu_press.output import output_directory
from paper import clearance as choosing
from paper.damping import DAMPINGS
from paper.plan import Plan
from paper.planned import Amount, Planned
from paper.published import published
from paper.report import Report
from paper.rows import frequency_rows
from paper.runs import REVOLUTIONS
from paper.settings import QUICK, SETTINGS
from paper.tasks import observe, part_frequencies

__all__ = ["paper"]

TIME_LIMIT = 300.0  # s for one run

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


def paper(
    directory: str | Path, *, quick: bool = False, workers: int | None = None, quiet: bool = True
) -> Report:
    """Run section 5, the sensitivity study and the study of the clearance, with each damping.

    Args:
        directory: for the runs; called again, the study goes on where it was stopped.
        quick: rigid bodies, a tenth of a revolution, three factors: tries the machinery only.
        workers: processes; all cores unless told.
        quiet: False shows the progress on standard error.

    Raises:
        InputError: the directory cannot be used.
    """
    amount = REDUCED if quick else FULL
    directory = output_directory(directory)
    run_all = partial(
        run_batch, directory=directory, workers=workers, time_limit=TIME_LIMIT, quiet=quiet
    )
    plan = Plan()
    planned = {damping: Planned(plan, amount, directory, damping) for damping in DAMPINGS}
    plan.run(lambda tasks: run_all(observe, tasks, label="runs"))
    tasks = [
        {"part": entry.part, "mesh_size": amount.mesh_size, "modes": max(entry.mode_numbers)}
        for entry in published().frequencies
    ]
    parts = {
        str(task["part"]): row
        for task, row in zip(tasks, run_all(part_frequencies, tasks, label="parts"), strict=True)
    }
    return Report(
        quick=quick,
        findings={damping: one.findings() for damping, one in planned.items()},
        frequencies=tuple(frequency_rows(parts)),
    )
