"""The variants of one scene."""

from exu_press.scene import Scene

__all__ = ["variants"]

PINS = {"ideal": "ideal", "dry": "dry", "lubricated": "dry"}
"""Crank pin -> balls beside it: as in the paper, dry beside a dry or a lubricated pin."""


def variants(scene: Scene) -> dict[str, Scene]:
    """Return the scene with ideal joints, dry joints and a lubricated crank pin, by label.

    A scene with flexible bodies is compared with rigid ones too. Clearances, loads and whatever
    else a variant uses are the scene's.
    """
    kinds = ["rigid"] if scene.bodies == "rigid" else ["rigid", "flexible"]
    press = scene.mechanism == "press"
    found = {}
    for bodies in kinds:
        full = {"bodies": bodies, "crank_pin": "lubricated"} | ({"balls": "dry"} if press else {})
        for pin, balls in PINS.items():
            change = {"crank_pin": pin} | ({"balls": balls} if press else {})
            label = f"{bodies} {pin}" if len(kinds) > 1 else pin
            found[label] = scene.replace(full).replace(change)
    return found
