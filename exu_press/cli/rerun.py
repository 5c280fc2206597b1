"""Repeat a run and say whether its figures agree; changed inputs are refused unless allowed."""

import argparse
import shlex
import textwrap
from pathlib import Path
from typing import NoReturn

from exu_press.cli.options import add_code_argument, scene_path
from exu_press.errors import InputError
from exu_press.files.digests import locate
from exu_press.files.output_directory import check_writable
from exu_press.integrate import SolverStatus
from exu_press.report.find import Kind, find_run
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.scene.provenance import Provenance, changed_inputs
from exu_press.schema.kinds import import_kinds
from exu_press.verification.agreement import Agreement, agreement
from exu_press.verification.run import simulate_with_errors
from exu_press.verification.simulate import simulate

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press rerun out/press"

DIFFERENT = 1
"""Exit status where figures do not agree."""

MOST_NAMED = 20
"""Figures that are named one by one."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("path", metavar="DIR", help="the directory of a run, or its run.nc")
    parser.add_argument(
        "--changed",
        action="store_true",
        help="run with the inputs as they are now, where they differ from those of the run",
    )
    add_code_argument(parser)
    parser.add_argument("--out", metavar="FILE.nc", help="keep the repeated run")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")


def execute(options: argparse.Namespace) -> int:
    """Repeat the run; return 0, or 1 where figures do not agree."""
    file = find_run(options.path)
    if options.out is not None:
        if Path(options.out).suffix != Path(Kind.RUN.value).suffix:
            raise InputError(f"--out {options.out}: allowed is a name that ends in .nc")
        check_writable(Path(options.out))
        if Path(options.out).resolve() == file.resolve():
            raise InputError(f"--out {options.out}: is the run itself; allowed is another file")
    run = Result.load(file)
    provenance = run.info.get("provenance")
    if provenance is None:
        raise InputError(f"{file}: a version wrote it that noted no inputs; run its scene again")
    changes = _changes(provenance, run.scene, options)
    if options.allow_code:
        import_kinds(run.scene.to_dict())
    scene = _scene_of(run, provenance, options) if changes else _scene_in(run)
    start = Result.load(locate(provenance["start"])) if "start" in provenance else None
    state = None if start is None else start.info["state"]
    if "errors" in run.info:
        repeated = simulate_with_errors(scene, start=state, quiet=options.quiet, interruptible=True)
    else:
        repeated = simulate(scene, start=state, quiet=options.quiet)
        if repeated.info["status"] == SolverStatus.INTERRUPTED.value:
            raise KeyboardInterrupt
    if options.out is not None:
        repeated.save(options.out)
    compared = agreement(run, repeated)
    if not options.quiet:
        print("\n".join([*_change_lines(changes), *_lines(compared, run)]))
    return 0 if compared.agrees else DIFFERENT


def _changes(provenance: Provenance, scene: Scene, options: argparse.Namespace) -> dict[str, str]:
    """Return the inputs that have changed; raise InputError unless --changed allows it."""
    changes = changed_inputs(provenance, scene)
    if changes and not options.changed:
        raise InputError(
            f"{_change_lines(changes)[0]}; allowed is --changed, which runs with them, or the "
            "directory and the files that the run had"
        )
    return changes


def _scene_in(run: Result) -> Scene:
    """Return a run's scene without the revolutions that were added until its oil had settled."""
    scene, added = run.scene, run.info.get("added_revolutions", 0)
    if scene.has_unresolved_kinds:
        scene = Scene.from_dict(scene.to_dict(), scene.asked)  # refuses what is not loaded
    if added:
        asked = {"revolutions": scene.revolutions, "settle": scene.settle_revolutions}
        scene = scene.replace({name: round(value - added, 12) for name, value in asked.items()})
    return scene


def _scene_of(run: Result, provenance: Provenance, options: argparse.Namespace) -> Scene:
    """Return a run's scene from its changed files, solved as the run was."""
    if not provenance["command"].startswith("exu-press run "):
        return _scene_in(run)  # its files are read again when it is built
    earlier = _arguments_of(provenance["command"])
    scene = Scene.load(scene_path(earlier.scene), earlier.set, allow_code=options.allow_code)
    solver = run.scene.solver
    if solver.tolerance is not None:  # --within or errors may have made it finer
        scene = scene.replace({"solver.tolerance": solver.tolerance})
    return scene


def _arguments_of(command_line: str) -> argparse.Namespace:
    """Return the arguments of a run's command; raise InputError if it is none."""
    from exu_press.cli import run as command

    class Parser(argparse.ArgumentParser):
        def error(self, message: str) -> NoReturn:
            raise ValueError(message)

    parser = Parser(prog="exu-press run", add_help=False, allow_abbrev=False)
    command.add_arguments(parser)
    try:
        return parser.parse_args(shlex.split(command_line)[2:])
    except ValueError as error:
        raise InputError(
            f"the command of the run, {command_line!r:.200}, is none of this version: "
            f"{error!s:.200}"
        ) from None


def _change_lines(changes: dict[str, str]) -> list[str]:
    """Return which inputs have changed, in a line, or nothing."""
    texts = ", ".join(f"{name} ({how})" for name, how in changes.items())
    return [f"inputs differ from those of the run: {texts}"] if changes else []


def _lines(compared: Agreement, run: Result) -> list[str]:
    total = len(compared.identical) + len(compared.within) + len(compared.different)
    if len(compared.identical) == total:
        return [f"all {total} figures are identical in all digits"]
    lines = [
        f"of {total} figures {len(compared.identical)} are identical in all digits, "
        f"{len(compared.within)} agree within both stated errors, "
        f"{len(compared.different)} do not agree"
    ]
    if compared.different and "errors" not in run.info:
        lines.append("the run has no errors (--no-error), so that only equal digits agree")
    for name, text in list(compared.different.items())[:MOST_NAMED]:
        lines += textwrap.wrap(f"  {name}: {text}", 100, subsequent_indent="    ")
    more = len(compared.different) - MOST_NAMED
    return [*lines, f"  and {more} more"] if more > 0 else lines
