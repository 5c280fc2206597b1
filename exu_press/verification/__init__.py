"""Solution verification: the errors of a run's figures, and chaotic motion."""

from exu_press.verification.growth import Growth, growth
from exu_press.verification.run import simulate_with_errors, with_errors
from exu_press.verification.within import deliver

__all__ = ["Growth", "deliver", "growth", "simulate_with_errors", "with_errors"]
