"""A wear study on the terminal."""

from exu_press.quantities import quantity_of
from exu_press.quantities.uncertain import significant
from exu_press.studies.sweep.units import with_unit
from exu_press.studies.wear.run import Report
from exu_press.terminal.columns import columns

__all__ = ["report_lines"]

MOST = 12
"""Points that are shown, the first and the last of them always."""


def report_lines(report: Report) -> list[str]:
    """Return strokes, clearances and quantities point by point, and how it ended."""
    study, points = report.study, report.points
    heads, bodies = ["strokes"], [[significant(point.strokes, 4) for point in points]]
    for joint in study.joints:
        heads.append(f"{joint.replace('_', ' ')} clearance, um")
        bodies.append([f"{1e6 * value:.5g}" for value in report.clearances(joint)])
    for name in study.names:
        values = report.values(name)
        quantity = quantity_of(study.scene, name).quantity.in_scaled_unit(filter(None, values))
        heads.append(with_unit(name, quantity.display_unit))
        digits = 7 if quantity.unit == "m" else 4
        bodies.append(
            [
                "-" if value is None else significant(value * quantity.scale, digits)
                for value in values
            ]
        )
    rows = list(zip(*bodies, strict=True))
    shown = rows
    if len(rows) > MOST:
        at = sorted({round(i * (len(rows) - 1) / (MOST - 1)) for i in range(MOST)})
        shown = [rows[i] for i in at]
    last = points[-1]
    lines = columns([heads, *shown], right=True)
    lines.append(
        f"{significant(last.strokes, 4)} strokes in {report.jumps}; a jump and its "
        f"halves differ by {1e6 * last.error:.2g} um in all"
    )
    lines += [
        f"worn off the guideways of {body}: {1e6 * depth:.3g} um"
        for body, depth in last.ways.items()
    ]
    return lines
