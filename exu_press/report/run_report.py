"""The report of a run: a process beside it loads what draws, and draws beside the rest."""

from pathlib import Path
from typing import TYPE_CHECKING

from exu_press.report.page_file import ALL, Span
from fe_models.processes import performed_beside

if TYPE_CHECKING:
    from exu_press.result import Result

__all__ = ["file_report", "run_report"]


def run_report(result: "Result", source: str) -> str:
    """Return the page of a run; `source` is shown, as the name of its file."""
    from exu_press.report.run import run_page

    with performed_beside(_pictures) as begin:
        return run_page(result, source, ALL, begin(result))


def file_report(file: Path, span: Span = ALL) -> str:
    """Return the page of a stored run, with the pictures beside it if these are the run's.

    The process reads the run again that would be in memory twice, or has kinds whose code is not
    loaded: these are not passed on.

    Args:
        file: of the run.
        span: begin and end of its curves, s; None: those of the record.
    """
    with performed_beside(_pictures) as begin:
        loaded = begin(None)
        from exu_press.report.run import run_page  # while the process loads what draws
        from exu_press.result import Result
        from exu_press.result.channels import is_on_disk

        result = Result.load(file)
        reads = is_on_disk(result.channels) or any(kind.module for _, kind in result.scene.kinds())
        drawn = begin(file if reads else result, file.parent)
        name = f"{file.resolve().parent.name}/{file.name}"
        return run_page(result, name, span, lambda: loaded() + drawn())


def _pictures(run: "Result | Path | None", directory: Path | None = None) -> str:
    """Return the pictures of a run or its file; of nothing, load what draws them."""
    from exu_press.report.pictures import run_pictures
    from exu_press.result import Result

    run = Result.load(run) if isinstance(run, Path) else run
    return "" if run is None else run_pictures(run, directory)
