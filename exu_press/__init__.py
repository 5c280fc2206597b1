"""exu_press: press mechanisms with clearance, contact and lubrication in their joints.

What is imported here costs nothing until it is used: names are loaded on first access.
"""

import importlib

from exu_press.above import WORKERS

TYPE_CHECKING = False  # that of typing takes longer to load than all of this

if TYPE_CHECKING:
    from typing import Any

    from exu_press.errors import InputError
    from exu_press.integrate import (
        ErrorScales,
        Outcome,
        SolverStatus,
        SolverTuning,
        follow_modes,
        solve_dynamic,
    )
    from exu_press.joints import (
        FlexiblePoint,
        add_dry_revolute,
        add_dry_spherical,
        add_guideway_contact,
        add_guideway_film,
        add_joint_sensor,
        add_lubricated_revolute,
        add_lubricated_spherical,
        add_revolute,
    )
    from exu_press.mechanism import Mechanism
    from exu_press.report.cells import Comparison
    from exu_press.result import Result
    from exu_press.scene import Scene
    from exu_press.simulation import simulate

    __version__: str

__all__ = [
    "Comparison",
    "ErrorScales",
    "FlexiblePoint",
    "InputError",
    "Mechanism",
    "Outcome",
    "Result",
    "Scene",
    "SolverStatus",
    "SolverTuning",
    "__version__",
    "add_dry_revolute",
    "add_dry_spherical",
    "add_guideway_contact",
    "add_guideway_film",
    "add_joint_sensor",
    "add_lubricated_revolute",
    "add_lubricated_spherical",
    "add_revolute",
    "follow_modes",
    "simulate",
    "solve_dynamic",
]

_HOMES = {
    "Comparison": "exu_press.report.cells",
    "FlexiblePoint": "exu_press.joints",
    "InputError": "exu_press.errors",
    "Mechanism": "exu_press.mechanism",
    "Outcome": "exu_press.integrate",
    "Result": "exu_press.result",
    "ErrorScales": "exu_press.integrate",
    "Scene": "exu_press.scene",
    "SolverStatus": "exu_press.integrate",
    "SolverTuning": "exu_press.integrate",
    "add_dry_revolute": "exu_press.joints",
    "add_dry_spherical": "exu_press.joints",
    "add_joint_sensor": "exu_press.joints",
    "add_lubricated_revolute": "exu_press.joints",
    "add_lubricated_spherical": "exu_press.joints",
    "add_revolute": "exu_press.joints",
    "add_guideway_contact": "exu_press.joints",
    "add_guideway_film": "exu_press.joints",
    "follow_modes": "exu_press.integrate",
    "simulate": "exu_press.simulation",
    "solve_dynamic": "exu_press.integrate",
}

_ROOMS = ("laws", "quantities")
"""Packages that are used by their own names: `exu_press.quantities`."""

WORKERS.update(
    build=lambda scene: importlib.import_module("exu_press.model.graphics").build_with_graphics(
        scene
    ),
    quantity=lambda result: importlib.import_module("exu_press.quantities").value_of(*result),
    cell=lambda thing: importlib.import_module("exu_press.report.cells").cell(thing),
    page=lambda result: importlib.import_module("exu_press.report.cells").page_of(result),
    summary=lambda result: importlib.import_module("exu_press.quantities").summary(result),
)


def __getattr__(name: str) -> "Any":
    """Load a public name from its home; the version is that of the installed package."""
    if name == "__version__":
        from importlib.metadata import version

        return version("exu-press")
    if name in _ROOMS:
        return importlib.import_module(f"exu_press.{name}")
    if name not in _HOMES:
        raise AttributeError(f"module 'exu_press' has no attribute {name!r}")
    value = getattr(importlib.import_module(_HOMES[name]), name)
    globals()[name] = value
    return value
