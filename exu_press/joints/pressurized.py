"""A film in a bearing whose grooves have oil under pressure."""

from exu_press.joints.oriented import GroovedInterface
from exu_press.laws.film.pressurized import PressurizedFilm

__all__ = ["PressurizedInterface"]


class PressurizedInterface(GroovedInterface):
    """A film between journal and bearing that a pump feeds, and which bears a journal at rest.

    Its power is that of `FilmInterface`, and the pump's beside it.
    """

    bears_at_rest = True
    law: PressurizedFilm

    def __init__(
        self, law: PressurizedFilm, scale: float, clearance: float, supply_force: float
    ) -> None:
        """Fill the gap between two surfaces.

        Args:
            law, scale, clearance: as of `FilmInterface`.
            supply_force: largest pressure of the grooves times length times radius, N.
        """
        super().__init__(law, scale, clearance)
        self._supply_force = supply_force

    def orient(self, angle: float) -> None:
        """Take the angle of the eccentricity in the bearing, rad, before `load`."""
        self.law.angle = angle
        self.law.supply = self._supply_force / (12.0 * self.scale)

    @property
    def pump_power(self) -> float:
        """Power that the pump puts in, W, at the last `load`."""
        return self.scale * self.clearance * self.law.pump_power
