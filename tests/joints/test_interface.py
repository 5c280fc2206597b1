"""What two surfaces do to each other: derivatives, rigid rotation, arms, memory."""

import math
import random

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from exu_press.joints.interface import DryInterface, FilmInterface
from exu_press.laws.contact import Approach, hertz, hunt_crossley, step_damping
from exu_press.laws.film import film_scale, finite, pi_film, pinkus, short, with_asperities
from exu_press.laws.friction import LuGre, lugre_steady, no_friction

RADIUS, CLEARANCE = 0.07, 1e-4
STEADY = lugre_steady(0.15, 0.1, 1e-3, 0.1, 2.0, 1e-4)
BRISTLE = LuGre(0.15, 0.1, 1e4, 40.0, 1e-3, 0.1, 2.0)


def contact(tension=False):
    return step_damping(hertz(2.5545e10), 2.5545e6, 1e-5, tension)


def dry(friction, law=None):
    return DryInterface(law or contact(), friction, RADIUS, CLEARANCE)


def film(law):
    return FilmInterface(law, film_scale(0.4, 0.1, RADIUS, CLEARANCE), CLEARANCE)


def mid_step(friction):
    """An interface whose bristle is half bent, in a step of 1e-6 s."""
    interface = dry(friction)
    interface.bristle = 0.5e-5
    interface.begin_step(1e-6, accepted=False)
    return interface


DRY = {
    "without friction": dry(no_friction()),
    "steady friction": dry(STEADY),
    "bristle": mid_step(BRISTLE),
    "with tension": dry(STEADY, contact(tension=True)),
    "hysteretic damping": dry(STEADY, hunt_crossley(hertz(2.5545e10), 0.7)),
}
FILMS = {
    "pinkus": film(pinkus()),
    "pi_film": film(pi_film()),
    "short": film(short(0.7)),
    "finite": film(finite(0.7)),
    "mixed": film(with_asperities(pi_film(), 0.1)),
}


def dry_states(count, seed=1):
    """Random states in contact; half of them almost stick."""
    rng = random.Random(seed)
    for number in range(count):
        e = CLEARANCE + 10 ** rng.uniform(-7, -4.5)
        omega_j, omega_b = rng.uniform(-30, 30), rng.uniform(-30, 30)
        sliding = rng.uniform(-3e-4, 3e-4) if number % 2 else rng.uniform(-2, 2)
        v_t = sliding - RADIUS * omega_j + (RADIUS + e) * omega_b
        yield e, rng.uniform(-1e-3, 3e-3), v_t, omega_j, omega_b


def film_states(count, seed=2, largest=0.95):
    rng = random.Random(seed)
    for _ in range(count):
        yield (
            CLEARANCE * rng.uniform(0.02, largest),
            rng.uniform(-0.1, 0.1),
            rng.uniform(-0.1, 0.1),
            rng.uniform(-30, 30),
            rng.uniform(-30, 30),
        )


def force_of(interface, e, e_dot, v_t, omega_j, omega_b):
    """Return f_n and f_t, then the partials of each."""
    load = interface.load(e, e_dot, v_t, omega_j, omega_b)
    return load and (load[:2], *interface.partials(load[4], e, omega_j, omega_b))


def assert_derivatives(interface, state, widths):
    given = force_of(interface, *state)
    assert given is not None
    for i, width in enumerate(widths):
        up, down = list(state), list(state)
        up[i] += width
        down[i] -= width
        high, low = force_of(interface, *up), force_of(interface, *down)
        for force in (0, 1):
            difference = (high[0][force] - low[0][force]) / (2 * width)
            scale = max(abs(given[0][force]) / (1e4 * width), abs(difference), 1e-6)
            assert abs(given[1 + force][i] - difference) < 3e-5 * scale, (force, i, state)


@pytest.mark.parametrize("interface", DRY.values(), ids=DRY)
def test_derivatives_of_a_dry_pair(interface):
    for state in dry_states(60):
        if force_of(interface, *state)[0][0] == 0.0:
            continue  # held at zero: no tension
        width = 1e-4 * (state[0] - CLEARANCE)
        assert_derivatives(interface, state, (width, 1e-8, 1e-8, 1e-7, 1e-7))


@pytest.mark.parametrize("interface", FILMS.values(), ids=FILMS)
def test_derivatives_of_a_film_pair(interface):
    for state in film_states(60):
        assert_derivatives(interface, state, (1e-10, 1e-6, 1e-6, 1e-4, 1e-4))


