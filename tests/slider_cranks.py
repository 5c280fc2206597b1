"""Scenes that tests of more than one folder have, and their points in the section."""

from exu_press import Scene
from exu_press.studies.attractor.orbit import Orbit

FILM = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "lubricated", "clearance": 1e-4, "radius": 0.03}},
    film={"length": 0.05, "viscosity": 0.1},
)


def section_points(scene, revolutions, recorded=False):
    """Return the point after each revolution, list of arrays."""
    orbit, found = Orbit(scene), []
    for _ in range(revolutions):
        orbit.advance(recorded=recorded)
        found.append(orbit.point())
    orbit.close()
    return found
