"""The loads of a scene on their mechanism, none of which is loaded where there are none."""

from typing import TYPE_CHECKING

from exu_press.scene.scene import Scene

if TYPE_CHECKING:
    from exu_press.scene.applied_load import AppliedLoad

__all__ = ["applied_loads"]


def applied_loads(scene: Scene) -> dict[str, "AppliedLoad"]:
    """Return the loads of a scene that are not zero throughout, by name."""
    if not scene.load:
        return {}
    from exu_press.scene.applied_load import applied_load

    loads = {name: applied_load(load, scene) for name, load in scene.load.items()}
    # the peak of a load of a result may be unknown
    return {name: load for name, load in loads.items() if not load.curve.peak <= 0.0}
