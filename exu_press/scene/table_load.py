"""Forces over time, crank angle or height, from a list or a file."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from exu_press.errors import InputError
from exu_press.laws.load_curve import REVOLUTION, LoadCurve
from exu_press.scene.load import COLUMNS, Load
from exu_press.schema.checks import check_columns, check_increasing, key
from exu_press.schema.two_columns import read_two_columns

__all__ = ["TableLoad"]


@dataclass(frozen=True)
class TableLoad(Load):
    """Forces over time, crank angle or the output's height, straight lines between them.

    The height counts from the ideal bottom dead centre. Over the crank angle forces repeat every
    revolution, from the last point to the first; otherwise the first and the last force go on
    beyond the table. A forming force acts while the output closes. It fades as the output comes to
    rest, over a thousandth of the ideal motion's largest speed.
    """

    registered_name: ClassVar[str] = "table"
    time: tuple[float, ...] | None = key(None, "of the forces, from the start", "s", numbers=0)
    crank_angle_deg: tuple[float, ...] | None = key(
        None, "of the forces, from the mechanism's zero", "deg", numbers=0
    )
    height: tuple[float, ...] | None = key(
        None, "of the output above bottom dead centre", "m", numbers=0
    )
    force: tuple[float, ...] | None = key(None, "positive in the direction", "N", numbers=0)
    factor: float = key(1.0, "times the table's forces")
    acts: str | None = key(
        None,
        "while the output closes or both ways; over height 'closing' unless given, else 'both'",
        choices=("closing", "both"),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        columns = [name for name in COLUMNS if getattr(self, name) is not None]
        if len(columns) != 1 or self.force is None:
            names = ", ".join([*columns, *(["force"] if self.force is not None else [])])
            raise InputError(
                f"{f'{names} given' if names else 'force: missing'}: allowed is file, a CSV, or "
                f"one of {', '.join(COLUMNS)} with force"
            )
        positions = getattr(self, columns[0])
        check_columns((columns[0], "force"), positions, self.force)
        check_increasing(columns[0], positions)
        if columns[0] == "crank_angle_deg":
            turn = positions[-1] - positions[0]
            if turn > 360.0 or (turn == 360.0 and self.force[0] != self.force[-1]):
                raise InputError(
                    f"crank_angle_deg from {positions[0]!r} to {positions[-1]!r}: allowed is less "
                    "than a revolution, or a whole one that ends with the force with which it "
                    "begins"
                )

    @classmethod
    def read_file(cls, path: Path) -> dict[str, Any]:
        """Return the two columns of a CSV file by their names."""
        read = read_two_columns(path)
        if read.head[0] not in COLUMNS or read.head[1] != "force":
            allowed = " or ".join(f"'{name},force'" for name in COLUMNS)
            raise InputError(f"{path}: header {','.join(read.head)[:80]!r}; allowed is {allowed}")
        if len(read.places) < 2:
            raise InputError(
                f"{path}: {len(read.places)} lines of numbers; allowed are at least two"
            )
        return {read.head[0]: read.places, "force": read.values}

    @property
    def over(self) -> str:
        """The variable of the curve."""
        return next(name for name in COLUMNS if getattr(self, name) is not None)

    @property
    def closing(self) -> bool:
        """Return whether it acts while the output closes only."""
        return (self.acts or ("closing" if self.over == "height" else "both")) == "closing"

    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force over time, s, crank angle, rad, or height, m."""
        assert self.force is not None
        positions, forces = getattr(self, self.over), [self.factor * force for force in self.force]
        if self.over != "crank_angle_deg":
            return LoadCurve(positions, forces)
        if positions[-1] - positions[0] == 360.0:
            positions, forces = positions[:-1], forces[:-1]
        return LoadCurve([math.radians(angle) for angle in positions], forces, REVOLUTION)
