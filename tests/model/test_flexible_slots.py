"""Flexible bodies in slots and moving guides: stiff they are rigid, bent a pin stays in place."""

from dataclasses import replace

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.mechanism import (
    GROUND,
    Body,
    Guide,
    Joint,
    Mechanism,
    Output,
    shipped_mechanism,
)
from exu_press.model import build
from exu_press.model.placement import placed_parts
from exu_press.result.channel import guide_channel
from exu_press.result.motion import sensor
from exu_press.result.record_run import record
from exu_press.scene import mechanism_of

pytest.importorskip("ngsolve")

from netgen.occ import Box, Cylinder, Pnt, Z

pytestmark = pytest.mark.usefixtures("sound_files")

STEEL = 2.1e11
RUN = {"joints": {}, "speed_rpm": 200.0, "revolutions": 0.12, "solver": {"tolerance": 1e-5}}
COARSE = {"tolerance": 3e-4}
PIN = (0.0, -0.25)


def bar(low, high, half_width, *bores):
    """Return a bar along y (m) of 20 mm with bores of 20 mm at points of its drawing, in mm."""
    w, d = 1e3 * half_width, 10.0
    solid = Box(Pnt(-w, 1e3 * low, -d), Pnt(w, 1e3 * high, d))
    for x, y in bores:
        solid -= Cylinder(Pnt(1e3 * x, 1e3 * y, -100), Z, r=10.0, h=200)
    return solid


def pin_in_slot():
    """Return a slider-crank whose slider is a pin of the rod in a slot of the frame."""
    bodies = (Body("crank", 5.0, 0.02), Body("rod", 1.0, 0.01, (0.0, -0.1)))
    joints = (
        Joint("shaft", (0.0, 0.0), "crank", GROUND),
        Joint("crank_pin", (0.0, 0.05), "crank", "rod"),
    )
    slot = Guide("end", (0.0, 1.0), "rod", at=PIN)
    return Mechanism("pin_in_slot", bodies, joints, (slot,), "crank", Output("rod"))


def inverted():
    """Return the shipped inverted slider-crank with its output on the block."""
    return replace(shipped_mechanism("inverted_slider_crank"), output=Output("block"))


def slider_crank():
    return mechanism_of(Scene(mechanism="slider_crank"))


WRIST = slider_crank().joints[-1].at[1]
SIDES = [{"x": [side - 1e-3, side + 1e-3], "y": [0, 0.1]} for side in (-0.03, 0.03)]
TOP = {"y": [-0.061, -0.059]}
CASES = {
    "slider": (slider_crank, "slider", bar(-0.65, -0.3, 0.04, (0.0, WRIST)), {}, "guides.slider"),
    "pin": (pin_in_slot, "rod", bar(-0.27, 0.07, 0.02, (0.0, 0.05), PIN), {}, "slots.end"),
    "block": (inverted, "block", bar(0.0, 0.1, 0.03, (0.0, 0.05)), SIDES, "guides.block"),
    "carrier": (inverted, "arm", bar(-0.18, -0.06, 0.05, (0.03, -0.15)), TOP, "guides.block"),
}
"""Mechanism, flexible body, its solid, its faces in the slot or guide, and this one's key."""


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """Return a function of a case and its body's keys that returns the scene, also as rigid."""
    folder = tmp_path_factory.mktemp("solids")

    def scenes(case, body, **changes):
        mechanism, name, solid, faces, key = CASES[case]
        path = folder / f"{case}.step"
        if not path.exists():  # a file has the time in it, and another one is reduced again
            solid.WriteStep(str(path))
        held = {"faces": {key.partition(".")[2]: faces}} if faces else {}
        own = {"flexible": str(path), "mesh_size": 0.05, **body, **held}
        keys = {**RUN, "mechanism": mechanism(), "bodies": {name: own}, **changes}
        part = placed_parts(Scene(**{k: v for k, v in keys.items() if k != "guide"}))[name]
        at = mechanism().body(name)
        x, y = part.centre_of_mass
        centre = at.centre_of_mass[0] + x, at.centre_of_mass[1] + y
        solid_body = replace(
            at, mass=part.reduced.mass, inertia=part.inertia, centre_of_mass=centre
        )
        bodies = [solid_body if b.name == name else b for b in mechanism().bodies]
        keys["mechanism"] = replace(mechanism(), bodies=tuple(bodies))
        rigid = {k: v for k, v in keys.items() if k != "bodies"}
        channel = guide_channel(keys["mechanism"], key.partition(".")[2])
        return Scene(**keys), Scene(**rigid), channel

    return scenes


