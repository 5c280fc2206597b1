"""Integration: Exudyn's generalized-alpha with steps by tolerance, for any Exudyn system."""

from exu_press.integrate.modal_mass import follow_modes
from exu_press.integrate.scales import ErrorScales
from exu_press.integrate.settings import SolverTuning
from exu_press.integrate.solve import ARRIVED, Advice, Outcome, SolverStatus, solve_dynamic

__all__ = [
    "ARRIVED",
    "Advice",
    "ErrorScales",
    "Outcome",
    "SolverStatus",
    "SolverTuning",
    "follow_modes",
    "solve_dynamic",
]
