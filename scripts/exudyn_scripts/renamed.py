"""What scripts of Exudyn's repository call by a name that the installed Exudyn has no longer.

Some of the scripts were written years ago, and end at their first call of such a name.
"""

import builtins
import functools
import inspect

import exudyn as exu
import exudyn.basicUtilities
import exudyn.graphics
import exudyn.itemInterface
import exudyn.rigidBodyUtilities
import exudyn.utilities
import numpy as np

__all__ = ["put_back"]

EARLIER = "bodyList", "bodyOrNodeList"
"""Names of the argument `itemNumbers` of functions that create items."""


def names():
    """Return earlier names, and what they stand for."""
    graphics = exudyn.graphics
    found = {
        "NormL2": np.linalg.norm,
        "VSum": sum,
        "VAdd": lambda a, b: list(np.add(a, b)),
        "VSub": lambda a, b: list(np.subtract(a, b)),
        "VMult": np.dot,
        "ScalarMult": lambda factor, a: list(np.multiply(factor, a)),
        "Vec2Tilde": exudyn.rigidBodyUtilities.Skew,
        "HT": exudyn.rigidBodyUtilities.HomogeneousTransformation,
        "NodePoint3DSlope23": exudyn.itemInterface.NodePointSlope23,
        "GraphicsDataOrthoCubePoint": graphics.Brick,
        "GraphicsData2PointsAndTrigs": graphics.ToPointsAndTrigs,
    }
    for name, value in vars(graphics).items():
        if name[0].isupper():
            found[f"GraphicsData{name}"] = value
    return found


def takes_show(drawn):
    """Return whether the constructor of what is drawn takes whether it is shown."""
    return "show" in inspect.signature(drawn.__init__).parameters


def without_show(made):
    """Return the constructor of what is drawn, that takes no notice of whether it is shown."""

    @functools.wraps(made)
    def make(self, *args, show=True, **keys):
        made(self, *args, **keys)

    return make


def renamed(create):
    """Return a function that creates items, which takes earlier names of its arguments."""

    @functools.wraps(create)
    def made(*args, **keys):
        return create(*args, **{"itemNumbers" if k in EARLIER else k: v for k, v in keys.items()})

    return made


def put_back():
    """Let scripts find all of these, and let what creates and draws items accept them."""
    for name, value in names().items():
        if not hasattr(exudyn.utilities, name):
            setattr(builtins, name, value)
            for module in (exudyn.basicUtilities, exudyn.utilities):
                setattr(module, name, value)
    for name, drawn in vars(exudyn.itemInterface).items():
        if name.startswith("V") and inspect.isclass(drawn) and not takes_show(drawn):
            drawn.__init__ = without_show(drawn.__init__)
    for name in dir(exu.MainSystem):
        if name.startswith("Create"):
            setattr(exu.MainSystem, name, renamed(getattr(exu.MainSystem, name)))
