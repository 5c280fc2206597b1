"""Integration: Exudyn's generalized-alpha with steps by tolerance, early stops, statistics."""

from exu_press.integrate.outcome import Outcome, Status
from exu_press.integrate.run import integrate

__all__ = ["Outcome", "Status", "integrate"]
