"""Tables of a work-precision study."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from exu_press.studies.base.report import Table
from exu_press.studies.precision.rows import ERRORS, Row
from exu_press.studies.precision.stated import StatedErrors

__all__ = ["case_table", "horizon_text", "machine_lines", "order_table", "stated_tables"]

INDENT = 2

HEAD = (
    "solver",
    "setting",
    "position",
    "velocity",
    "peak acc.",
    "all peaks",
    "time, s",
    "cpu, s",
    "steps",
    "rejected",
    "Newton",
    "laws",
    "us/step",
    "status",
)

ORDER_HEAD = ("case", "solver", "setting", "position", "velocity", "peak")

STATED_HEAD = ("case", "tolerance", "figures", "covered", "stated/true", "peak: stated", "true")


def machine_lines(machine: Mapping[str, Any], quick: bool) -> list[str]:
    """Return where the times were taken."""
    versions = ", ".join(f"{name} {v}" for name, v in machine["versions"].items() if v)
    load = machine["load"]
    busy = "" if load is None else f", load {load[0]:.1f}"
    lines = [f"{machine['processor']}, {machine['cores']} cores{busy}; {versions}"]
    if quick:
        lines.append("reduced form: short runs, loose references; the times mean nothing")
    return lines


def case_table(name: str, case: Mapping[str, Any], rows: Sequence[Row]) -> Table:
    """Return a case's reference and its runs."""
    reference = case["reference"]
    units = "rad, rad/s" if case["scene"] is None else "m, m/s"
    title = f"{name}: {case['title']}"
    above = [
        title,
        f"  {case['duration']:g} s simulated; {horizon_text(case)}",
        f"  errors up to then, {units} and relative, and of the whole run's peaks where there is a "
        "horizon; < smaller than the reference can tell; * one run, not the median of three",
        f"  reference: {reference['method']}; {_difference(reference)}",
    ]
    below = [f"  {row.solver} {_setting(row)}: {row.reason}" for row in rows if row.reason]
    return Table(title, HEAD, [_cells(row) for row in rows], above, below, INDENT)


def order_table(orders: Sequence[Mapping[str, Any]]) -> Table:
    """Return the observed orders."""
    cells = [
        (
            order["case"],
            order["solver"],
            order["setting"],
            *(_number(order[name], 2) for name in order if name.startswith("error")),
        )
        for order in orders
    ]
    above = "observed orders (slope of the error over the setting, three finest points)"
    return Table("Orders", ORDER_HEAD, cells, [above], indent=INDENT)


def horizon_text(case: Mapping[str, Any]) -> str:
    """Return the horizon in words, and how fast trajectories diverge."""
    rate = case["lyapunov_exponent"]
    how = "" if rate is None or rate <= 0.0 else f" tenfold in {math.log(10.0) / rate:.2g} s"
    if case["horizon"] < case["duration"]:
        return f"horizon {case['horizon']:g} s: trajectories diverge{how}"
    return f"no horizon: trajectories {'diverge' if how else 'stay together'}{how}"


def stated_tables(stated: Sequence[StatedErrors]) -> list[Table]:
    """Return how stated errors cover the true ones, where there are any."""
    cells: list[tuple[str, ...]] = [
        (
            entry.case,
            f"{entry.tolerance:g}",
            str(entry.figures),
            f"{entry.covered / entry.figures:.1%}",
            _number(entry.ratio, 2),
            *((_number(e, 2) for e in entry.peak) if entry.peak else ("-", "-")),
        )
        for entry in stated
        if entry.figures
    ]
    if not cells:
        return []
    above = "stated against true errors of all figures until the horizon; of the peak acceleration"
    return [Table("Stated errors", STATED_HEAD, cells, [above], indent=INDENT)]


def _difference(reference: Mapping[str, Any]) -> str:
    if reference["status"] != "ok":
        return "NO REFERENCE: its integrators are too far apart, or one failed"
    parts = reference["difference"]
    if not any(parts.values()):
        return "exact"
    texts = [f"{_number(value, 2)}" for value in parts.values() if value is not None]
    return f"known to {' / '.join(texts)}"


def _cells(row: Row) -> tuple[str, ...]:
    per_step = None if not row.steps else 1e6 * row.cpu_time / row.steps
    counts = (row.steps, row.rejected_steps, row.newton_iterations, row.law_evaluations)
    return (
        row.solver,
        _setting(row),
        *("<" * (name in row.at_most) + _number(getattr(row, name), 2) for name in ERRORS),
        _number(row.error_peaks, 2),
        f"{row.wall_time:.3g}" + ("" if len(row.wall_times) > 1 else "*"),
        f"{row.cpu_time:.3g}",
        *(_number(count, 7) for count in counts),
        _number(per_step, 3),
        row.status,
    )


def _setting(row: Row) -> str:
    return f"{row.value:g}{' s' if row.setting == 'step' else ''}"


def _number(value: float | None, digits: int) -> str:
    return "-" if value is None else f"{value:.{digits}g}"
