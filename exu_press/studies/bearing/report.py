"""The report of a bearing: its equilibria, stiffness and damping as tables."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from exu_press.plots.words import ONE_LINE, describe
from exu_press.scene.film import MixedFilm
from exu_press.schema.csv_table import Value
from exu_press.studies.base.report import Column, Points, Report, Table
from exu_press.studies.bearing.coefficients import BearingCoefficients, journal_joint
from exu_press.studies.bearing.study import BearingStudy

__all__ = ["BearingReport"]

AXES = ("xx", "xy", "yx", "yy")

Read = Callable[[BearingCoefficients], float | None]

FIGURES: Mapping[str, tuple[str, float, Read]] = {
    "eccentricity_ratio": ("", 1.0, lambda row: row.eccentricity_ratio),
    "min_film": ("um", 1e6, lambda row: row.min_film),
    "attitude": ("deg", math.degrees(1.0), lambda row: row.attitude_angle),
    "side_flow": ("l/min", 6e4, lambda row: row.side_flow),
    "power": ("W", 1.0, lambda row: row.power),
    "pump_power": ("W", 1.0, lambda row: row.pump_power),
    "viscosity": ("Pa s", 1.0, lambda row: row.viscosity),
    "temperature": ("deg C", 1.0, lambda row: row.temperature),
    "critical_mass": ("kg", 1.0, lambda row: row.critical_mass),
}
"""Figure -> its unit, the factor from SI, and how it is read."""


@dataclass(frozen=True)
class BearingReport(Report):
    """A bearing under loads and at speeds."""

    name = "bearing"
    files = ("bearing.json", "bearing.csv")
    drawn = (
        ("bearing", "Pressure around the bearing, the journal's locus, and the coefficients."),
    )

    study: BearingStudy
    rows: Sequence[BearingCoefficients]

    @property
    def title(self) -> str:
        """Heading of the page."""
        return f"Bearing {self.study.joint}: {describe([self.study.scene], ONE_LINE)}"

    @property
    def subtitle(self) -> str:
        """The bearing's sizes and law."""
        kind, film = journal_joint(self.study.scene, self.study.joint)
        tilt = film.law.inclination
        inclined = f", tilt {1e3 * tilt:g} mrad" if tilt else ""
        return (
            f"film.law = {film.law.kind!r}, length {1e3 * film.length:g} mm, radius "
            f"{1e3 * kind.radius:g} mm, clearance {1e6 * kind.clearance:g} um{inclined}"
        )

    def warnings(self) -> list[str]:
        """Return also which films are thinner than rough surfaces leave, or pressed away."""
        _, film = journal_joint(self.study.scene, self.study.joint)
        rough = MixedFilm()
        pressed = [row for row in self.rows if row.min_film < 0.0]
        thin = [row for row in self.rows if row.min_film < rough.contact_gap]
        if not pressed and (film.contact_gap is not None or not thin):
            return super().warnings()
        row = (pressed or thin)[0]
        gap, (load, speed) = 1e6 * row.min_film, self._state(row)
        text = (
            f"press the surfaces {-gap:.3g} um into each other, where no law of a film holds"
            if pressed
            else f"leave a film of {gap:.3g} um, where surfaces of {1e6 * rough.roughness:g} um "
            "rms touch: film.at_contact = 'mixed' lets them bear their share"
        )
        return [*super().warnings(), f"{self.study.joint}: {load} N at {speed} rpm {text}"]

    def tables(self) -> list[Table]:
        """Return the equilibria, and the matrices."""
        names = ["load, N", "speed, rpm"]
        texts_by_name = {name: text for name in FIGURES if any(text := self._texts(name))}
        head = [*names, *(f"{n}, {u}".rstrip(", ") for n in texts_by_name for u in [FIGURES[n][0]])]
        states = [self._state(row) for row in self.rows]
        cells = zip(*texts_by_name.values(), strict=True)
        figures = [[*state, *texts] for state, texts in zip(states, cells, strict=True)]
        matrices = [
            [
                *state,
                *(f"{value:.4g}" for value in (*row.stiffness.flat, *row.damping.flat)),
            ]
            for state, row in zip(states, self.rows, strict=True)
        ]
        units = [f"k_{axes}, N/m" for axes in AXES] + [f"c_{axes}, N s/m" for axes in AXES]
        return [
            Table("Equilibrium", head, figures, above=[self.subtitle]),
            Table("Stiffness and damping", [*names, *units], matrices),
        ]

    def points(self) -> Points:
        """Return the equilibria over load and speed."""
        loads = [math.hypot(*row.load) for row in self.rows]
        keys = [
            Column("load", "N", loads),
            Column("speed", "rpm", [row.speed_rpm for row in self.rows]),
        ]
        figures = [Column(name, FIGURES[name][0], self._values(name)) for name in FIGURES]
        labels = [" N, ".join(self._state(row)) + " rpm" for row in self.rows]
        return Points(keys, figures, labels, title="Equilibria")

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of bearing.json, SI."""
        return {"equilibria": [row.to_dict() for row in self.rows]}

    def csv_files(self) -> dict[str, Mapping[str, Sequence[Value]]]:
        """Return bearing.csv, SI: a row for each equilibrium."""
        columns: dict[str, list[Value]] = {
            "load": [math.hypot(*row.load) for row in self.rows],
            "speed_rpm": [row.speed_rpm for row in self.rows],
        }
        for name, (_, _, read) in FIGURES.items():
            columns[name] = [_finite(read(row)) for row in self.rows]
        for letter, name in (("k", "stiffness"), ("c", "damping")):
            for k, axes in enumerate(AXES):
                columns[f"{letter}_{axes}"] = [
                    float(getattr(row, name).flat[k]) for row in self.rows
                ]
        return {"bearing.csv": columns}

    def _values(self, name: str) -> list[float | None]:
        _, scale, read = FIGURES[name]
        values = [_finite(read(row)) for row in self.rows]
        return [None if value is None else scale * value for value in values]

    def _texts(self, name: str) -> list[str]:
        """Return a figure's texts; empty ones where no row has it."""
        texts = [None if value is None else f"{value:.4g}" for value in self._values(name)]
        if name == "critical_mass":
            return [text or "no whirl" for text in texts]
        return [text or "" for text in texts]

    @staticmethod
    def _state(row: BearingCoefficients) -> list[str]:
        return [f"{math.hypot(*row.load):g}", f"{row.speed_rpm:g}"]


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
