"""The variants of one scene."""

from exu_press.errors import InputError
from exu_press.scene import Scene
from exu_press.scene.joint import DEFAULT_KINDS

__all__ = ["variants"]


def variants(scene: Scene) -> dict[str, Scene]:
    """Return the scene with ideal, with dry and with lubricated joints, by label.

    These are the scene's joints with clearance, or those that its mechanism usually has; balls are
    dry beside lubricated pins. A scene with flexible bodies is compared with rigid ones too.
    Clearances, loads and whatever else a variant uses are the scene's.

    Raises:
        InputError: the scene has no joint with clearance, nor does its mechanism usually have one.
    """
    names = list(scene.joints.grouped) or list(DEFAULT_KINDS.get(scene.shipped, {}))
    if not names:
        raise InputError(
            "joints: none has clearance, and so the scene has no variants; allowed is a scene with "
            "such joints, or several scenes"
        )
    balls = [
        name for name in names if scene.joints.spherical.issuperset(scene.joints.members(name))
    ]
    joints = {kind: dict.fromkeys(names, kind) for kind in ("ideal", "dry", "lubricated")}
    joints["lubricated"] |= dict.fromkeys(balls, "dry")
    kinds: dict[str, Scene] = {"": scene}
    if scene.bodies:
        kinds = {"rigid ": scene.replace(bodies={}), "flexible ": scene}
    found = {}
    for bodies, base in kinds.items():
        for label, change in joints.items():
            by_joint = {f"joints.{name}": kind for name, kind in change.items()}
            found[bodies + label] = base.replace(by_joint)
    return found