GUIDEWAY = {
    "clearance": 2e-5,
    "friction": "coulomb",
    "length": 0.06,
    "width": 0.02,
    "lateral_stiffness": 1e8,
}


SPRINGS = {"lateral_stiffness": 1e8, "length": 0.06, "damping_ratio": 0.5}

LONG = pytest.mark.long
MOTION = "slider_position", "slider_velocity"


@pytest.mark.parametrize(
    ("case", "body", "guide"),
    [
        *((case, {"modes": 0}, None) for case in CASES),
        *(
            pytest.param(case, {"youngs_modulus": 1e4 * STEEL, "modes": 8}, None, marks=LONG)
            for case in CASES
        ),
        pytest.param("pin", {"modes": 0}, GUIDEWAY, marks=LONG),
        ("block", {"modes": 0}, SPRINGS),
        ("carrier", {"modes": 0}, {"friction": "coulomb"}),
        ("slider", {"modes": 0}, SPRINGS | {"friction": "stribeck"}),
        pytest.param("slider", {"modes": 0}, GUIDEWAY, marks=LONG),
    ],
)
def test_stiff_it_is_the_rigid_body(drawn, case, body, guide):
    flexible, rigid, channel = drawn(case, body, guide=guide)
    result, other = simulate(flexible), simulate(rigid)
    assert result.completed and other.completed, result.info["reason"] + other.info["reason"]
    compared = [*MOTION, f"{channel}_force"]
    compared += [
        n for n in (f"{channel}_{of}" for of in ("friction", "loss", "moment")) if n in other
    ]
    for name in compared:
        there = np.interp(result.time, other.time, other[name])
        difference = np.abs(result[name] - there).max()
        exact = name in MOTION or (body["modes"] == 0 and "lateral_stiffness" not in (guide or {}))
        assert 0.0 < difference < (2e-5 if exact else 1e-3) * np.abs(there).max(), name


def test_bent_its_pin_stays_in_the_slot(drawn):
    """The pin of a rod a hundredth as stiff follows the slot, and its unbent line does not."""
    scene, _, channel = drawn("pin", {"youngs_modulus": 0.003 * STEEL, "modes": 8}, solver=COARSE)
    model = build(scene)
    result = record(model, model.solve())
    assert result.completed, result.info["reason"]
    assert result.quantity("energy.residual").value < 1e-3
    assert np.abs(result[f"{channel}_force"]).max() > 1.0

    placed = model.parts["rod"]
    centre, modes = placed.carried_point((placed.carriers["end"],), scene_point(scene))
    reference = np.array(model.mbs.GetNodeParameter(model.nodes["rod"], "referenceCoordinates"))
    frame = sensor(model, "rod", "position") + reference
    angle = 2.0 * np.arctan2(frame[:, 6], frame[:, 3])
    bent = centre[:2] + (sensor(model, "rod_modes", "position") @ modes.T)[:, :2]
    beside = [
        frame[:, 0] + np.cos(angle) * x - np.sin(angle) * y
        for x, y in (centre[:2, None] * np.ones(len(angle)), bent.T)
    ]
    unbent_error, bent_error = (np.abs(x).max() for x in beside)
    assert bent_error < 1e-9
    assert unbent_error > 1e-6


def scene_point(scene):
    """Return the pin of the rod in its body's frame."""
    return mechanism_of(scene).body("rod").local(PIN)


def test_a_slot_along_a_flexible_body_is_refused():
    with pytest.raises(InputError, match=r"bodies\.arm\.faces\.block: missing.*face to face"):
        Scene(mechanism="inverted_slider_crank", joints={}, bodies={"arm": "any.step"})
