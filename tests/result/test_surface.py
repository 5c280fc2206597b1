"""Surfaces of flexible bodies, and their most stressed place."""

import numpy as np
import pytest
from coarse_parts import COARSE

from exu_press import Result, Scene, simulate
from exu_press.model.placement import placed_parts
from exu_press.result.stress import _worst

pytest.importorskip("ngsolve")


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    result = simulate(Scene(bodies=COARSE, revolutions=0.05))
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
    assert loaded.info["stress"] == result.info["stress"]


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


def test_no_node_is_stressed_more_at_any_instant(run):
    result, _ = run
    surface, q = result.surfaces["linkage"], result["linkage_modes"]
    everywhere = np.array([surface.von_mises(each).max() for each in q])
    worst = result.info["stress"]["linkage"]
    assert worst["von_mises"] == pytest.approx(everywhere.max(), rel=1e-4)
    assert worst["time"] == result.time[everywhere.argmax()]
    stress = result["linkage_stress"]
    assert np.abs(stress).max() == worst["von_mises"]
    assert stress.min() < 0.0 < stress.max()
    node = surface.von_mises(q[everywhere.argmax()]).argmax()
    assert worst["place"] == pytest.approx(surface.nodes[node].tolist(), abs=1e-6)


def test_a_peak_between_the_instants_that_are_looked_at_is_found():
    """One node is stressed for one instant of two thousand by a mode that is small all the time."""
    generator = np.random.default_rng(1)
    by_node = generator.standard_normal((300, 6, 2))
    by_node[:, :, 1] *= 1e-3
    by_node[77, :, 1] = [1.0, -1.0, 0.0, 0.0, 0.0, 0.0]
    q = np.column_stack([np.sin(np.arange(2000.0)), 0.001 * np.cos(np.arange(2000.0))])
    q[1001] = 0.0, 40.0
    assert _worst(by_node, q) == (77, 1001)
