"""Quantities of joints: those that a kind of joint has, and their values on a run's channels."""

from types import SimpleNamespace

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.quantities import values_of
from exu_press.quantities.joints import contact_onsets, share_of_contact
from exu_press.quantities.slopes import slope_warnings

FILM = {"kind": "lubricated", "film": {"at_contact": "mixed", "roughness": 1e-6}}


@pytest.fixture(scope="module")
def run():
    return simulate(Scene(joints={"crank_pin": FILM, "balls": "dry"}, revolutions=0.1))


def test_values_are_those_of_the_channels(run):
    gap = 1e-4 - np.linalg.norm(run["ball_left_eccentricity"], axis=1)
    found = {name: value.value for name, value in values_of(run).items()}
    assert found["joints.ball_left.peak_penetration"] == max(0.0, -gap.min())
    assert found["joints.ball_left.max_eccentricity_ratio"] == pytest.approx(1.0 - gap.min() / 1e-4)
    force = np.linalg.norm(run["ball_left_force"], axis=1).max()
    assert found["joints.ball_left.peak_force"] == pytest.approx(force, rel=1e-12)
    both = found["joints.ball_left.share_contact"] + found["joints.ball_left.share_free_flight"]
    assert both == pytest.approx(1.0)
    film = 1e-4 - np.linalg.norm(run["crank_pin_eccentricity"], axis=1)
    assert found["joints.crank_pin.min_film"] == pytest.approx(max(0.0, film.min()))


@pytest.mark.parametrize("modulus", [1e7, 1e11])
def test_a_joint_that_is_pressed_in_deep_is_warned_of(modulus):
    """A modulus in MPa: the run goes on, with a journal that leaves its bearing."""
    joints = {"crank_pin": "dry"}
    scene = Scene(mechanism="slider_crank", joints=joints, contact={"modulus": modulus})
    result = simulate(scene.replace({"revolutions": 0.1}))
    deep = result.quantity("joints.crank_pin.peak_penetration").value / 0.07
    said = [text for text in result.summary()["warnings"] if "pressed in by" in text]
    assert (deep > 0.01) == (modulus < 1e9) == bool(said)
    assert all(f"{100.0 * deep:.3g} % of its radius" in text for text in said)


@pytest.mark.parametrize("clearance", [5e-6, 1e-4])
def test_a_ball_whose_contact_is_as_wide_as_itself_is_warned_of(clearance):
    """Hertz's contact radius is sqrt(R delta), 1 / R = 1 / r - 1 / (r + c)."""
    pin = {"kind": "dry", "clearance": clearance, "radius": 0.07}
    scene = Scene(
        mechanism="slider_crank",
        joints={"wrist_pin": pin},
        contact={"shape": "point"},
        revolutions=0.1,
    )
    result = simulate(scene)
    depth = result.quantity("joints.wrist_pin.peak_penetration").value
    wide = np.sqrt(depth * 0.07 * (0.07 + clearance) / clearance) / 0.07
    said = [text for text in result.summary()["warnings"] if "times the ball's" in text]
    assert (wide > 0.5) == (clearance < 1e-5) == bool(said)
    assert all(f"{wide:.2g} times the ball's" in text for text in said)


TIME = np.linspace(0.0, 1.0, 1001)
APART = np.full(1001, -5e-5)


def test_touches_and_their_share_of_time():
    """Any penetration is one: that of a watch's shaft is 1e-17 m, and bears all of its load.

    Surfaces that are pressed from the start on have had no impact.
    """
    for depth, touches, share in (
        (APART, 0, 0.0),
        (-APART, 0, 1.0),
        (np.zeros(1001), 0, 0.0),
        (np.full(1001, 1e-17), 0, 1.0),
    ):
        assert len(contact_onsets(depth)) == touches
        assert share_of_contact(TIME, depth) == pytest.approx(share)
    assert share_of_contact(np.zeros(1), np.zeros(1)) == 0.0
    for rising in (1, -1):
        assert share_of_contact(np.arange(2.0), np.array([-3.0, 1.0])[::rising]) == 0.25
    depth = APART.copy()
    depth[100:201], depth[500:901] = 2e-6, 5e-6
    assert contact_onsets(depth).tolist() == [100, 500]
    assert share_of_contact(TIME, depth) == pytest.approx(0.5, abs=3e-4)  # jumps take a step


def test_shares_are_shares_of_time_not_of_steps():
    time = np.concatenate([np.linspace(0.0, 0.9, 10), np.linspace(0.91, 1.0, 1000)])
    depth = np.where(time > 0.905, 1e-6, -1e-4)
    assert share_of_contact(time, depth) == pytest.approx(0.09, abs=1e-3)


CLEARANCE, LENGTH, ASPERITIES = 1e-4, 0.05, 6e-7


class Bent(dict):
    """A result whose journal is at an eccentricity, with a slope along it."""

    def __init__(self, eccentricity, slope):
        super().__init__(pin_slope=np.array([[slope, 0.0]]))
        film = SimpleNamespace(length=LENGTH, contact_gap=ASPERITIES)
        self.scene = SimpleNamespace(joints={"pin": SimpleNamespace(film=film)})
        at = np.array([[eccentricity, 0.0]])
        self.joints = {
            "pin": SimpleNamespace(clearance=CLEARANCE, eccentricity=at, distance=np.abs(at[:, 0]))
        }


@pytest.mark.parametrize(
    ("middle", "thinner", "warns"),
    [
        (2e-5, 0.9e-5, False),
        (2e-5, 1.1e-5, True),
        (-1e-7, 0.4 * ASPERITIES, False),  # the middle touches: asperities leave their height
        (-1e-7, 0.6 * ASPERITIES, True),
        (0.0, 1e-5, True),
    ],
)
def test_where_an_end_has_half_of_the_film(middle, thinner, warns):
    result = Bent(CLEARANCE - middle, thinner / (0.5 * LENGTH))
    texts = list(slope_warnings(SimpleNamespace(result=result)))
    assert len(texts) == warns
    if warns:
        assert f"where the middle has {1e6 * max(0.0, middle):.3g} um" in texts[0]
