"""Long-run dynamics in a terminal."""

import math

from exu_press.studies.attractor.study import Attractor
from exu_press.studies.sweep.units import shown_unit, with_unit
from exu_press.terminal.columns import columns

__all__ = ["attractor_lines"]


def attractor_lines(found: Attractor) -> list[str]:
    """Return period, exponent, and mean, scatter and percentiles of each figure."""
    period, exponent = found.period, found.exponent
    value, low, high = found.per_second
    lines = [
        f"section at crank angle {found.scene.start_angle_deg:g} deg, {len(found.points)} "
        f"revolutions after {found.skip}",
        f"period: {period}",
        f"  points 1 revolution apart differ by up to {period.distances[0]:.2g}, known within "
        f"{found.error:.2g} (clearances)",
    ]
    if not period.told and period.finer < 1.0:
        solver = found.scene.solver
        assert solver is not None
        name = "step" if solver.tolerance is None else "tolerance"
        now = solver.step if solver.tolerance is None else solver.tolerance
        assert now is not None
        lines.append(f"  try --set solver.{name}={period.finer * now:.1g}")
    if math.isfinite(low):
        told = f"{value:.3g} 1/s, 95 % in [{low:.3g}, {high:.3g}]"
        told += f"; per revolution {exponent.value:.3g} [{exponent.low:.3g}, {exponent.high:.3g}]"
    elif not math.isfinite(high):
        told = "not known of so few revolutions"
    else:
        told = f"below {high:.3g} 1/s ({exponent.high:.3g} per revolution): "
        told += (
            "neighbours come together within the error of a revolution"
            if high < 0.0
            else "neighbours part by no more than the error of a revolution may hide"
        )
    lines += [f"largest Lyapunov exponent: {told}", f"  motion: {exponent.sign}"]
    return [*lines, *columns(_figures(found))]


def _figures(found: Attractor) -> list[list[str]]:
    """Return a table of the figures over revolutions."""
    rows = [["quantity", "mean", "scatter", "5 %", "50 %", "95 %"]]
    for name, other in found.units.items():
        one = found.distributions.get(name)
        unit, k = shown_unit(name, one.mean[:1] if one else (), other)
        head = with_unit(name, unit)
        if one is None:
            rows.append([head, *["-"] * 5])
            continue
        scaled = ([k * value for value in each] for each in one.percentiles.values())
        bounds = [f"{at:.5g} [{low:.5g}, {high:.5g}]" for at, low, high in scaled]
        mean, off, scatter, off_scatter = (k * value for value in (*one.mean, *one.scatter))
        told = f"{mean:.6g} +- {off:.2g}", f"{scatter:.2g} +- {off_scatter:.1g}"
        rows.append([head, *told, *bounds])
    return rows
