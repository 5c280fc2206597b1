"""exu-press: finds the command, turns errors into one line and an exit status."""

import argparse
import sys
from collections.abc import Sequence

from exu_press.cli import compare, doctor, precision, report, run, stability, sweep, view
from exu_press.errors import InputError

__all__ = ["main"]

COMMANDS = {
    "run": run,
    "compare": compare,
    "sweep": sweep,
    "precision": precision,
    "stability": stability,
    "doctor": doctor,
    "view": view,
    "report": report,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; return 0 at its end, 2 for wrong input, 3 if an integration stopped early."""
    parser = argparse.ArgumentParser(
        prog="exu-press",
        description="Dynamics of press mechanisms with clearance and lubrication in their joints.",
        epilog="example: exu-press compare press --out out/compare",
    )
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, module in COMMANDS.items():
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
    try:
        return int(options.execute(options))
    except InputError as error:
        print(f"exu-press: {error}", file=sys.stderr)
        return 2
