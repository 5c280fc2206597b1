"""The most stressed place of a flexible body, found without looking everywhere at every instant."""

import numpy as np
import pytest

from exu_press import Result, Scene, simulate
from exu_press.result.stress import _worst

pytest.importorskip("ngsolve")


@pytest.fixture(scope="module")
def result():
    body = {"flexible": "linkage", "modes": 6, "mesh_size": 0.1}
    return simulate(Scene(bodies={"linkage": body}, revolutions=0.05))


def test_no_node_is_stressed_more_at_any_instant(result):
    surface, q = result.surfaces["linkage"], result["linkage_modes"]
    everywhere = np.array([surface.von_mises(each).max() for each in q])
    worst = result.info["stress"]["linkage"]
    assert worst["von_mises"] == pytest.approx(everywhere.max(), rel=1e-4)
    assert worst["time"] == result.time[everywhere.argmax()]
    node = surface.von_mises(q[everywhere.argmax()]).argmax()
    assert worst["place"] == pytest.approx(surface.nodes[node].tolist(), abs=1e-6)


def test_the_channel_has_the_stress_there_with_its_sign(result):
    stress = result["linkage_stress"]
    assert np.abs(stress).max() == result.info["stress"]["linkage"]["von_mises"]
    assert stress.min() < 0.0 < stress.max()


def test_a_peak_between_the_instants_that_are_looked_at_is_found():
    """One node is stressed for one instant of two thousand by a mode that is small all the time."""
    generator = np.random.default_rng(1)
    by_node = generator.standard_normal((300, 6, 2))
    by_node[:, :, 1] *= 1e-3
    by_node[77, :, 1] = [1.0, -1.0, 0.0, 0.0, 0.0, 0.0]
    q = np.column_stack([np.sin(np.arange(2000.0)), 0.001 * np.cos(np.arange(2000.0))])
    q[1001] = 0.0, 40.0
    assert _worst(by_node, q) == (77, 1001)


def test_it_comes_back_from_the_file(result, tmp_path):
    result.save(tmp_path / "run.nc")
    assert Result.load(tmp_path / "run.nc").info["stress"] == result.info["stress"]
