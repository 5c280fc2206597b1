"""A sheet that is cut."""

from dataclasses import dataclass
from typing import Any, ClassVar

from exu_press.errors import InputError
from exu_press.laws.load_curve import LoadCurve
from exu_press.laws.sheet import SHAPE, Sheet, shear_force
from exu_press.mechanism import Mechanism
from exu_press.scene.load import Load, check_height
from exu_press.schema.checks import check_columns, check_increasing, key

__all__ = ["SheetLoad"]


@dataclass(frozen=True)
class SheetLoad(Load):
    """A sheet that is cut once a stroke: the output's place decides, not the clock.

    A sheet of its own lies on the die for every stroke. Its fracture ends a step.
    """

    registered_name: ClassVar[str] = "sheet"
    over: ClassVar = "penetration"
    closing: ClassVar = True
    required: ClassVar[tuple[str, ...]] = (
        *("height", "thickness", "shear_strength", "cut_length", "penetration", "crack_time"),
    )
    height: float = key(None, "of the sheet's upper face above bottom dead centre", "m", above=0)
    thickness: float = key(None, "of the sheet", "m", above=0)
    shear_strength: float = key(
        None, "of the sheet, about 0.8 of its tensile strength", "Pa", above=0
    )
    cut_length: float = key(None, "of the line that is cut", "m", above=0)
    penetration: float = key(
        None, "of the punch at fracture over the thickness", above=0, at_most=1
    )
    crack_time: float = key(None, "from fracture to no force", "s", above=0)
    stripping: float = key(0.0, "force on the way up over the largest force", at_least=0, at_most=1)
    over_fracture: tuple[float, ...] = key(
        SHAPE[0], "penetrations of the curve over that at fracture, from 0 to 1", numbers=0
    )
    over_peak: tuple[float, ...] = key(
        SHAPE[1], "forces of the curve over shear_strength cut_length thickness", numbers=0
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        check_columns(("over_fracture", "over_peak"), self.over_fracture, self.over_peak)
        if (self.over_fracture[0], self.over_fracture[-1], self.over_peak[0]) != (0.0, 1.0, 0.0):
            raise InputError(
                f"over_fracture from {self.over_fracture[0]!r} to {self.over_fracture[-1]!r}, "
                f"over_peak from {self.over_peak[0]!r}: allowed is from 0 to 1, and from 0"
            )
        check_increasing("over_fracture", self.over_fracture)
        if not min(self.over_peak[1:]) > 0.0:
            raise InputError(
                f"over_peak = {min(self.over_peak[1:])!r}: allowed is > 0 after the first"
            )

    def curve(self, angular_speed: float) -> LoadCurve:
        """Return the force over the penetration up to fracture, m."""
        peak = shear_force(self.shear_strength, self.cut_length, self.thickness)
        depth = self.penetration * self.thickness
        return LoadCurve(
            [depth * x for x in self.over_fracture], [peak * y for y in self.over_peak]
        )

    def check(self, mechanism: Mechanism, revolution: float) -> None:
        """Raise InputError unless the output leaves the sheet, and cuts it through."""
        check_height(self.height, mechanism)
        depth = self.thickness * self.penetration
        if depth >= self.height:
            raise InputError(
                f"thickness = {self.thickness!r}: it fractures {depth:.4g} m deep, and the output "
                f"goes {self.height!r} m into it; allowed is a larger height, or a thinner sheet"
            )

    def law(self, angular_speed: float, fade: float | None, *, motor: bool) -> dict[str, Any]:
        """Return the sheet as well, and the height of its upper face."""
        assert fade is not None
        curve = self.curve(angular_speed)
        stripping = self.stripping * curve.peak
        sheet = Sheet(curve, self.thickness, self.crack_time, stripping, fade)
        return {"over": self.over, "curve": curve, "sheet": sheet, "top": self.height}
