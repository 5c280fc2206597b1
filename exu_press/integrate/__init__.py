"""Integration: Exudyn's generalized-alpha with steps by tolerance, as clearance joints need it."""

from typing import TYPE_CHECKING

from fe_models.lazy import lazy_names

if TYPE_CHECKING:
    from exu_press.integrate.error import Criterion
    from exu_press.integrate.modal_mass import follow_modes
    from exu_press.integrate.outcome import Outcome, RunError, SolverStatus
    from exu_press.integrate.scales import ErrorScales
    from exu_press.integrate.solve import solve_dynamic
    from exu_press.integrate.task import SolverTuning
    from exu_press.integrate.termination import ARRIVED, Advice

__all__ = [
    "ARRIVED",
    "Advice",
    "Criterion",
    "ErrorScales",
    "Outcome",
    "RunError",
    "SolverStatus",
    "SolverTuning",
    "follow_modes",
    "solve_dynamic",
]

__getattr__ = lazy_names(__name__)
