"""Every joint of a run in one table."""

from exu_press.plots.words import joint_in_words
from exu_press.quantities.catalogue import CATALOGUE
from exu_press.quantities.kind import LOAD
from exu_press.quantities.quantity import Place
from exu_press.quantities.table import MOST_PLACES, shown_value
from exu_press.quantities.value import values_of
from exu_press.report.html import table
from exu_press.result import Result

__all__ = ["joint_table"]


def joint_table(result: Result) -> str:
    """Return a table of all joints, those with the largest forces first; nothing where few are."""
    if len(result.clearance_joints) <= MOST_PLACES:
        return ""
    values, joints = values_of(result), result.scene.joints
    shown = [q for q in CATALOGUE if q.place is Place.JOINT and q.title]
    forces = next(q for q in shown if q.kind is LOAD)
    found = [name for name in joints if values[forces.at(name)].value is not None]
    rows = []
    for name in sorted(found, key=lambda name: -(values[forces.at(name)].value or 0.0)):
        joint = joints[name]
        clearance = f"{joint.clearance * 1e6:g}" if joint.clearance else "-"
        texts = [
            shown_value(quantity, values[quantity.at(name)]) if quantity.at(name) in values else "-"
            for quantity in shown
        ]
        rows.append([joint_in_words(name), joint.kind, clearance, *texts])
    return table(("joint", "kind", "clearance, um", *(q.head for q in shown)), rows, "All joints")
