"""The joints and guides of a scene that wear, and their data."""

from exu_press.scene.scene import Scene, mechanism_of
from exu_press.scene.wear import WearAt

__all__ = ["wear_of", "wearing_guides", "wearing_joints"]


def wearing_joints(scene: Scene) -> tuple[str, ...]:
    """Return the joints whose wear is asked for: revolute ones whose surfaces touch."""
    if scene.wear is None:
        return ()
    drawn = mechanism_of(scene).joints
    touching = [joint for joint in drawn if scene.joints[joint.name].onset is not None]
    return tuple(joint.name for joint in touching if not joint.spherical)


def wearing_guides(scene: Scene) -> tuple[str, ...]:
    """Return guides and slots whose wear is asked for: with clearance, and pins of a diameter."""
    if scene.wear is None:
        return ()
    return tuple(
        guide.name
        for guide in mechanism_of(scene).guides
        if guide.guideway and (guide.guideway.half_width > 0.0 or not guide.is_slot)
    )


def wear_of(scene: Scene, kind: str, name: str) -> WearAt:
    """Return coefficient, hardness and length of one of the "joints" or "guides" that wear."""
    assert scene.wear is not None
    return scene.wear.law_of(kind, name)
