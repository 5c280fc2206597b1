"""The kind of output in a file or a directory, and its page."""

from enum import Enum
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.output_directory import (
    COMPARISON_FILE,
    REPORT_FILE,
    RUN_FILE,
    checkpoint_directory,
)
from exu_press.report.page_file import ALL, Span

__all__ = ["Kind", "find_output", "find_run", "report_of"]


class Kind(Enum):
    """Kinds of output with a page, by the name of a file."""

    RUN = RUN_FILE
    COMPARISON = COMPARISON_FILE
    STUDY = REPORT_FILE


def find_output(path: Path, preferred: Kind | None = None) -> tuple[Kind, Path]:
    """Return a path's kind and the file to read: a result file, or a directory with one of them.

    Args:
        preferred: kind that is taken of a directory with results of several commands.

    Raises:
        InputError: nothing is there, or results of several commands are.
    """
    named = ", ".join(kind.value for kind in Kind)
    if path.is_dir():
        kinds = [kind for kind in Kind if (path / kind.value).is_file()]
        if not kinds and checkpoint_directory(path / Kind.RUN.value).is_dir():
            kinds = [Kind.RUN]
        if not kinds:
            named = named if preferred is None else preferred.value
            raise InputError(f"{path}: has none of {named}; allowed is a directory that has one")
        if preferred in kinds:
            return preferred, path / preferred.value
        if len(kinds) > 1:
            several = " and ".join(kind.value for kind in kinds)
            raise InputError(f"{path}: has {several}; name the file that is meant")
        return kinds[0], path / kinds[0].value
    for kind in Kind:
        if path.name == kind.value:
            return kind, path
    if path.suffix == ".json":
        raise InputError(f"{path}: allowed is a result file (.nc), or a directory with {named}")
    return Kind.RUN, path


def find_run(path: str | Path) -> Path:
    """Return the result file of a run at a path.

    Raises:
        InputError: there is none, or results of another kind.
    """
    kind, file = find_output(Path(path), Kind.RUN)
    if kind is not Kind.RUN:
        raise InputError(
            f"{path}: holds {file.name}; allowed is a run.nc, or the directory that run wrote to"
        )
    return file


def report_of(kind: Kind, file: Path, span: Span = ALL) -> str:
    """Return the page (HTML) of what `find_output` found.

    Args:
        span: begin and end of the curves of runs, s; None: those of the record.

    Raises:
        InputError: the file is of another kind than its name, or the span is not in it.
    """
    if kind is Kind.RUN:
        from exu_press.report.run_report import file_report

        return file_report(file, span)
    if kind is Kind.COMPARISON:
        from exu_press.report.comparison import comparison_report

        return comparison_report(file, span)
    if span != ALL:
        raise InputError(f"--from, --to: {file.name} has no curves over time; allowed for runs")
    from exu_press.report.study import study_page

    return study_page(file)
