"""The report of a motion in the long run: period, exponent, figures over revolutions."""

import math
from dataclasses import dataclass
from typing import Any

from exu_press.files.output_directory import plain_data
from exu_press.quantities.units import shown_unit, with_unit
from exu_press.scene import Scene
from exu_press.studies.attractor.motion import Attractor
from exu_press.studies.base.report import Column, Points, Report, Table, quantity_column

__all__ = ["AttractorReport"]


@dataclass(frozen=True)
class AttractorReport(Report):
    """The motion of a press in the long run."""

    name = "attractor"
    files = ("attractor.json",)
    heading = "In the long run"
    drawn = (("attractor", "Section, phase portrait, transient, orders, values by revolution."),)

    motion: Attractor

    @property
    def subtitle(self) -> str:
        """Section and length."""
        return (
            f"section at crank angle {self.scene.start_angle_deg:g} deg, "
            f"{len(self.motion.points)} revolutions after {self.motion.skip}"
        )

    @property
    def scene(self) -> Scene:
        """The scene."""
        return self.motion.scene

    @property
    def failures(self) -> list[str]:
        """Reasons why there are fewer revolutions, or no period."""
        period = self.motion.period
        undecided = [] if period.is_decided else [f"the period is {period}"]
        return [self.motion.stopped, *undecided] if self.motion.stopped else undecided

    def tables(self) -> list[Table]:
        """Return period, exponent, and mean, scatter and percentiles of each figure."""
        head = ("quantity", "mean", "scatter", "5 %", "50 %", "95 %")
        lines = [self.subtitle, *self._period(), *self._exponent()]
        rows = [self._figure(name) for name in self.motion.units]
        return [Table("Motion", head, rows, above=lines)]

    def points(self) -> Points:
        """Return every revolution: its point in the section and its figures."""
        motion = self.motion
        numbers = [motion.skip + 1 + k for k in range(len(motion.points))]
        section = [
            Column(f"section, coordinate {k + 1}", "", column)
            for k, column in enumerate(motion.points.T.tolist())
        ]
        figures = [
            quantity_column(name, plain_data(values), default_unit=motion.units[name])
            for name, values in motion.figures.items()
        ]
        labels = [f"revolution {number}" for number in numbers]
        across, up = section[0].name, section[1 % len(section)].name
        columns = [*section, *figures]
        revolution = Column("revolution", "", numbers)
        return Points([revolution], columns, labels, across, up, "revolution", "Revolutions")

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of attractor.json."""
        return self.motion.to_dict()

    def _period(self) -> list[str]:
        motion, period = self.motion, self.motion.period
        lines = [
            f"period: {period}",
            f"  points 1 revolution apart differ by up to {period.distances[0]:.2g}, known within "
            f"{motion.error:.2g} (clearances)",
        ]
        if not period.is_decided and period.finer < 1.0:
            name, present = self.scene.solver.accuracy
            lines.append(f"  try --set solver.{name}={period.finer * present:.1g}")
        return lines

    def _exponent(self) -> list[str]:
        exponent, (value, low, high) = self.motion.exponent, self.motion.per_second
        if math.isfinite(low):
            text = f"{value:.3g} 1/s, 95 % in [{low:.3g}, {high:.3g}]; per revolution "
            text += f"{exponent.value:.3g} [{exponent.low:.3g}, {exponent.high:.3g}]"
        elif not math.isfinite(high):
            text = "not known of so few revolutions"
        else:
            text = f"below {high:.3g} 1/s ({exponent.high:.3g} per revolution): "
            text += (
                "neighbours come together within the error of a revolution"
                if high < 0.0
                else "neighbours part by no more than the error of a revolution may hide"
            )
        return [f"largest Lyapunov exponent: {text}", f"  motion: {exponent.sign}"]

    def _figure(self, name: str) -> list[str]:
        distribution = self.motion.distributions.get(name)
        values = distribution.mean[:1] if distribution else ()
        unit, scale = shown_unit(name, values, self.motion.units[name])
        head = with_unit(name, unit)
        if distribution is None:
            return [head, *["-"] * 5]
        mean, mean_error, scatter, scatter_error = (
            scale * value for value in (*distribution.mean, *distribution.scatter)
        )
        percentiles = (
            [scale * value for value in bounds] for bounds in distribution.percentiles.values()
        )
        return [
            head,
            f"{mean:.6g} +- {mean_error:.2g}",
            f"{scatter:.2g} +- {scatter_error:.1g}",
            *(f"{value:.5g} [{low:.5g}, {high:.5g}]" for value, low, high in percentiles),
        ]
