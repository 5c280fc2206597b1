"""exu-press: finds the command, turns errors into one line and an exit status."""

import argparse
import io
import os
import signal
import sys
import warnings
from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from importlib import import_module
from pathlib import Path
from typing import Any, TextIO

import exu_press
from exu_press.errors import InputError
from exu_press.files.command import executing
from exu_press.files.digests import recorded_files
from exu_press.schema.kinds import describe_own_error
from exu_press.studies.registry import STUDIES, study_command, study_source
from fe_models.errors import disk_full
from fe_models.temporary import remove_abandoned

__all__ = ["COMMANDS", "load_command", "main"]

COMMANDS = (
    "new",
    "draw",
    "run",
    "rerun",
    "spectrum",
    "compare",
    *STUDIES,
    "doctor",
    "view",
    "report",
)
"""Studies, and modules beside this one; the one that is asked for is loaded, which takes up to a
second."""

STOPPED = 3
"""Exit status of a command that could not get to its end."""

INTERRUPTED = 130
CLOSED_PIPE = 141
"""Exit statuses that a shell gives a program that SIGINT or SIGPIPE ended."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command.

    Returns:
        0 at its end, 2 for wrong input, 3 if an integration stopped early or a disk is full; 130
        after Ctrl-C, 141 where the reader of the output has gone.
    """
    _open_closed_streams()
    if isinstance(sys.stdout, io.TextIOWrapper):  # a name that the console lacks letters for
        sys.stdout.reconfigure(errors="backslashreplace")
    os.environ.pop("MPLBACKEND", None)  # pictures go to files: no window of matplotlib is opened
    try:
        status = _execute(arguments)
        sys.stdout.flush()
    except InputError as error:
        print(f"exu-press: {error}", file=sys.stderr)
        return error.exit_status
    except KeyboardInterrupt:
        print("exu-press: interrupted", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        _discard(sys.stdout, sys.stderr)
        return CLOSED_PIPE
    except OSError as error:  # of a path that no system takes, a disk that is full, and the like
        full = disk_full(error, error.filename or "standard output")
        where = error.filename or "the system"
        message = full or InputError(f"{where}: {error.strerror or error}")
        print(f"exu-press: {message}", file=sys.stderr)
        if full is not None:
            _discard(sys.stdout)
        return 2 if full is None else STOPPED
    except Exception as error:
        if (text := describe_own_error(error)) is None:
            raise
        print(f"exu-press: {text}", file=sys.stderr)
        return 2
    return status


def _discard(*streams: TextIO) -> None:
    """Send what streams still hold to the null device: Python flushes them once more at its end."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in streams:
        with suppress(OSError):  # no stream of the system
            os.dup2(nowhere, stream.fileno())


def _open_closed_streams() -> None:
    """Open the standard streams that a caller closed (as `>&-` does) on the null device.

    Else a file that is opened later takes the number of one of them, and is printed into.
    """
    for name, number, mode in (("stdin", 0, "r"), ("stdout", 1, "w"), ("stderr", 2, "w")):
        with suppress(OSError):
            os.fstat(number)
            continue
        os.open(os.devnull, os.O_RDWR)  # takes the least free number, which is this one
        setattr(sys, name, os.fdopen(number, mode, encoding="utf-8", closefd=False))


def load_command(name: str) -> Any:
    """Return the module of a command, or a study's command; None for an unknown name.

    Ctrl-C meanwhile ends the process without a word: an exception inside the start of a compiled
    module would come out as any other one.
    """
    usual = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if usual:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        if name in COMMANDS and name not in STUDIES:
            return import_module(f"exu_press.cli.{name}")
        study = study_command(name)
        return None if study is None else import_module("exu_press.cli.study").command_of(study)
    finally:
        if usual:
            signal.signal(signal.SIGINT, signal.default_int_handler)


def _summary(name: str) -> str:
    """Return the first line of a command's module, which is not loaded for it."""
    file = study_source(name) if name in STUDIES else Path(__file__).with_name(f"{name}.py")
    text = file.read_text(encoding="utf-8")
    return text.partition("\n")[0].strip('"')


def _execute(arguments: Sequence[str] | None) -> int:
    words = sys.argv[1:] if arguments is None else list(arguments)
    for text in words:
        if "\0" in text:
            raise InputError(f"{text}: allowed are texts without a zero character")
    parser = argparse.ArgumentParser(
        prog="exu-press",
        description="Dynamics of press mechanisms with clearance and lubrication in their joints.",
        epilog="example: exu-press compare press --out out/compare",
    )
    # to find it takes as long as all else here, in which Ctrl-C would meet Python's imports
    version = f"%(prog)s {exu_press.__version__}" if "--version" in words else ""
    parser.add_argument("--version", action="version", version=version)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    named = next(iter(words), "-")
    registered = None
    if named not in COMMANDS and not named.startswith("-"):
        registered = load_command(named)  # of an installed distribution
    for name in [*COMMANDS, named] if registered else COMMANDS:
        summary = "a study that is installed" if name not in COMMANDS else _summary(name)
        command = commands.add_parser(name, help=summary, description=summary)
        if name == named:
            module = registered or load_command(name)
            command.epilog = f"example: {module.EXAMPLE}"
            module.add_arguments(command)
            command.set_defaults(execute=module.execute)
    options = parser.parse_args(words)
    remove_abandoned()
    usual, warnings.formatwarning = warnings.formatwarning, _format_warning
    try:
        with executing(["exu-press", *words]), recorded_files(), _drawing(options):
            return int(options.execute(options))
    finally:
        warnings.formatwarning = usual


def _drawing(options: argparse.Namespace) -> AbstractContextManager[None]:
    """Return the block in which pictures are drawn as the options say."""
    if "style" not in options:
        return nullcontext()
    from exu_press.cli.options import picture_format_of
    from exu_press.plots.format import drawn_as

    return drawn_as(picture_format_of(options))


def _format_warning(message: Warning | str, *_: object, **__: object) -> str:
    """Return a warning without the line of code that gave it."""
    return f"exu-press: warning: {message}\n"
