import numpy as np
import pytest

from fe_models.errors import InputError


def test_virtual_nodes_move_with_the_interface(reduced_crank):
    pin = reduced_crank.interface("pin")
    points, modes = pin.virtual_nodes()
    q = np.random.default_rng(1).standard_normal(20)
    moved = (modes @ q).reshape(3, 3)
    theta = pin.rotation @ q
    expected = pin.translation @ q + np.cross(theta, points - pin.centre)
    assert moved == pytest.approx(expected)
    assert moved.mean(axis=0) == pytest.approx(pin.translation @ q)


def test_unknown_interface_and_damping(reduced_crank):
    with pytest.raises(InputError, match=r"no interface 'web'.*'pin'"):
        reduced_crank.interface("web")
    with pytest.raises(InputError, match="damping_ratio"):
        reduced_crank.damping_matrix(1.5)


def test_von_mises_of_a_stretched_state(reduced_linkage):
    stress = reduced_linkage.von_mises(np.ones(20))
    assert stress.shape == (len(reduced_linkage.nodes),)
    assert np.all(stress >= 0.0)
    assert reduced_linkage.von_mises(2.0 * np.ones(20)) == pytest.approx(2.0 * stress)
