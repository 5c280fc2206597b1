"""Every channel that a run may have: name, unit, meaning, columns, and which runs have it."""

from dataclasses import dataclass
from functools import cached_property

from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel, guide_channel
from exu_press.scene import Scene, mechanism_of
from exu_press.scene.applied import applied_loads
from exu_press.scene.joint import oil_of
from exu_press.scene.wearing import wearing_joints

__all__ = ["DECLARED", "PLACES", "Declared", "channel", "expected"]

VECTOR = "vector"
"""Columns of a vector: "space" at a spherical joint, "plane" elsewhere."""

PLACES = {
    "": "every run",
    "joint": "ideal joints whose force is known",
    "loose": "joints with clearance",
    "warm": "lubricated joints whose oil warms",
    "worn": "joints that are worn from the start",
    "wearing": "joints whose wear is asked for",
    "guide": "guides; that of the slider is `guide`",
    "load": "loads",
    "body": "flexible bodies",
    "faced": "joints of flexible bodies that turn on the frame",
}
"""Owner of a channel -> the runs that have it."""


@dataclass(frozen=True)
class Declared:
    """A channel.

    Attributes:
        name: in braces its owner, one of PLACES; nothing in braces is the whole run's.
        unit: SI.
        meaning: in words; in braces its place, and which `way` is positive.
        axis: meaning of its columns, see `exu_press.result.channel.AXES`, or VECTOR.
        always: whether all runs with such a place have it.
        unless: which runs do not have it.
    """

    name: str
    unit: str
    meaning: str
    axis: str = ""
    always: bool = True
    unless: str = ""

    def axis_at(self, place: str, *, spherical: bool) -> str:
        """Return the meaning of its columns at a place."""
        if self.axis == VECTOR:
            return "space" if spherical else "plane"
        return self.axis.format(**{self.of: place}) if self.of else self.axis

    @cached_property
    def of(self) -> str:
        """Its owner."""
        return self.name.partition("{")[2].partition("}")[0]

    def at(self, place: str) -> str:
        """Return its name at a place."""
        return self.name.format(**{self.of: place}) if self.of else self.name


OWN = "with items of a user's own in the model"
UNBALANCED = "of a mechanism without counterweight"
NO_CLUTCH, NO_BRAKE = "of a drive without clutch", "of a drive without brake"

