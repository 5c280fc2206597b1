"""Parameters of the contact and friction laws, checked once, in the factory that takes them."""

from math import inf

from exu_press.errors import InputError

__all__ = ["demand", "not_negative", "positive"]


def demand(ok: bool, name: str, value: float, allowed: str, source: str = "") -> None:
    """Refuse `name` unless `ok`: InputError, a ValueError, says what is allowed and who says so.

    >>> demand(False, "restitution", 0.0, "0 < restitution <= 1", "Flores 2011")
    Traceback (most recent call last):
    exu_press.errors.InputError: restitution = 0.0: allowed 0 < restitution <= 1 (Flores 2011)
    """
    if not ok:
        raise InputError(f"{name} = {value!r}: allowed {allowed}" + (f" ({source})" * bool(source)))


def positive(**parameters: float) -> None:
    """Refuse every parameter that is not finite and > 0; NaN is refused too."""
    for name, value in parameters.items():
        demand(0.0 < value < inf, name, value, f"0 < {name} < inf")


def not_negative(**parameters: float) -> None:
    """Refuse every parameter that is not finite and >= 0; NaN is refused too."""
    for name, value in parameters.items():
        demand(0.0 <= value < inf, name, value, f"0 <= {name} < inf")
