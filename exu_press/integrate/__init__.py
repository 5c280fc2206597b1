"""Integration: Exudyn's generalized-alpha with steps by tolerance, for any Exudyn system."""

from exu_press.integrate.problem import Scales
from exu_press.integrate.scheme import follow_modes
from exu_press.integrate.settings import Tuning
from exu_press.integrate.solve import Advice, Outcome, Status, solve_dynamic

__all__ = ["Advice", "Outcome", "Scales", "Status", "Tuning", "follow_modes", "solve_dynamic"]