@pytest.mark.parametrize("interface", FILMS.values(), ids=FILMS)
def test_derivatives_of_a_films_shear(interface):
    at = [0.95 * CLEARANCE, 0.0, 0.0, 20.0, -5.0]
    _, _, _, _, response = interface.load(*at)

    def couple(state):
        """Half the difference of the moments: what the pressure shares in halves drops out."""
        _, _, on_journal, on_bearing, _ = interface.load(*state)
        return 0.5 * (on_bearing - on_journal)

    by_e, by_spin = interface.shear_partials(response, at[3], at[4])
    for place, expected, width in ((0, by_e, 1e-10), (3, by_spin, 1e-3), (4, -by_spin, 1e-3)):
        up, down = at.copy(), at.copy()
        up[place] += width
        down[place] -= width
        difference = (couple(up) - couple(down)) / (2.0 * width)
        assert difference == pytest.approx(expected, rel=1e-5)


def test_free_flight_costs_nothing():
    assert force_of(dry(STEADY), 0.9 * CLEARANCE, 1.0, 1.0, 1.0, 1.0) is None
    assert force_of(dry(BRISTLE), 0.9 * CLEARANCE, 1.0, 1.0, 1.0, 1.0) is None


def test_contact_begins_at_the_clearance():
    assert force_of(dry(no_friction()), CLEARANCE, 0.1, 0.0, 0.0, 0.0) is None
    (f_n, f_t), _, _ = force_of(dry(no_friction()), CLEARANCE + 1e-6, 0.0, 0.3, 0.0, 0.0)
    assert f_n == pytest.approx(-2.5545e10 * 1e-6**1.5)
    assert f_t == 0.0


def test_contact_pushes_the_journal_inwards_and_friction_against_its_sliding():
    (f_n, f_t), _, _ = force_of(dry(STEADY), CLEARANCE + 1e-6, 0.0, 0.5, 0.0, 0.0)
    assert f_n < 0.0
    assert f_t < 0.0
    assert f_t / f_n == pytest.approx(0.1 + 0.05 * math.exp(-25) + 0.5e-3)


def test_friction_acts_on_the_sliding_of_the_two_surfaces():
    """A turning journal that stays in place slides with R omega."""
    omega = 3.0
    (f_n, f_t), _, _ = force_of(dry(STEADY), CLEARANCE + 1e-6, 0.0, 0.0, omega, 0.0)
    assert f_t / f_n == pytest.approx(STEADY(RADIUS * omega)[0], rel=1e-12)


@pytest.mark.parametrize("interface", [*FILMS.values(), DRY["steady friction"]])
def test_turning_together_like_one_body_moves_no_surface(interface):
    """Co-rotation: v_t = omega |e|, both bodies with omega. A mixed-up W fails here."""
    omega = 20.0
    e = 0.6 * CLEARANCE if isinstance(interface, FilmInterface) else CLEARANCE + 1e-6
    (f_n, f_t), _, _ = force_of(interface, e, 0.0, omega * e, omega, omega)
    turning_alone, _, _ = force_of(interface, e, 0.0, 0.0, omega, 0.0)
    assert abs(f_t) < 1e-8 * abs(turning_alone[1])
    if isinstance(interface, FilmInterface):
        assert abs(f_n) < 1e-8 * abs(turning_alone[0])


@pytest.mark.parametrize(
    "interface", [DRY["steady friction"], FILMS["pinkus"]], ids=["dry", "film"]
)
def test_arms_conserve_angular_momentum(interface):
    """a_J + a_B + |e| = 0: the two moments balance the couple of the separated centres."""
    for e in (0.0, 0.3 * CLEARANCE, CLEARANCE + 1e-5):
        a_j, a_b, slope_j, slope_b = interface.arms(e)
        assert a_j + a_b + e == pytest.approx(0.0, abs=1e-17)
        assert slope_j + slope_b == -1.0


def test_dry_contact_point_lies_on_the_journals_surface():
    a_j, a_b, _, _ = dry(STEADY).arms(CLEARANCE + 1e-5)
    assert a_j == RADIUS
    assert a_b == -(RADIUS + CLEARANCE + 1e-5)


def test_stored_energy_of_a_dry_pair_is_the_work_of_its_elastic_force():
    interface = dry(no_friction())
    depth = 1e-5
    assert interface.stored_energy(CLEARANCE + depth) == pytest.approx(2.5545e10 * depth**2.5 / 2.5)
    assert interface.stored_energy(0.5 * CLEARANCE) == 0.0
    assert FILMS["pinkus"].stored_energy(0.9 * CLEARANCE) == 0.0


@pytest.mark.parametrize("name", ["pinkus", "pi_film", "short", "finite"])
def test_film_outside_its_range_is_nan_and_remembered(name):
    interface = FILMS[name]
    (f_n, _), _, _ = force_of(interface, 1.01 * CLEARANCE, 0.1, 0.1, 1.0, 0.0)
    assert math.isnan(f_n)
    assert interface.outside == pytest.approx(1.01)
    force_of(interface, 0.5 * CLEARANCE, 0.1, 0.1, 1.0, 0.0)
    assert interface.outside is None


