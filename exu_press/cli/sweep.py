"""Run many scenes, as a study file says: table.csv, table.nc and a picture; may be interrupted."""

import argparse
from typing import Any

from exu_press.cli.study import study_command
from exu_press.errors import InputError

__all__ = ["EXAMPLE", "add_arguments", "execute"]


def _add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--over",
        action="append",
        default=[],
        metavar="KEY",
        help="key on a picture's axis; at most twice (default: the first two that vary)",
    )
    parser.add_argument(
        "--show",
        action="append",
        default=[],
        metavar="COLUMN",
        help="print and draw this column of the table; may be repeated",
    )


def _asked(options: argparse.Namespace, study: Any) -> dict[str, list[str]]:
    from exu_press.quantities import quantities_of

    unknown = [key for key in options.over if key not in study.keys]
    if unknown:
        raise InputError(f"--over {unknown[0]}: allowed are {', '.join(study.keys)}")
    for name in options.show:
        if not any(name in quantities_of(scene) for scene in study.scenes):
            raise InputError(
                f"--show {name}: allowed are {', '.join(quantities_of(study.scenes[0]))}"
            )
    return {"over": options.over, "show": options.show}


def _stopped(table: Any) -> str:
    from exu_press.parallel.task import FAILED, TIME_LIMIT, WORKER_DIED

    failed = set(table["status"]) <= {FAILED, TIME_LIMIT, WORKER_DIED}
    return f"no run reached an end: {table['reason'][0]}" if failed else ""


EXAMPLE, add_arguments, execute = study_command(
    "sweep",
    "Sweep",
    "sweep.sweep_figures",
    ("table.csv", "table.nc"),
    example="exu-press sweep study.toml --workers 2 --out out/study",
    add=_add,
    asked=_asked,
    warned=lambda study, table: study.scenes,
    stopped=_stopped,
)
