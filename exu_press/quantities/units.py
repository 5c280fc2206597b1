"""Units and meanings of a table's columns."""

from collections.abc import Iterable, Mapping
from typing import Any

from exu_press.mechanism import unit_in_mechanism
from exu_press.quantities.catalogue import find_quantity
from exu_press.scene import DryJoint, Flexible, Scene
from exu_press.scene.load import LOAD_KINDS
from exu_press.scene.oil import Oil
from exu_press.scene.usage import TABLES, table_keys
from exu_press.schema.table import declared_keys

__all__ = ["meaning_of", "shown_unit", "unit_of", "with_unit"]


def unit_of(name: str) -> str:
    """Return the SI unit of a scene's key or of a quantity, or nothing.

    >>> unit_of("joints.balls.clearance"), unit_of("joints.ball_left.peak_force"), unit_of("status")
    ('m', 'N', '')
    """
    if (placed := find_quantity(name)) is not None:
        return placed.quantity.unit
    metadata = _metadata(name)
    return "" if metadata is None else str(metadata["unit"])


def shown_unit(
    name: str, values: Iterable[float] = (), default: str | None = None
) -> tuple[str, float]:
    """Return the unit in which tables show a scene's key or a quantity, and the factor from SI.

    >>> shown_unit("joints.balls.clearance"), shown_unit("joints.balls.peak_penetration")
    (('m', 1.0), ('um', 1000000.0))

    Args:
        name: of the key or the quantity.
        values: SI, which are small in a small machine.
        default: unit of a name that is no quantity, where it is no key either.
    """
    if (placed := find_quantity(name)) is None:
        return unit_of(name) if default is None else default, 1.0
    quantity = placed.quantity.in_scaled_unit(values)
    return quantity.display_unit, quantity.scale


def with_unit(name: str, unit: str | None = None) -> str:
    """Return a name with its unit, SI unless told, as the head of a column.

    >>> with_unit("peak_velocity"), with_unit("speed_rpm"), with_unit("status")
    ('peak_velocity, m/s', 'speed_rpm', 'status')
    """
    unit = unit_of(name) if unit is None else unit
    return f"{name}, {unit}" if unit and not name.endswith(f"_{unit}") else name


def meaning_of(name: str) -> str:
    """Return the meaning of a scene's key or of a quantity, or nothing.

    >>> meaning_of("start_angle_deg")
    'crank angle at the start'
    """
    if (placed := find_quantity(name)) is not None:
        return placed.quantity.meaning
    metadata = _metadata(name)
    return "" if metadata is None else str(metadata["meaning"])


def _metadata(name: str) -> Mapping[str, Any] | None:
    """Return the declaration of a scene's key."""
    path = name.removeprefix("scene.")
    if path.startswith("mechanism."):
        return {"unit": unit_in_mechanism(path), "meaning": ""}
    table, _, inner = path.rpartition(".")
    law = table.rpartition(".")[2] if table.startswith("joints.") else table
    law = "guide" if table.startswith("guide.") else law
    if table == "film.oil" or table.endswith(".film.oil"):
        fields = declared_keys(Oil)
    elif law in TABLES:  # also joints.NAME.law.key
        fields = table_keys(law)
    elif table.startswith("joints."):
        fields = declared_keys(DryJoint)
    elif table.startswith("load."):
        kinds = reversed([*LOAD_KINDS.values()])  # of the first that has the key
        fields = {name: f for kind in kinds for name, f in declared_keys(kind).items()}
    elif table.startswith("bodies."):
        fields = declared_keys(Flexible)
    elif table:
        return None
    else:
        fields = declared_keys(Scene)
    field = fields.get(inner)
    return field.metadata if field is not None and "meaning" in field.metadata else None
