"""The blanking pulse."""

__all__ = ["blanking_force"]


def blanking_force(time: float, peak: float, rise: float, fall: float) -> float:
    """Return the triangular blanking force, N, at a time after the pulse began (Eq. 36).

    The paper prints F_max / t^2 for the rise; F_max / (2 tau) is the triangle it draws.

    Args:
        time: s; the force is zero before 0 and after rise + fall.
        peak: F_max, N.
        rise: 2 tau, s.
        fall: tau, s.

    >>> blanking_force(0.5e-3, 10e3, rise=1e-3, fall=0.5e-3)
    5000.0
    """
    if time <= 0.0 or time >= rise + fall:
        return 0.0
    return peak * (time / rise if time < rise else (rise + fall - time) / fall)
