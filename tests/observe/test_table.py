"""What a person reads of a run."""

from exu_press.observe.table import run_lines
from exu_press.scene import Scene
from exu_press.simulation import simulate

POWERS = {"slide": 540.0, "slider": 60.0}
TOLD = {"error": 2.0, "determined": True, "low": 1.0, "high": 2.0}


def rubbing(errors):
    """Return the line of what guides would take by friction."""
    scene = Scene(mechanism="slider_crank", joints={}, revolutions=0.01)
    guides = {name: {"sliding_power": power} for name, power in POWERS.items()}
    lines = run_lines({**simulate(scene).summary(), "guides": guides, "errors": errors})
    return next(line for line in lines if "guides of mu 0.1" in line).split("W")[1].strip()


def test_what_guides_would_take_has_the_errors_of_all_of_them():
    names = [f"guides.{name}.sliding_power" for name in POWERS]
    assert rubbing({}) == "60"
    assert rubbing(dict.fromkeys(names, TOLD)) == "60.00 +- 0.40"
    chaotic = {names[0]: TOLD, names[1]: {**TOLD, "determined": False}}
    assert rubbing(chaotic) == "0.200 to 0.400, not determined"
