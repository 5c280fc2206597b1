"""The joints and guides of a scene that wear, and their data."""

from exu_press.scene.joint import DryJoint, Joint, LubricatedJoint
from exu_press.scene.scene import Scene, mechanism_of
from exu_press.scene.wear import WearAt

__all__ = ["wear_of_guide", "wear_of_joint", "wearing_guides", "wearing_joints"]


def wearing_joints(scene: Scene) -> tuple[str, ...]:
    """Return the joints whose wear is asked for: revolute ones whose surfaces touch."""
    if scene.wear is None:
        return ()
    drawn = mechanism_of(scene).joints
    return tuple(j.name for j in drawn if not j.spherical and touches(scene.joints[j.name]))


def wearing_guides(scene: Scene) -> tuple[str, ...]:
    """Return the bodies whose guides' wear is asked for: those with clearance."""
    if scene.wear is None:
        return ()
    return tuple(g.body for g in mechanism_of(scene).guides if g.guideway is not None)


def wear_of_joint(scene: Scene, joint: str) -> WearAt:
    """Return coefficient, hardness and length of a joint that wears."""
    assert scene.wear is not None
    return scene.wear.at("joints", joint)


def wear_of_guide(scene: Scene, body: str) -> WearAt:
    """Return coefficient, hardness and length of a guide that wears."""
    assert scene.wear is not None
    return scene.wear.at("guides", body)


def touches(joint: Joint) -> bool:
    """Return whether a joint's surfaces may touch."""
    return isinstance(joint, DryJoint | LubricatedJoint) and joint.onset is not None
