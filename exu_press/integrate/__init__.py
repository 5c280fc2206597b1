"""Integration: Exudyn's generalized-alpha with steps by tolerance, as clearance joints need it."""

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
