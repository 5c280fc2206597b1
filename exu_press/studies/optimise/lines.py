"""An optimum as a person reads it in a terminal."""

import numpy as np

from exu_press.quantities import quantity_of
from exu_press.quantities.uncertain import significant, uncertain
from exu_press.studies.optimise.run import Report
from exu_press.studies.sweep.units import with_unit
from exu_press.terminal.columns import columns

__all__ = ["beyond_end", "report_lines"]

MOST_LINES = 14
"""Most lines of a front: evenly along it, the chosen point always."""


def report_lines(report: Report) -> list[str]:
    """Return how it was searched, the front, and the chosen point at a tenth of the tolerance."""
    study, number = report.study, len(report.places)
    several = len(study.objective) > 1
    lines = [*report.told, f"method: {report.method} ({report.why})"]
    quantities = {
        name: quantity_of(study.scene, name).quantity.in_scaled_unit(report.numbers(name))
        for name in study.quantities
    }
    heads = (with_unit(name, quantity.display_unit) for name, quantity in quantities.items())
    rows = [("", *map(with_unit, study.keys), *heads)]
    shown = sorted({report.chosen, *np.linspace(0, number - 1, MOST_LINES).astype(int).tolist()})
    for n in shown:
        point = report.trials.points[report.places[n]]
        cells = [f"{v:.4g}" if isinstance(v, float) else str(v) for v in point.values()]
        mark = "chosen" if n == report.chosen else f"{n + 1:02}"
        numbers = (_number(report, name, n, one.scale) for name, one in quantities.items())
        rows.append((mark, *cells, *numbers))
    lines += columns(rows)
    if several:
        left = f", {len(shown)} of them shown" if len(shown) < number else ""
        lines.append(
            f"{number} of {len(report.trials.points)} points are not worse than another in "
            f"everything{left}"
        )
    lines += [beyond_end(name) for name in report.at_ends]
    for name, value in report.finer.items():
        quantity = quantities[name]
        before = float(report.numbers(name)[report.chosen])
        change = "the same" if value == before else f"{100 * (value / before - 1):+.2g} %"
        lines.append(
            f"chosen, at a tenth of the tolerance: {name} "
            f"{significant(value * quantity.scale, 5)} {quantity.display_unit} ({change})"
        )
    return lines


def beyond_end(name: str) -> str:
    """Return the line of a key whose best value is the last one of its range."""
    return f"chosen: {name} lies on the end of its range; a wider range may have a better point"


def _number(report: Report, name: str, place: int, scale: float) -> str:
    value, error = float(report.numbers(name)[place]), float(report.errors[name][place])
    told = None if np.isnan(error) else {"error": error, "determined": True}
    return uncertain(value, told, scale, 5)
