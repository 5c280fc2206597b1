"""Compare scenes, runs and measured curves; one scene alone: rigid, flexible, dry, lubricated."""

import argparse
import itertools
import sys
from collections.abc import Iterable, Mapping, Set
from pathlib import Path
from typing import Any

from exu_press.cli.options import (
    add_error_argument,
    add_run_arguments,
    directory_of,
    scene_path,
    shipped_names,
    show_warnings,
)
from exu_press.errors import InputError, error_prefix
from exu_press.files.lock import lock_directory
from exu_press.files.output_directory import (
    COMPARED,
    COMPARISON_FILE,
    RUN_FILE,
    folder_name,
    output_directory,
    remove_pictures,
    replacing,
    subdirectory,
    write_json,
)
from exu_press.report.find import find_run
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.schema.csv_table import write_csv
from exu_press.studies.compare import variants
from exu_press.studies.comparison import Comparison
from exu_press.studies.curve_comparison import (
    MEASURED,
    MEASURED_PICTURE,
    CurveComparison,
    compare_curve,
    comparison_rows,
)
from exu_press.studies.curve_file import CurveFile, read_curve
from exu_press.studies.equal_windows import (
    require_common_window,
    simulate_equal_windows,
    with_equal_windows,
)
from exu_press.terminal.columns import columns

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press compare press my_press.toml out/first/run.nc --out out/compare"

CURVES = ".csv"
"""Ending of the files of measured curves, and of a table of all quantities."""

SCENES = "", ".toml"
"""Endings of the files of scenes."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "given",
        nargs="+",
        metavar="A",
        help="a scene file, the name of a shipped scene ("
        f"{', '.join(shipped_names())}), a {RUN_FILE} or the directory of one, or a CSV file of a "
        "measurement with a head as time (s),slider_acceleration (m/s^2); one scene alone is "
        "compared with ideal, dry and lubricated joints, with rigid and with flexible bodies",
    )
    parser.add_argument(
        "--wide",
        action="store_true",
        help="print names in full and two digits of every error, in wider columns, and in which "
        "figures runs surely differ; --csv has all digits",
    )
    parser.add_argument(
        "--csv",
        metavar="FILE",
        type=Path,
        help="write every quantity of every run, in SI, with its error and bounds",
    )
    add_run_arguments(parser, "compare; of one scene alone out/SCENE")
    add_error_argument(parser)


def execute(options: argparse.Namespace) -> int:
    """Run every scene, read every result; return 0, or 3 if a run stopped early."""
    files = [Path(name) for name in options.given if Path(name).suffix.lower() == CURVES]
    curves = {file: read_curve(file) for file in files}
    runs = [name for name in options.given if Path(name) not in curves]
    compared, left_out = _load_items(runs, options.set, options.allow_code, measured=bool(curves))
    for line in left_out if not options.quiet else ():
        print(f"exu-press: {line}", file=sys.stderr)
    stored = {label: result for label, result in compared.items() if isinstance(result, Result)}
    if not options.no_pictures:
        from exu_press.plots.file import save_figures
        from exu_press.plots.save import comparison_figures, sources_of
        from exu_press.studies.measured_figure import measured_figure

        # they are refused here, where their files keep too little
        figures = comparison_figures(stored) if stored else {}
    _compare_curves(curves, stored)  # which refuses those that a run does not have
    require_common_window(compared)  # before anything is run or written
    if len(stored) > 1:
        with_equal_windows(stored)
    target = directory_of(options, options.given[0] if len(options.given) == 1 else "compare")
    sources = {file.resolve() for file in (*files, *map(_file_of, runs))}
    for label in compared:
        _check_replaceable(target / folder_name(label) / RUN_FILE, sources)
    if options.csv is not None:
        _check_table(options.csv, target, sources)
    with lock_directory(output_directory(target)) as directory:
        results, summaries = _run_all(compared, directory, options)
        comparison = Comparison(results)
        if options.csv is not None:
            write_csv(options.csv, comparison.columns())
        measured = _compare_curves(curves, results)
        differences = {
            name: {run: comparison.plain() for run, comparison in runs.items()}
            for name, runs in measured.items()
        }
        if measured:
            write_json(directory / MEASURED, differences)
        if not options.no_pictures:
            if list(results) != list(stored):
                figures = comparison_figures(results)
            if measured:
                figures[MEASURED_PICTURE] = measured_figure(measured)
            save_figures(figures, directory, sources_of(results))
    if not options.quiet:
        print("\n".join(comparison.lines(wide=options.wide)))
        for name, runs_beside in differences.items():
            print("\n".join([*columns(comparison_rows(name, runs_beside)), ""]))
        labels: dict[str, list[str]] = {}
        for label, summary in summaries.items():
            for warning in summary["warnings"]:
                labels.setdefault(warning, []).append(label)
        texts = (f"{', '.join(names)}: {warning}" for warning, names in labels.items())
        show_warnings(texts, directory / COMPARISON_FILE)
        print(f"written to {directory}")
    stopped = {label: s["reason"] for label, s in summaries.items() if s["reason"]}
    for label, reason in stopped.items():
        how = "" if results[label].completed else "stopped early: "
        print(f"exu-press: {label}: {how}{reason}", file=sys.stderr)
    return 3 if stopped else 0


def _file_of(name: str) -> Path:
    """Return the file that is meant: of a directory, its run's."""
    path = Path(name)
    return find_run(path) if path.is_dir() else path


