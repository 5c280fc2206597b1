"""The variants of one scene."""

from exu_press.scene import Scene

__all__ = ["variants"]


def variants(scene: Scene) -> dict[str, Scene]:
    """Return the scene with ideal joints, dry joints and a lubricated crank pin, by label.

    As in the paper, the balls are dry beside a dry or a lubricated pin. Clearances, loads and
    whatever else a variant uses are the scene's.
    """
    full = scene.replace(crank_pin="lubricated", **_balls(scene, "dry"))
    pins = {"ideal": "ideal", "dry": "dry", "lubricated": "dry"}
    return {pin: full.replace(crank_pin=pin, **_balls(scene, balls)) for pin, balls in pins.items()}


def _balls(scene: Scene, kind: str) -> dict[str, str]:
    return {"balls": kind} if scene.mechanism == "press" else {}
