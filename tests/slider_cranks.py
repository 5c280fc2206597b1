"""Scenes that tests of more than one folder have."""

from exu_press import Scene

FILM = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "lubricated", "clearance": 1e-4, "radius": 0.03}},
    film={"length": 0.05, "viscosity": 0.1},
)