DECLARED = {
    one.name: one
    for one in (
        Declared("time", "s", "time"),
        Declared("crank_angle", "rad", "crank angle from the mechanism's zero"),
        Declared("crank_speed", "rad/s", "angular velocity of the drive"),
        Declared("slider_position", "m", "slider position, {way}"),
        Declared("slider_velocity", "m/s", "slider velocity, {way}"),
        Declared("slider_acceleration", "m/s^2", "slider acceleration, {way}"),
        Declared("slider_lateral", "m", "slider beside its guide, {way}"),
        Declared("slider_tilt", "rad", "slider tilt, counter-clockwise"),
        Declared("body_position", "m, rad", "centres of mass and angles", "pose"),
        Declared("drive_torque", "N m", "torque of the drive; a motor's turns flywheel and crank"),
        Declared("drive_power", "W", "power of the drive"),
        Declared("flywheel_speed", "rad/s", "angular velocity of the flywheel", unless=NO_CLUTCH),
        Declared("clutch_torque", "N m", "torque of the clutch on the crank", unless=NO_CLUTCH),
        Declared("clutch_loss", "J", "clutch: energy dissipated since the start", unless=NO_CLUTCH),
        Declared("brake_torque", "N m", "torque of the brake, against the crank", unless=NO_BRAKE),
        Declared("brake_loss", "J", "brake: energy dissipated since the start", unless=NO_BRAKE),
        Declared("crank_torque", "N m", "torque that turns the crank, behind the flywheel"),
        Declared("frame_force", "N", "force of shaft, pivots and guides on the frame", "plane"),
        Declared("shaking_force", "N", "shaking force: minus the rate of momentum", "plane"),
        Declared(
            "shaking_force_without_counterweight",
            "N",
            "shaking force without the counterweight",
            "plane",
            unless=UNBALANCED,
        ),
        Declared("energy_input", "J", "work of drive and loads since the start", unless=OWN),
        Declared("energy_stored", "J", "change of stored energy", unless=OWN),
        Declared("energy_dissipated", "J", "energy dissipated since the start", unless=OWN),
        Declared("{joint}_force", "N", "{joint}: force on journal", VECTOR, always=False),
        Declared("{loose}_force", "N", "{loose}: force on journal", VECTOR),
        Declared("{loose}_eccentricity", "m", "{loose}: journal minus bearing centre", VECTOR),
        Declared("{loose}_moment", "N m", "{loose}: moment on journal and on bearing", "ends"),
        Declared("{loose}_power", "W", "{loose}: dissipated power"),
        Declared("{worn}_gap", "m", "{worn}: least gap of the worn surfaces, or -penetration"),
        Declared(
            "{wearing}_normal_force", "N", "{wearing}: normal force of the contact", always=False
        ),
        Declared("{wearing}_sliding", "m/s", "{wearing}: sliding velocity", always=False),
        Declared("{loose}_loss", "J", "{loose}: energy dissipated since the start"),
        Declared("{warm}_temperature", "deg C", "{warm}: temperature of the film"),
        Declared("{warm}_viscosity", "Pa s", "{warm}: viscosity of the film"),
        Declared("{warm}_side_flow", "m^3/s", "{warm}: oil that leaves the bearing's ends"),
        Declared("{warm}_carried_off", "J", "{warm}: heat given to oil and frame since the start"),
        Declared("{guide}_force", "N", "{guide}: force on the body, {way}", always=False),
        Declared(
            "{guide}_moment", "N m", "{guide}: moment on the body, counter-clockwise", always=False
        ),
        Declared("{guide}_friction", "N", "{guide}: friction on the body, {way}", always=False),
        Declared(
            "{guide}_normal_force",
            "N",
            "{guide}: normal forces on the body's back and front end, on the right side +",
            "guided",
            always=False,
        ),
        Declared(
            "{guide}_sliding", "m/s", "{guide}: sliding velocity of both ends", "guided", False
        ),
        Declared("{guide}_loss", "J", "{guide}: energy dissipated since the start", always=False),
        Declared(
            "{guide}_gap",
            "m",
            "{guide}: least thickness of its film, or minus the penetration",
            always=False,
        ),
        Declared("load_{load}_force", "N", "load {load}: force"),
        Declared("load_{load}_work", "J", "load {load}: work since the start"),
        Declared(
            "load_{load}_moment",
            "N m",
            "load {load}: moment about its body's centre of mass, counter-clockwise",
            always=False,
            unless="where a load acts on the centre of mass",
        ),
        Declared("{body}_strain_energy", "J", "{body}: elastic energy", always=False),
        Declared(
            "{body}_modes_loss",
            "J",
            "{body}: energy dissipated by the damping of modes since the start",
            always=False,
        ),
        Declared("{body}_modes", "kg^0.5 m", "{body}: modal coordinates", "{body}_mode", False),
        Declared(
            "{body}_stress",
            "Pa",
            "{body}: von Mises stress where it is largest, with the sign of the mean stress",
            always=False,
        ),
        Declared("{body}_elongation", "m", "{body}: joints further apart", always=False),
        Declared("{body}_bending", "rad", "{body}: joints turned apart", always=False),
        Declared(
            "{faced}_deflection", "m", "{faced}: displacement from a rigid body", "plane", False
        ),
    )
}
"""By name, in the order in which they are told."""


def channel(
    name: str, values: Array, place: str = "", *, words: str = "", way: str = ""
) -> dict[str, Channel]:
    """Return a declared channel of a run, by its name there.

    Args:
        name: as it is declared.
        values: over time.
        place: joint, guide, load or body to which it belongs.
        words: for the place, unless its name says it.
        way: that is positive.
    """
    one = DECLARED[name]
    axis = one.axis_at(place, spherical=values.shape[1:] == (3,))
    named = {one.of or "whole": words or place.replace("_", " "), "way": way}
    return {one.at(place): Channel(values, one.unit, one.meaning.format(**named), axis)}


def expected(scene: Scene, *, own_items: bool) -> dict[str, tuple[str, bool]]:
    """Return the channels that a scene's runs may have -> their columns, and whether all have them.

    Args:
        scene: complete.
        own_items: whether the model has items of the user's own.
    """
    mechanism = mechanism_of(scene)
    joints = [joint.name for joint in mechanism.joints]
    spherical = {joint.name for joint in mechanism.joints if joint.spherical}
    places = {
        "": [""],
        "joint": joints,
        "loose": [name for name in joints if scene.joints[name].kind != "ideal"],
        "warm": [name for name in joints if oil_of(scene.joints[name]) is not None],
        "worn": [name for name in joints if scene.joints[name].worn is not None],
        "wearing": list(wearing_joints(scene)),
        "guide": [guide_channel(mechanism, guide.body) for guide in mechanism.guides],
        "load": list(applied_loads(scene)),
        "body": [body.name for body in mechanism.bodies],
        "faced": joints,
    }
    motor = scene.drive
    missing = {
        OWN: own_items,
        UNBALANCED: not mechanism.counterweight,
        NO_CLUTCH: motor is None or motor.clutch_torque is None,
        NO_BRAKE: motor is None or motor.brake_torque is None,
    }
    return {
        one.at(place): (one.axis_at(place, spherical=place in spherical), one.always)
        for one in DECLARED.values()
        for place in places[one.of]
        if not missing.get(one.unless, False)
    }