def test_only_pairs_with_a_memory_are_stateful():
    assert not dry(STEADY).stateful
    assert not FILMS["pinkus"].stateful
    assert dry(BRISTLE).stateful
    assert DRY["hysteretic damping"].stateful


def test_bristle_follows_its_differential_equation():
    """Sliding to and fro: step by step against SciPy's Radau; first order, 2 % at 2000 steps."""
    soft = LuGre(0.15, 0.1, 1e2, 0.5, 0.0, 0.1, 2.0)
    interface = dry(soft)
    e, period, steps = CLEARANCE + 1e-6, 0.1, 2000

    def speed(t):
        return 0.3 * math.sin(2 * math.pi * t / period)

    exact = solve_ivp(
        lambda t, z: [soft.rate(speed(t), z[0])],
        (0.0, period),
        [0.0],
        "Radau",
        t_eval=np.linspace(0.0, period, steps + 1),
        rtol=1e-9,
        atol=1e-14,
    )
    interface.begin_step(0.0, accepted=True)
    for number in range(1, steps + 1):
        interface.begin_step(period / steps, accepted=True)
        force_of(interface, e, 0.0, speed(number * period / steps), 0.0, 0.0)
        if number in (steps // 4, steps // 2, 3 * steps // 4):
            z = exact.y[0, number]
            v = speed(number * period / steps)
            mu = soft.sigma_0 * z + soft.sigma_1 * soft.rate(v, z)
            (f_n, f_t), _, _ = force_of(interface, e, 0.0, v, 0.0, 0.0)
            assert f_t / f_n == pytest.approx(mu, rel=0.02)


def test_bristle_is_kept_from_accepted_steps_only():
    interface = dry(BRISTLE)
    state = (CLEARANCE + 1e-6, 0.0, 0.5, 0.0, 0.0)
    interface.begin_step(1e-6, accepted=True)
    first = force_of(interface, *state)
    force_of(interface, CLEARANCE + 1e-6, 0.0, -0.5, 0.0, 0.0)
    assert force_of(interface, *state) == first, "iterations of a step leave no trace"
    interface.begin_step(1e-6, accepted=False)
    assert force_of(interface, *state) == first, "a repeated step starts where the rejected one did"
    interface.begin_step(1e-6, accepted=True)
    assert force_of(interface, *state) != first, "the next step starts where this one ended"


def test_bristle_is_not_reset_by_separation():
    """Spec 2: z goes on in free flight."""
    interface = dry(BRISTLE)
    interface.begin_step(1e-6, accepted=True)
    force_of(interface, CLEARANCE + 1e-6, 0.0, 0.5, 0.0, 0.0)
    interface.begin_step(1e-9, accepted=True)
    bent = interface.bristle
    assert bent > 0.0
    force_of(interface, 0.5 * CLEARANCE, 0.0, -0.5, 0.0, 0.0)  # at rest in the mean of the step
    interface.begin_step(1e-9, accepted=True)
    assert interface.bristle == pytest.approx(bent, rel=1e-4)


def test_approach_speed_is_that_of_the_touch():
    """Half-way between two instants the rate's square is the mean of theirs; then it is kept."""
    interface = dry(STEADY, hunt_crossley(hertz(2.5545e10), 0.7))
    for e, e_dot in ((0.9, 0.1), (0.99, 0.2), (1.01, 0.3)):
        interface.begin_step(1e-6, accepted=True)
        force = force_of(interface, e * CLEARANCE, e_dot, 0.0, 0.0, 0.0)
    touch = math.sqrt((0.2**2 + 0.3**2) / 2.0)
    contact = interface.contact.force(0.01 * CLEARANCE, 0.3, touch)
    assert force is not None and -force[0][0] == pytest.approx(contact[0])
    interface.begin_step(1e-6, accepted=True)
    assert interface.approach.speed(0.02 * CLEARANCE, 0.15) == pytest.approx(touch)
    assert interface.approach.speed(-0.02 * CLEARANCE, -0.1) == -0.1


def test_a_rebound_within_one_step_keeps_the_speed_before_it():
    approach = Approach()
    approach.speed(-1e-6, 0.2)
    approach.accept()
    assert approach.speed(1e-6, -0.1) == 0.2


def test_reset_forgets():
    interface = dry(BRISTLE)
    for _ in range(2):
        interface.begin_step(1e-3, accepted=True)
        force_of(interface, CLEARANCE + 1e-6, 0.0, 0.5, 0.0, 0.0)
    assert interface.bristle != 0.0
    interface.reset()
    interface.begin_step(1e-3, accepted=True)
    assert interface.bristle == 0.0
