"""The flywheel of a motor: it turns with the crank."""

from dataclasses import replace

from exu_press.mechanism import Mechanism

__all__ = ["with_flywheel"]


def with_flywheel(drawn: Mechanism, inertia: float) -> Mechanism:
    """Return a mechanism whose crank has a flywheel's inertia, kg m^2, beside its own."""
    bodies = tuple(
        replace(body, inertia=body.inertia + inertia) if body.name == drawn.crank else body
        for body in drawn.bodies
    )
    return replace(drawn, bodies=bodies)
