"""A gas spring, cushion or buffer."""

from dataclasses import dataclass
from typing import Any, ClassVar

from exu_press.errors import InputError
from exu_press.laws.load_curve import LoadCurve
from exu_press.mechanism import Mechanism
from exu_press.scene.load import Load, check_height
from exu_press.schema.checks import check_columns, check_increasing, key

__all__ = ["SpringLoad"]


@dataclass(frozen=True)
class SpringLoad(Load):
    """A gas spring, cushion or buffer: force over its travel, with damping.

    The force is F(x) (1 + d dx/dt), as long as that pushes.
    """

    registered_name: ClassVar[str] = "spring"
    over: ClassVar = "height"
    closing: ClassVar = False
    required: ClassVar[tuple[str, ...]] = ("height", "travel", "force")
    height: float = key(
        None, "of the output above bottom dead centre where it meets the spring", "m", above=0
    )
    travel: tuple[float, ...] = key(None, "of the forces, from 0", "m", numbers=0)
    force: tuple[float, ...] = key(None, "over the travel, from 0", "N", numbers=0)
    damping: float = key(0.0, "d, of the force per speed over the force", "s/m", at_least=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        check_columns(("travel", "force"), self.travel, self.force)
        if self.travel[0] != 0.0 or self.force[0] != 0.0 or min(self.force) < 0.0:
            raise InputError(
                f"travel from {self.travel[0]!r}, force from {self.force[0]!r}: allowed is from 0 "
                "and 0, and pushing; let a preload rise over a short travel, as its seat gives way"
            )
        check_increasing("travel", self.travel)

    def check(self, mechanism: Mechanism, revolution: float) -> None:
        """Raise InputError unless the output leaves the spring, and its travel is long enough."""
        check_height(self.height, mechanism)
        if self.travel[-1] < self.height:
            raise InputError(
                f"travel to {self.travel[-1]!r}: the output compresses it by {self.height!r} m; "
                "allowed is a travel as long as that"
            )

    def law(self, angular_speed: float, fade: float | None, *, motor: bool) -> dict[str, Any]:
        """Return the damping as well."""
        return super().law(angular_speed, fade, motor=motor) | {"damping": self.damping}

    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force over the output's height, m."""
        places = [self.height - x for x in reversed(self.travel)]
        return LoadCurve(places, tuple(reversed(self.force)))
