"""What two surfaces do to each other: derivatives, rigid rotation, arms, memory."""

import pytest
from planar_states import BRISTLE, CLEARANCE, LAWS, RADIUS, STEADY, STIFFNESS, dry, film

from exu_press.joints.interface import FilmInterface
from exu_press.laws.film import pi_film, with_asperities
from exu_press.laws.friction import no_friction

FILMS = {name: film(law) for name, law in LAWS.items()}
ROUGH = film(with_asperities(pi_film(), 0.1))


def force_of(interface, e, e_dot, v_t, omega_j, omega_b):
    """Return f_n and f_t, then the partials of each."""
    load = interface.load(e, e_dot, v_t, omega_j, omega_b)
    return load and (load[:2], *interface.partials(load[4], e, omega_j, omega_b))


def test_contact_begins_at_the_clearance():
    assert force_of(dry(no_friction()), CLEARANCE, 0.1, 0.0, 0.0, 0.0) is None
    (f_n, f_t), _, _ = force_of(dry(no_friction()), CLEARANCE + 1e-6, 0.0, 0.3, 0.0, 0.0)
    assert f_n == pytest.approx(-STIFFNESS * 1e-6**1.5)
    assert f_t == 0.0


def test_friction_acts_on_the_sliding_of_the_two_surfaces():
    """A turning journal that stays in place slides with R omega."""
    omega = 3.0
    (f_n, f_t), _, _ = force_of(dry(), CLEARANCE + 1e-6, 0.0, 0.0, omega, 0.0)
    assert f_t / f_n == pytest.approx(STEADY(RADIUS * omega)[0], rel=1e-12)


@pytest.mark.parametrize("interface", [*FILMS.values(), ROUGH, dry()])
def test_turning_together_like_one_body_moves_no_surface(interface):
    """Co-rotation: v_t = omega |e|, both bodies with omega. A mixed-up W fails here."""
    omega = 20.0
    e = 0.6 * CLEARANCE if isinstance(interface, FilmInterface) else CLEARANCE + 1e-6
    (f_n, f_t), _, _ = force_of(interface, e, 0.0, omega * e, omega, omega)
    turning_alone, _, _ = force_of(interface, e, 0.0, 0.0, omega, 0.0)
    assert abs(f_t) < 1e-8 * abs(turning_alone[1])
    if isinstance(interface, FilmInterface):
        assert abs(f_n) < 1e-8 * abs(turning_alone[0])


@pytest.mark.parametrize("interface", [dry(), FILMS["pinkus"]], ids=["dry", "film"])
def test_arms_conserve_angular_momentum(interface):
    """a_J + a_B + |e| = 0: the two moments balance the couple of the separated centres."""
    for e in (0.0, 0.3 * CLEARANCE, CLEARANCE + 1e-5):
        a_j, a_b, slope_j, slope_b = interface.arms(e)
        assert a_j + a_b + e == pytest.approx(0.0, abs=1e-17)
        assert slope_j + slope_b == -1.0


def test_dry_contact_point_lies_on_the_journals_surface():
    a_j, a_b, _, _ = dry().arms(CLEARANCE + 1e-5)
    assert a_j == RADIUS
    assert a_b == -(RADIUS + CLEARANCE + 1e-5)


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
