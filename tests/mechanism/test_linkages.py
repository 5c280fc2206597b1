"""Closed forms of the linkages with slides between moving bodies, as they are shipped."""

from dataclasses import replace

import numpy as np
import pytest
from refused import refused

from exu_press import Scene, simulate
from exu_press.mechanism import (
    GROUND,
    Body,
    Guide,
    Joint,
    Mechanism,
    Output,
    change_mechanism,
    mechanism_from_dict,
    mechanism_to_dict,
    shipped_mechanism,
)
from exu_press.mechanism.examine import examine
from exu_press.mechanism.guide_motion import motion_in_guide
from exu_press.quantities import quantities_of

ANGLE = np.radians(np.arange(0.0, 360.0, 7.0))
UP = 0.5 * np.pi


def swung(crank, shaft):
    """Angle of an arm on a pivot in the origin, on which a crank's pin slides."""
    pin = shaft * 1j + crank * np.exp(1j * (ANGLE + UP))
    return np.unwrap(np.angle(pin))


def ram_of(end, length, height, side):
    """Place of a ram at a height on a rod from an end."""
    return end.real + side * np.sqrt(length**2 - (end.imag - height) ** 2)


def whitworth():
    arm = swung(0.12, 0.05)
    return ram_of(-0.1 * np.exp(1j * arm), np.hypot(0.34, 0.1), 0.0, 1.0)


def crank_shaper():
    arm = swung(0.1, 0.4)
    return ram_of(0.75 * np.exp(1j * arm), np.hypot(0.2, 0.04), 0.71, -1.0)


def oscillating_cylinder():
    pin = 0.06j * np.exp(1j * ANGLE)
    along = pin + 0.3j
    return (pin - 0.16 * along / abs(along)).imag


def inverted_slider_crank():
    pin = 0.05j * np.exp(1j * ANGLE) - complex(0.03, -0.15)
    on_arm = -0.03 + 1j * np.sqrt(abs(pin) ** 2 - 0.03**2)
    return np.angle(pin / on_arm)


def oldham():
    return 0.01 * np.sin(2.0 * ANGLE)


def scotch_yoke():
    return -0.1 * np.sin(ANGLE)


def elliptic_trammel():
    drawn = np.arctan2(0.06, 0.08)
    pin = 0.1 * np.exp(1j * (ANGLE + drawn))
    beside = complex(0.07, -0.03)
    return (pin + beside * np.exp(-1j * ANGLE)).imag


LINKAGES = [
    whitworth,
    crank_shaper,
    oscillating_cylinder,
    inverted_slider_crank,
    oldham,
    scotch_yoke,
    elliptic_trammel,
]


CLOSED_FORM = pytest.mark.validation(
    "closed form",
    "motion of linkages with slides and slots between moving bodies",
    "trigonometry of their drawings",
    "equation",
)


@CLOSED_FORM
@pytest.mark.parametrize("form", LINKAGES)
def test_slides_between_moving_bodies_follow_their_closed_forms(form, compare):
    mechanism = shipped_mechanism(form.__name__)
    position = mechanism.ideal_slider(ANGLE, 1.0)[0]
    stroke = examine(mechanism).stroke.length
    name = f"{form.__name__.replace('_', ' ')}, output over its stroke"
    unit = "rad" if mechanism.output.rotation else "m"
    compare(name, form(), position, error=None, rel=1e-9, scale=stroke, unit=unit)


@pytest.mark.parametrize("name", ["whitworth", "crank_shaper", "scotch_yoke"])
def test_forces_of_slides_keep_momentum_and_energy(name):
    result = simulate(Scene(mechanism=name, revolutions=0.5, gravity=0.0))
    shaking = result["shaking_force"]
    assert result["frame_force"] == pytest.approx(shaking, abs=1e-5 * np.abs(shaking).max())
    assert result.quantity("energy.residual").value < 1e-3


def test_an_output_that_turns_around_has_no_dead_centres():
    drawn = replace(shipped_mechanism("oldham"), output=Output("driven_hub", rotation=True))
    assert drawn.ideal_slider(ANGLE, 1.0)[0] == pytest.approx(ANGLE, abs=1e-12)
    assert not examine(drawn).stroke.dead_centres
    assert "swing" not in quantities_of(Scene(mechanism=drawn))


def test_an_output_that_rotates_has_the_figures_of_a_rotation():
    result = simulate(Scene(mechanism="inverted_slider_crank", revolutions=1.0))
    swing = result.quantity("swing")
    examined = examine(shipped_mechanism("inverted_slider_crank"))
    assert (swing.value, swing.unit) == (pytest.approx(examined.stroke.length, rel=1e-6), "rad")
    assert result.units["slider_acceleration"] == "rad/s^2"
    assert "stroke" not in result.summary()["quantities"]
    assert [centre.top for centre in examined.stroke.dead_centres] == [True, False]


def test_a_rotation_has_no_height_for_a_load():
    spring = {"kind": "spring", "height": 0.01, "travel": [0.0, 0.1], "force": [0.0, 1.0]}
    message = refused(Scene, mechanism="inverted_slider_crank", load={"cushion": spring})
    assert message.startswith("load.cushion: acts over the output's height")


