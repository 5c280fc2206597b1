"""Contact and friction laws in any state: finite, dissipative, continuous; tried by Hypothesis."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from exu_press.laws.contact import DAMPING_LAWS, cylindrical, hertz, step_damping
from exu_press.laws.friction import LuGre, coulomb, lugre_steady, no_friction, stribeck


def logarithmic(low, high):
    return st.floats(math.log(low), math.log(high)).map(math.exp)


stiffnesses = st.one_of(
    st.builds(hertz, logarithmic(1e6, 1e14), st.floats(1.0, 3.0)),
    st.builds(cylindrical, logarithmic(1e8, 1e14), logarithmic(1e-3, 1.0), logarithmic(1e-7, 1e-2)),
)
tension = st.booleans()
hysteretic = st.sampled_from([name for name in DAMPING_LAWS if name != "step"])
contacts = st.one_of(
    st.builds(
        step_damping,
        stiffnesses,
        st.one_of(st.just(0.0), logarithmic(1.0, 1e12)),
        logarithmic(1e-8, 1e-2),
        tension,
    ),
    st.builds(
        lambda name, stiffness, restitution, pulls: DAMPING_LAWS[name](
            stiffness, restitution, pulls
        ),
        hysteretic,
        stiffnesses,
        st.floats(1e-3, 1.0),
        tension,
    ),
)
depths = logarithmic(1e-12, 1e-2)
speeds = st.floats(-20.0, 20.0)
impacts = st.floats(0.0, 20.0)


@settings(max_examples=100, deadline=None)
@given(contact=contacts, depth=depths, rate=speeds, impact=impacts)
def test_contact_is_finite_dissipative_and_continuous(contact, depth, rate, impact):
    response = contact.force(depth, rate, impact)
    assert all(map(math.isfinite, response))
    assert contact.tension or response[0] >= 0.0
    elastic = contact.stiffness.force(depth)[0]
    assert contact.elastic_energy(depth) > 0.0
    # rounding of force - elastic force
    assert contact.dissipated_power(depth, rate, impact) >= -1e-12 * elastic * abs(rate)
    # with the damping's share
    size = abs(response[0]) + elastic + abs(contact.force(depth, 40.0, impact)[0])
    for near in ((depth * (1.0 + 1e-9), rate), (depth, rate + 1e-9)):
        assert abs(contact.force(*near, impact)[0] - response[0]) <= 1e-7 * size


coefficients = st.tuples(logarithmic(1e-4, 10.0), logarithmic(1.0, 10.0)).map(
    lambda pair: (pair[0] * pair[1], pair[0])
)
curves = st.tuples(logarithmic(1e-6, 10.0), st.floats(0.1, 10.0))
soft = logarithmic(1e-6, 1e-1)
viscous = st.floats(0.0, 10.0)
frictions = st.one_of(
    st.builds(no_friction),
    st.builds(coulomb, st.floats(0.0, 10.0), soft),
    st.builds(lambda mu, curve, v_r, v: stribeck(*mu, *curve, v_r, v),
              coefficients, curves, soft, viscous),
    st.builds(lambda mu, s, curve, v_r: lugre_steady(*mu, s, *curve, v_r),
              coefficients, viscous, curves, soft),
)  # fmt: skip
slidings = st.one_of(speeds, logarithmic(1e-12, 1.0), logarithmic(1e-12, 1.0).map(lambda v: -v))


@settings(max_examples=100, deadline=None)
@given(friction=frictions, v=slidings)
def test_friction_is_finite_dissipative_odd_and_continuous(friction, v):
    mu, slope = friction(v)
    assert math.isfinite(mu)
    assert math.isfinite(slope)
    assert mu * v >= 0.0
    assert friction(-v)[0] == -mu
    assert friction(0.0)[0] == 0.0
    largest = abs(friction(30.0)[0]) + 100.0
    assert abs(friction(v + 1e-12)[0] - mu) <= 1e-4 * largest


passive_bristles = st.builds(
    lambda kinetic, more, stiffness, damping, viscous, speed, exponent: LuGre(
        kinetic * (1.0 + more), kinetic, stiffness, damping, viscous, speed, exponent
    ),
    logarithmic(1e-3, 1.0),
    st.floats(0.0, 3.0),
    logarithmic(1e3, 1e7),
    st.one_of(st.just(0.0), logarithmic(1e-2, 1e5)),
    st.one_of(st.just(0.0), logarithmic(1e-3, 1.0)),
    logarithmic(1e-5, 1.0),
    st.floats(0.1, 5.0),
)
signed_speeds = st.builds(
    lambda sign, size: sign * size, st.sampled_from([-1.0, 1.0]), logarithmic(1e-7, 10.0)
)


histories = st.lists(st.tuples(signed_speeds, logarithmic(1e-8, 1e-2)), max_size=30)


def work_on_a_bristle(friction, v_start, v, z, h):
    """Work per normal force, along the step, on the bristle's spring; its end.

    Of a stretch in one direction: sigma_0 times the integral of z over the distance, from the
    bristle's equation.
    """
    stretches = [(v_start, v, h)]
    if v_start * v < 0.0:
        until = h * v_start / (v_start - v)
        stretches = [(v_start, 0.0, until), (0.0, v, h - until)]
    work = 0.0
    for before, after, time in stretches:
        mean = 0.5 * (before + after)
        end = friction.advance(after, z, time, before)[2]
        g = friction.mu_kinetic + (friction.mu_static - friction.mu_kinetic) * math.exp(
            -(abs(mean / friction.stribeck_velocity) ** friction.stribeck_exponent)
        )
        work += g * (time * abs(mean) - math.copysign(1.0, mean) * (end - z))
        z = end
    return work, z


@settings(max_examples=100, deadline=None)
@given(passive_bristles, histories)
def test_a_bristle_makes_no_energy(friction, history):
    """In any history, reversals within a step included, whatever the size of its steps.

    Its deflection stays below mu_s / sigma_0.
    """
    z, v_start = 0.0, None
    largest = friction.mu_static / friction.sigma_0
    for v, h in history:
        mu, _, following = friction.advance(v, z, h, v_start)
        work, end = work_on_a_bristle(friction, v if v_start is None else v_start, v, z, h)
        stored = friction.stored_energy(following) - friction.stored_energy(z)
        size = friction.mu_static * h * max(abs(v), abs(v_start or v)) + friction.stored_energy(z)
        assert following == pytest.approx(end, rel=1e-6, abs=1e-9 / friction.sigma_0)
        assert abs(following) <= largest * (1.0 + 1e-9)
        assert work - stored >= -1e-9 * size
        assert mu * v - friction.stored_power(v, following) >= -1e-12 * abs(mu * v)
        z, v_start = following, v
