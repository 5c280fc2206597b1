"""exu_press: press mechanisms with clearance, contact and lubrication in their joints.

Importing it costs nothing: a name is loaded on first access.
"""

import importlib

from fe_models.lazy import lazy_names

TYPE_CHECKING = False  # that of typing takes longer to load than all of this

if TYPE_CHECKING:
    from typing import Any

    from exu_press.errors import InputError
    from exu_press.exudyn_systems import solve_dynamic
    from exu_press.integrate import ErrorScales, Outcome, SolverStatus, SolverTuning, follow_modes
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

    # behind methods of `Scene`, `Result` and `Mechanism`, in modules that know these classes
    from exu_press.model.graphics import build_with_graphics as build_with_graphics
    from exu_press.quantities.summary import summary as summary
    from exu_press.quantities.value import value_of as value_of
    from exu_press.report.cells import cell as cell
    from exu_press.report.cells import page_of as page_of
    from exu_press.result import Result
    from exu_press.scene import Scene
    from exu_press.studies.bearing.coefficients import bearing_coefficients
    from exu_press.studies.comparison import compare_results as compare_results
    from exu_press.verification.simulate import simulate

    __version__: str

__all__ = [
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
    "bearing_coefficients",
    "follow_modes",
    "simulate",
    "solve_dynamic",
]

_load = lazy_names(__name__)

_SUBPACKAGES = ("laws", "quantities")
"""Subpackages of the public API, as `exu_press.quantities`."""


def __dir__() -> list[str]:
    """Return the public names."""
    return [*__all__, *_SUBPACKAGES]


def __getattr__(name: str) -> "Any":
    """Load a public name from its module; the version is that of the installed package."""
    if name == "__version__":
        from importlib.metadata import version

        return version("exu-press")
    if name in _SUBPACKAGES:
        return importlib.import_module(f"exu_press.{name}")
    return _load(name)
