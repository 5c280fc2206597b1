import numpy as np
import pytest

from exu_press import Result, Scene, simulate
from exu_press.model.placed_part import placed_parts
from exu_press.scene import flexible_press


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    result = simulate(Scene(bodies=flexible_press(), revolutions=0.005))
    path = tmp_path_factory.mktemp("flexible") / "run.nc"
    result.save(path)
    return result, path


def test_surfaces_and_modes_come_back(run):
    result, path = run
    loaded = Result.load(path)
    assert set(loaded.surfaces) == {"crank", "linkage"}
    for name, surface in loaded.surfaces.items():
        for array in ("nodes", "triangles", "modes", "stress"):
            stored = getattr(result.surfaces[name], array)
            assert np.array_equal(getattr(surface, array), stored)
            assert getattr(surface, array).dtype == stored.dtype
        assert np.array_equal(loaded[f"{name}_modes"], result[f"{name}_modes"])
        assert loaded.channels[f"{name}_modes"].axis == f"{name}_mode"


def test_displacement_and_stress_are_the_parts(run):
    """In single precision."""
    result, _ = run
    for name, placed in placed_parts(result.scene).items():
        part = placed.reduced
        q = result[f"{name}_modes"][-1]
        surface = result.surfaces[name]
        moved, stress = (part.modes @ q).reshape(-1, 3), part.von_mises(q)
        assert surface.displacement(q) == pytest.approx(moved, abs=1e-5 * np.abs(moved).max())
        assert surface.von_mises(q) == pytest.approx(stress, abs=1e-4 * stress.max())


def test_rigid_runs_have_none(tmp_path):
    simulate(Scene(mechanism="slider_crank", joints={"crank_pin": "ideal"}, revolutions=0.01)).save(
        tmp_path / "run.nc"
    )
    assert Result.load(tmp_path / "run.nc").surfaces == {}
