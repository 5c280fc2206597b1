"""The variants of one scene."""

from exu_press.scene import Scene
from exu_press.scene.joint import DEFAULT_KINDS

__all__ = ["variants"]


def variants(scene: Scene) -> dict[str, Scene]:
    """Return the scene with ideal, with dry and with lubricated joints, by label.

    These are the scene's joints with clearance, or those that its mechanism usually has; balls are
    dry beside lubricated pins. A scene with flexible bodies is compared with rigid ones too.
    Clearances, loads and whatever else a variant uses are the scene's.
    """
    names = list(scene.joints.grouped) or list(DEFAULT_KINDS.get(scene.shipped, {}))
    balls = [
        name for name in names if scene.joints.spherical.issuperset(scene.joints.members(name))
    ]
    joints = {kind: dict.fromkeys(names, kind) for kind in ("ideal", "dry", "lubricated")}
    joints["lubricated"] |= dict.fromkeys(balls, "dry")
    kinds = ["rigid"] if scene.bodies == "rigid" else ["rigid", "flexible"]
    found = {}
    for bodies in kinds:
        for label, change in joints.items():
            full = label if len(kinds) == 1 else f"{bodies} {label}"
            by_joint = {f"joints.{name}": kind for name, kind in change.items()}
            found[full] = scene.replace({"bodies": bodies, **by_joint})
    return found
