"""How far a run's figures can be believed: the errors of its steps, and where motion is chaotic."""

from exu_press.confidence.growth import Growth, growth
from exu_press.confidence.run import simulate_with_errors, with_errors
from exu_press.confidence.within import deliver

__all__ = ["Growth", "deliver", "growth", "simulate_with_errors", "with_errors"]
