"""How far a run's figures can be believed: the errors of its steps, and where motion is chaotic."""

from exu_press.verification.growth import Growth, growth
from exu_press.verification.run import simulate_with_errors, with_errors
from exu_press.verification.within import deliver

__all__ = ["Growth", "deliver", "growth", "simulate_with_errors", "with_errors"]
