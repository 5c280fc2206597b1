"""One measure of one run, and the published number it is held against."""

from collections.abc import Mapping
from typing import Any

from paper.published import Number

__all__ = ["DATUM", "observed", "published_value", "shown"]

DATUM = 0.47
"""The paper's ideal bottom dead centre (its "low dead point"), m. Positions are judged by how far
they lie below it: beside an arbitrary datum of half a metre anything would agree."""


def observed(
    row: Mapping[str, Any], measure: str, model: str, *, whole: bool = False
) -> float | None:
    """Return a measure of a run as it is judged: of a bottom dead centre, m below the datum.

    Args:
        row: of the run, from `tasks.observe`.
        measure: a key of its readings, or permanent_contact_ball or _pin.
        model: of observation, where the measure has them.
        whole: observed from the start on, and not in the last revolution alone.

    Returns:
        None where the run did not get to its end, or has no such measure.
    """
    value = shown(row, measure, model, whole=whole)
    return DATUM - value if measure == "bottom_dead_centre" and value is not None else value


def shown(row: Mapping[str, Any], measure: str, model: str, *, whole: bool = False) -> float | None:
    """Return a measure of a run as it is shown beside the paper's: a bottom dead centre in m."""
    readings = row.get("whole" if whole else "readings")
    if not readings:
        return None
    if measure.startswith("permanent_contact_"):
        joint = "crank_pin" if measure.endswith("pin") else "ball_left"
        found = readings["joints"].get(joint)
        return None if found is None else float(found["permanent"])
    value = readings[measure]
    value = value[model] if isinstance(value, dict) else value
    return None if value is None else float(value)


def published_value(number: Number) -> float:
    """Return the published number as it is judged."""
    if number.measure == "bottom_dead_centre":
        return round(DATUM - number.published, 6)
    return number.published
