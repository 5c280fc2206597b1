"""Short runs, made once."""

import pytest
from coarse_parts import COARSE
from matplotlib.figure import Figure
from on_demand import OnDemand

from exu_press import Result, Scene, simulate
from exu_press.view import Animation
from exu_press.view.animation import SIZE

SCENES = {
    "press": {"mechanism": "press", "revolutions": 0.3, "solver": {"step": 2e-4}},
    "slider_crank": {
        "mechanism": "slider_crank",
        "joints": {"crank_pin": "dry"},
        "revolutions": 0.3,
        "solver": {"step": 2e-4},
    },
    "ideal": {"joints": {}, "revolutions": 0.1},
    "flexible": {"bodies": COARSE, "revolutions": 0.03},
}


@pytest.fixture(scope="session")
def runs(tmp_path_factory) -> dict[str, Result]:
    """Results as a file gives them back: nothing else is there to draw from."""
    folder = tmp_path_factory.mktemp("runs")

    def run_of_file(name):
        simulate(Scene(**SCENES[name])).save(folder / f"{name}.nc")
        return Result.load(folder / f"{name}.nc")

    return OnDemand(run_of_file)


@pytest.fixture
def animation():
    """Return an animation of a run, its first frame shown."""

    def made(result, instants, flexible=None) -> Animation:
        animation = Animation(result, instants, Figure(figsize=SIZE), flexible)
        animation.show(0)
        return animation

    return made
