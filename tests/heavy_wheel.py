"""A heavy wheel on its shaft; rod and slide weigh nothing beside it."""

HEAVY_WHEEL = {
    "name": "weight",
    "crank": "wheel",
    "output": {"body": "slide", "direction": [1.0, 0.0]},
    "bodies": {
        "wheel": {"mass": 500.0, "inertia": 50.0, "centre_of_mass": [0.0, 0.0]},
        "rod": {"mass": 1e-3, "inertia": 1e-5, "centre_of_mass": [0.3, 0.0]},
        "slide": {"mass": 1e-3, "inertia": 1e-5, "centre_of_mass": [0.5, 0.0]},
    },
    "joints": {
        "shaft": {"at": [0.0, 0.0], "journal": "wheel", "bearing": "frame"},
        "pin": {"at": [0.1, 0.0], "journal": "wheel", "bearing": "rod"},
        "wrist": {"at": [0.5, 0.0], "journal": "rod", "bearing": "slide"},
    },
    "guides": {"slide": {"direction": [1.0, 0.0]}},
}
