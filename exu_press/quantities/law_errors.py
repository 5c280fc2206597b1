"""Errors of figures that follow from those of tabulated film laws.

A film that is stronger by a part x, at the same load, is thicker by x / 5 to 2 x / 3, dissipates
more or less by up to x, and bears the same peak forces (measured on journals and balls of a press
and a slider-crank with viscosities 1 % apart; tests/quantities/test_table.py). So x bounds
them all.
"""

from exu_press.scene import Scene
from exu_press.scene.joint import oil_of

__all__ = [
    "dissipation_error",
    "eccentricity_error",
    "film_error",
    "guide_film_error",
    "side_flow_error",
    "temperature_error",
    "viscosity_error",
]


def _relative_film_error(scene: Scene, joint: str) -> float:
    """Return the relative error of a joint's film, 0.0 without one, or of a closed form."""
    film = scene.joints[joint].film
    return 0.0 if film is None else film.law.errors[0]


def film_error(scene: Scene, joint: str, value: float) -> float:
    """Return the error of a film's thickness or power."""
    return _relative_film_error(scene, joint) * abs(value)


def eccentricity_error(scene: Scene, joint: str, value: float) -> float:
    """Return the error of an eccentricity ratio, of which a film is what is left."""
    return _relative_film_error(scene, joint) * max(0.0, 1.0 - value)


def dissipation_error(scene: Scene, _: str, value: float) -> float:
    """Return the error of what all films dissipate together."""
    largest = max((_relative_film_error(scene, joint) for joint in scene.joints), default=0.0)
    return largest * abs(value)


def guide_film_error(scene: Scene, guide: str, value: float) -> float:
    """Return the error of the thickness of the film between a body and its guideways."""
    oil = scene.guides[guide].oil if guide in scene.guides else None
    return 0.0 if oil is None else oil.error * abs(value)


def _relative_flow_error(scene: Scene, joint: str) -> float:
    film = scene.joints[joint].film
    return 0.0 if film is None else film.law.errors[1]


def _relative_heat_error(scene: Scene, joint: str) -> float:
    """Return the relative error of a film's rise of temperature: of its heat, and of its flow."""
    return _relative_film_error(scene, joint) + _relative_flow_error(scene, joint)


def side_flow_error(scene: Scene, joint: str, value: float) -> float:
    """Return the error of a side flow, and of the heat that it carries off."""
    return _relative_flow_error(scene, joint) * abs(value)


def temperature_error(scene: Scene, joint: str, value: float) -> float:
    """Return the error of a film's temperature: of its heat, and of what carries that off."""
    oil = oil_of(scene.joints[joint])
    assert oil is not None
    return _relative_heat_error(scene, joint) * abs(value - oil.supply_celsius)


def viscosity_error(scene: Scene, joint: str, value: float) -> float:
    """Return the error of a film's viscosity, by that of its temperature, which is above supply's.

    A viscosity falls by a part that is smaller the warmer the oil is: at supply it is the largest.
    """
    oil = oil_of(scene.joints[joint])
    assert oil is not None
    cold = oil.viscosity(oil.supply_celsius)
    return _relative_heat_error(scene, joint) * abs(cold - value)
