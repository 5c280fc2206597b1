"""The film of a plane pad: closed forms, Reynolds' equation in two dimensions, no energy made."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from independent.pad_pressure import end_forces
from slopes import slopes

from exu_press.laws.film import pad_with_asperities
from exu_press.laws.film.plane_pad import plane_pad

LENGTH, GAP, SPEED, ONSET = 0.3, 2e-5, 1e-3, 2e-6
gaps = st.floats(1e-6, 1e-4)
rates = st.floats(-0.1, 0.1)


def rectangle(ratio):
    """Return the force of a parallel pad over mu w^3 L V / h^3, by the series of torsion."""
    odd = np.arange(1, 400, 2)
    return 1.0 - 192.0 * ratio / math.pi**5 * (np.tanh(0.5 * math.pi * odd / ratio) / odd**5).sum()


@pytest.mark.validation(
    "closed form",
    "squeeze film of a rectangular pad, width over length 0.01 to 100",
    "series of the torsion of a rectangle (S. Timoshenko, J. N. Goodier, Theory of Elasticity)",
    "equation",
)
@pytest.mark.parametrize("ratio", [0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0])
def test_a_parallel_pad_squeezes_as_the_series_of_a_rectangle_says(ratio, compare):
    width = ratio * LENGTH
    f_1, f_2, f_t, *_ = plane_pad(LENGTH, width)(GAP, GAP, -SPEED, -SPEED, 0.0)
    expected = width**3 * LENGTH * SPEED / GAP**3 * rectangle(ratio)
    compare("force over mu", expected, f_1 + f_2, error=None, rel=7e-3, unit="m^2/s")
    assert f_1 == pytest.approx(f_2, rel=1e-12)
    assert f_t == 0.0


@pytest.mark.validation(
    "closed form",
    "wide tilted slider",
    "B. J. Hamrock, S. R. Schmid, B. O. Jacobson, Fluid Film Lubrication (2004), 9.1",
    "equation",
)
@pytest.mark.parametrize("excess", [0.2, 1.0, 1.189, 4.0])
def test_a_wide_tilted_slider_bears_and_drags_as_its_closed_form_says(excess, compare):
    """Hamrock, Schmid and Jacobson 2004, 9.1: load and friction over the inlet's excess K."""
    width, speed = 30.0, 0.5
    inlet = GAP * (1.0 + excess)
    # the wide gap leads: the pad draws oil in
    f_1, f_2, f_t, *_ = plane_pad(LENGTH, width)(GAP, inlet, 0.0, 0.0, speed)
    log = math.log1p(excess)
    load = 6.0 * (log - 2.0 * excess / (2.0 + excess)) / excess**2
    friction = 4.0 * log / excess - 6.0 / (2.0 + excess)
    load, friction = (
        load * speed * LENGTH**2 * width / GAP**2,
        friction * speed * LENGTH * width / GAP,
    )
    compare("load over mu", load, f_1 + f_2, error=None, rel=1.2e-2, unit="m^2/s")
    compare("friction over mu", friction, -f_t, error=None, rel=5e-3, unit="m^2/s")
    backwards = plane_pad(LENGTH, width)(GAP, inlet, 0.0, 0.0, -speed)
    assert backwards[:2] == (0.0, 0.0)  # nothing but cavitation
    assert backwards[2] == pytest.approx(log / excess * speed * LENGTH * width / GAP)


@pytest.mark.parametrize(
    ("ratio", "most"), [(0.1, 0.025), (0.3, 0.03), (1.0, 0.06), (3.0, 0.06)], ids=str
)
def test_tilted_pads_of_any_width_against_two_dimensions(ratio, most):
    """In the part of the forces' sum by which each end is off."""
    width = ratio * LENGTH
    law = plane_pad(LENGTH, width)
    pairs = (-1.0, -1.0), (-1.0, 0.0), (0.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, 3.0)
    for rear in (GAP, 1e-5, 3e-6, 1e-6):
        for pair in pairs:
            found = np.array(law(rear, 2.0 * GAP, *pair, 0.0)[:2])
            expected = end_forces(LENGTH, width, (rear, 2.0 * GAP), pair, (48, 12))
            assert np.abs(found - expected).max() < most * expected.sum()


@pytest.mark.parametrize("ratio", [0.2, 2.0])
@pytest.mark.parametrize(
    "state",
    [
        (2e-5, 2e-5, -1e-3, -2e-3, 0.0),
        (2e-5, 3e-5, -1e-3, 2e-3, 0.4),
        (1e-5, 3e-6, 2e-3, -3e-3, -0.7),
        (1.5e-6, 3e-5, -1e-3, -2e-3, 0.3),
        (-1e-6, 0.5e-6, -1e-3, -1e-3, 1.0),
    ],
)
def test_derivatives_are_those_of_the_forces(ratio, state):
    law = pad_with_asperities(plane_pad(LENGTH, ratio * LENGTH), ONSET)
    widths = 1e-6 * np.maximum(np.abs(state), 1e-7)
    found, expected = np.reshape(law(*state)[3:], (3, 5)), slopes(law, state, widths)[:, :3].T
    scale = np.abs(expected).max(axis=0)
    assert (np.abs(found - expected) <= 2e-5 * scale).all()


@settings(max_examples=40, deadline=None)
@given(gaps, gaps, rates, rates, st.floats(-2.0, 2.0), st.floats(0.02, 10.0))
def test_no_energy_is_made(h_1, h_2, v_1, v_2, speed, ratio):
    """No pull either; with touching asperities as well."""
    law = plane_pad(LENGTH, ratio * LENGTH)
    for each, shift in ((law, 0.0), (pad_with_asperities(law, ONSET), 1.2e-6)):
        f_1, f_2, f_t, *_ = each(h_1 - shift, h_2 - shift, v_1, v_2, speed)
        assert f_1 >= 0.0
        assert f_2 >= 0.0
        terms = f_1 * v_1, f_2 * v_2, f_t * speed
        assert sum(terms) <= 1e-12 * sum(map(abs, terms))


def test_at_rest_it_resists_and_does_not_press():
    at_rest, closing = (plane_pad(LENGTH, 0.1)(GAP, 3e-5, -v, -v, 0.0) for v in (0.0, 1e-30))
    assert [abs(f) for f in at_rest[:3]] == [0.0, 0.0, 0.0]
    assert at_rest[5:7] == closing[5:7]
    assert at_rest[5] < 0.0


def test_outside_it_is_not_a_number():
    law = plane_pad(LENGTH, 0.1)
    for state in ((0.0, GAP, 0.0, 0.0, 0.0), (GAP, -1e-6, 0.0, 0.0, 0.0)):
        assert all(map(math.isnan, law(*state)))
    for i in range(5):
        for bad in (math.nan, math.inf):
            state = [GAP, GAP, 0.0, 0.0, 0.0]
            state[i] = bad
            assert all(map(math.isnan, law(*state)))
    assert all(map(math.isnan, pad_with_asperities(law, ONSET)(math.nan, GAP, 0.0, 0.0, 0.0)))
