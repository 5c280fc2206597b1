"""exu-press: finds the command, turns errors into one line and an exit status."""

import argparse
import os
import signal
import sys
from collections.abc import Sequence
from importlib import import_module
from types import ModuleType

from exu_press import __version__
from exu_press.errors import InputError

__all__ = ["main"]

COMMANDS = (
    "new",
    "run",
    "compare",
    "sweep",
    "precision",
    "stability",
    "doctor",
    "view",
    "report",
)
"""Modules beside this one, loaded by `main` and not before."""

INTERRUPTED = 130
CLOSED_PIPE = 141
"""As a shell says of a program that SIGINT or SIGPIPE ended."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command.

    Returns:
        0 at its end, 2 for wrong input, 3 if an integration stopped early; 130 after Ctrl-C, 141
        where the reader of the output has gone.
    """
    try:
        status = _execute(arguments)
        sys.stdout.flush()
    except InputError as error:
        print(f"exu-press: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("exu-press: interrupted", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        for stream in (sys.stdout, sys.stderr):  # Python flushes them once more at its end
            os.dup2(nowhere, stream.fileno())
        return CLOSED_PIPE
    return status


def _loaded() -> dict[str, ModuleType]:
    """Return the modules of all commands; Ctrl-C meanwhile ends the process without a word.

    An exception inside the start of a compiled module would come out as any other one.
    """
    usual = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if usual:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        return {name: import_module(f"exu_press.cli.{name}") for name in COMMANDS}
    finally:
        if usual:
            signal.signal(signal.SIGINT, signal.default_int_handler)


def _execute(arguments: Sequence[str] | None) -> int:
    """Parse the arguments and run the command that they name."""
    parser = argparse.ArgumentParser(
        prog="exu-press",
        description="Dynamics of press mechanisms with clearance and lubrication in their joints.",
        epilog="example: exu-press compare press --out out/compare",
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, module in _loaded().items():
        summary = (module.__doc__ or "").splitlines()[0]
        command = commands.add_parser(
            name,
            help=summary,
            description=summary,
            epilog=f"example: {module.EXAMPLE}",
        )
        module.add_arguments(command)
        command.set_defaults(execute=module.execute)
    options = parser.parse_args(arguments)
    return int(options.execute(options))
