"""Integration: Exudyn's generalized-alpha with progress, early stops and statistics."""

from exu_press.integrate.outcome import Outcome, Status
from exu_press.integrate.progress import Progress
from exu_press.integrate.run import integrate

__all__ = ["Outcome", "Progress", "Status", "integrate"]