def _check_replaceable(path: Path, sources: Set[Path]) -> None:
    """Refuse to replace a run that is compared, or that no comparison wrote."""
    if path.resolve() in sources:
        reason = "it is one of the runs to compare"
    elif path.exists() and not (path.parent / COMPARED).exists():
        reason = "no comparison wrote it"
    else:
        return
    raise InputError(
        f"{path}: would be replaced, and {reason}; allowed is a folder without such a run: choose "
        "another one with --out"
    )


def _check_table(path: Path, target: Path, sources: Set[Path]) -> None:
    """Refuse a file of --csv that is no table, or is compared, or whose folder is not there."""
    if path.suffix.lower() != CURVES:
        raise InputError(f"--csv {path}: allowed is a name that ends in {CURVES}")
    if path.resolve() in sources:
        raise InputError(f"--csv {path}: is one of the files to compare; allowed is another file")
    folder = path.parent
    if not folder.is_dir() and folder.resolve() != target.resolve():  # made for the results
        raise InputError(f"--csv {path}: there is no folder {folder}; make it first")


def _run_all(
    compared: Mapping[str, Scene | Result], directory: Path, options: argparse.Namespace
) -> tuple[dict[str, Result], dict[str, dict[str, Any]]]:
    """Return results and summaries by label, each saved before the next run begins."""
    folders = {label: subdirectory(directory, folder_name(label)) for label in compared}
    remove_pictures(directory, "compare")
    (directory / MEASURED).unlink(missing_ok=True)
    results: dict[str, Result] = {}
    summaries: dict[str, dict[str, Any]] = {}
    scenes = {label: item for label, item in compared.items() if isinstance(item, Scene)}
    stored = ((label, item) for label, item in compared.items() if isinstance(item, Result))
    runs = simulate_equal_windows(scenes, errors=not options.no_error, quiet=options.quiet)
    for label, result in itertools.chain(stored, runs):
        results[label], summaries[label] = result, result.summary()
        remove_pictures(folders[label], "run")
        with replacing(folders[label] / COMPARED):
            pass
        result.save(folders[label] / RUN_FILE)
        write_json(folders[label] / "summary.json", summaries[label])
        in_order = {name: summaries[name] for name in compared if name in summaries}
        write_json(directory / COMPARISON_FILE, in_order)
    return {label: results[label] for label in compared}, in_order


def _label(name: str, labels: Iterable[str]) -> str:
    """Return a name with the first number that makes its folder another one than the labels'.

    Folders differ on systems, too, that do not tell large letters from small ones.
    """
    taken = {folder_name(label).casefold() for label in (*labels, COMPARISON_FILE, MEASURED)}
    numbered = (f"{name} {number}" for number in itertools.count(2))
    return next(
        label
        for label in itertools.chain([name], numbered)
        if folder_name(label).casefold() not in taken
    )


def _compare_curves(
    curves: Mapping[Path, CurveFile], results: Mapping[str, Result]
) -> dict[str, dict[str, CurveComparison]]:
    """Return measured curves beside runs by label, by the names of their files."""
    stems = [file.stem for file in curves]
    comparisons: dict[str, dict[str, CurveComparison]] = {}
    for file, curve in curves.items():
        name = file.stem if stems.count(file.stem) == 1 else str(file)
        comparisons[name] = {}
        for label, result in results.items():
            with error_prefix(f"{label}: "):
                comparisons[name][label] = compare_curve(file, curve, result)
    return comparisons


def _load_items(
    names: list[str], assignments: list[str], allow_code: bool, *, measured: bool
) -> tuple[Mapping[str, Scene | Result], list[str]]:
    """Return scenes and results by label, and why variants of a scene are left out.

    Beside a `measured` curve one run may be alone.
    """
    if not names:
        raise InputError("a measurement alone; allowed are scenes or results beside it")
    items: dict[str, Scene | Result] = {}
    for name in names:
        file = _file_of(name)
        if file.suffix == ".nc":
            item: Scene | Result = Result.load(file)
        elif Path(name).is_file() and Path(name).suffix not in SCENES:
            raise InputError(
                f"{name}: allowed is a scene (.toml), a {RUN_FILE} or the directory of one, or a "
                f"measurement ({CURVES})"
            )
        else:
            item = Scene.load(scene_path(name), assignments, allow_code=allow_code)
        label = file.resolve().parent.name if file.name == RUN_FILE else Path(name).stem
        items[_label(label, items)] = item
    scenes = [item for item in items.values() if isinstance(item, Scene)]
    if assignments and not scenes:
        raise InputError(f"--set {assignments[0]}: changes scenes, and none is given")
    if len(items) > 1 or measured:
        return items, []
    if not scenes:
        raise InputError(f"{names[0]}: a result alone; allowed are two or more, or a scene alone")
    return variants(scenes[0])