def test_a_body_that_a_guide_holds_upright_does_not_rotate():
    drawn = shipped_mechanism("whitworth")
    message = refused(replace, drawn, output=Output("ram", rotation=True))
    assert message.startswith("output.rotation = true: guides.ram holds the angle of ram")


def curved_yoke(**slot):
    """A yoke whose circular slot moves it as a rod of its radius would move a slider."""
    return Mechanism(
        "curved_yoke",
        [Body("crank", 10.0, 0.05), Body("yoke", 6.0, 0.05)],
        [Joint("shaft", (0.0, 0.0), "crank", GROUND)],
        [
            Guide("yoke", (1.0, 0.0)),
            Guide("arc", body="crank", on="yoke", at=(0.0, 0.1), centre=(0.4, 0.1), **slot),
        ],
        "crank",
        Output("yoke", (1.0, 0.0)),
    )


@CLOSED_FORM
def test_a_circular_slot_moves_its_body_as_a_rod_does(compare):
    pin = 0.1j * np.exp(1j * ANGLE)
    expected = pin.real + np.sqrt(0.4**2 - (pin.imag - 0.1) ** 2) - 0.4
    drawn = curved_yoke()
    position = drawn.ideal_slider(ANGLE, 1.0)[0]
    compare("yoke with a circular slot", expected, position, error=None, abs=1e-12, unit="m")
    (arc,) = [guide for guide in drawn.guides if guide.radius is not None]
    (low, _), (_, rate), (high, _) = (
        motion_in_guide(drawn, arc, drawn.motion(ANGLE + h, 1.0)) for h in (-1e-6, 0.0, 1e-6)
    )
    assert rate == pytest.approx((high - low) / 2e-6, abs=1e-8)
    angle = examine(drawn).transmission["arc"][:360:90]
    assert np.cos(angle) == pytest.approx([0.0, 0.25, 0.5, 0.25], abs=1e-9)
    result = simulate(Scene(mechanism=drawn, revolutions=0.5, gravity=0.0))
    shaking = result["shaking_force"]
    assert result["frame_force"] == pytest.approx(shaking, abs=1e-5 * np.abs(shaking).max())
    force = result["arc_slot_force"]
    angle, mass = result["crank_angle"], 6.0
    # a rod's force, by the acceleration of the slider
    sine = (np.cos(angle) - 1.0) / 4.0
    tension = mass * result["slider_acceleration"] / np.sqrt(1.0 - sine**2)
    assert force == pytest.approx(tension, abs=1e-3 * np.abs(tension).max())


def test_a_pin_at_the_end_of_its_slot_is_told_with_the_crank_angle():
    changed = change_mechanism(
        mechanism_to_dict(shipped_mechanism("scotch_yoke")), {"slots.yoke_slot.length": 0.19}
    )
    fault = examine(mechanism_from_dict(changed)).faults[0]
    assert "the pin of crank reaches an end of slots.yoke_slot at crank angle 0 deg" in fault
    assert "it needs a length of 0.2 m and has 0.19 m" in fault
    off_middle = change_mechanism(
        mechanism_to_dict(mechanism_from_dict(changed)), {"slots.yoke_slot.middle": [0.0, 0.05]}
    )
    fault = examine(mechanism_from_dict(off_middle)).faults[0]
    assert "of 0.3 m about its `middle`, or 0.2 m about that of the pin's way" in fault
    assert refused(Scene, mechanism=mechanism_from_dict(changed)).startswith("scotch_yoke: the pin")
    fault = examine(curved_yoke(length=0.3)).faults[0]
    needed = float(fault.partition("a length of ")[2].split()[0])
    assert examine(curved_yoke(length=needed)).error is None  # it is rounded up
    assert examine(curved_yoke(length=0.3, middle=(0.01, 0.0))).error is None
    assert "slots.arc at crank angle" in examine(curved_yoke(length=0.3)).faults[0]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"slots.yoke_slot.centre": [0.0, 0.0]}, "slots.yoke_slot: allowed is a direction"),
        ({"slots.yoke_slot.direction": None}, "slots.yoke_slot: allowed is a direction"),
        (
            {"slots.yoke_slot.at": [0.0, 0.0]},
            "crank = 'crank': all joints and pins lie on",
        ),
        ({"slots.yoke_slot.pin": "yoke"}, "slots.yoke_slot: guides 'yoke' on itself"),
        ({"guides.yoke.length": 0.1}, "guides.yoke.length"),
    ],
)
def test_faults_of_slots_are_named(changes, message):
    drawn = mechanism_to_dict(shipped_mechanism("scotch_yoke"))
    assert refused(mechanism_from_dict, change_mechanism(drawn, changes)).startswith(message)


def test_a_redundant_slot_is_counted_as_a_redundant_joint_is():
    examined = examine(shipped_mechanism("elliptic_trammel"))
    assert examined.mobility.redundant == 1
    second = Guide("second", (0.0, 1.0), body="crank", on="yoke", at=(0.02, 0.08))
    drawn = shipped_mechanism("scotch_yoke")
    locked = replace(drawn, guides=(*drawn.guides, second))
    fault = examine(locked).faults[-1]
    assert "1 degree of freedom too few" in fault
    assert "slots.second" in fault
