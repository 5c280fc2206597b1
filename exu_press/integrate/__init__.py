"""Integration: Exudyn's generalized-alpha with steps by tolerance, for any Exudyn system."""

from exu_press.integrate.ending import ARRIVED, Advice
from exu_press.integrate.modal_mass import follow_modes
from exu_press.integrate.outcome import Outcome, RunError, SolverStatus
from exu_press.integrate.scales import ErrorScales
from exu_press.integrate.settings import SolverTuning
from exu_press.integrate.solve import solve_dynamic

__all__ = [
    "ARRIVED",
    "Advice",
    "ErrorScales",
    "Outcome",
    "RunError",
    "SolverStatus",
    "SolverTuning",
    "follow_modes",
    "solve_dynamic",
]
