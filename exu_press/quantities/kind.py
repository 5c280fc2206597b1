"""Kinds of quantities: from this follows how exactly a run can tell one."""

from dataclasses import dataclass

__all__ = [
    "COST",
    "COUNT",
    "DIFFERENCE",
    "ENERGY",
    "FLOW",
    "LOAD",
    "MEASURE",
    "MOMENT",
    "MOTION",
    "RESULTANT",
    "ROUNDING",
    "SHARE",
    "Kind",
]

ROUNDING = 1e-9
"""Least relative error of a quantity: no two runs agree better."""


@dataclass(frozen=True)
class Kind:
    """The least error of a quantity, however well runs agree.

    Attributes:
        name: in one word.
        has_error: whether runs at other tolerances tell its error.
        relative: least error over the value.
        absolute: least error, in the quantity's unit.
        of_largest: least error over the run's largest value of the quantity's unit; extremes are
            compared with extremes, as impacts make them large.
        of_forces: least error over the run's largest force times the mechanism's size.
        from_accelerations: whether the first step leaves an error of its own in it.
        may_vanish: whether nothing, within an error, is an answer. Where it is none, as for a peak,
            a figure that is smaller than its error is not determined.
    """

    name: str
    has_error: bool = True
    relative: float = ROUNDING
    absolute: float = 0.0
    of_largest: float = 0.0
    of_forces: float = 0.0
    from_accelerations: bool = False
    may_vanish: bool = False


MOTION = Kind("motion")
"""Follows from positions and velocities."""

DIFFERENCE = Kind("difference", may_vanish=True)
"""Is the distance between positions or speeds that may be the same."""

LOAD = Kind("load", relative=1e-5, from_accelerations=True)
"""Follows from accelerations, as forces, torques and powers do."""

RESULTANT = Kind("resultant", relative=1e-5, of_largest=1e-6, from_accelerations=True)
"""Is a sum in which large forces cancel, or the power of one. Newton's method and the rounding of
positions leave of_largest of them (5e-7 was measured at 1 rpm)."""

MOMENT = Kind("moment", relative=0.0, of_forces=1e-7)
"""Is a moment of forces that balance each other; their arms are rounded, by of_forces
of the mechanism's size."""

ENERGY = Kind("energy", relative=0.0, of_largest=1e-6)
"""Is stored or dissipated: a difference of larger amounts."""

FLOW = Kind("work")
"""Is work that drive or loads put in."""

SHARE = Kind("share", relative=0.0, absolute=1e-4)
"""Is a share of time: touches are told apart by steps, which in free flight are the longest ones
allowed in all runs."""

COUNT = Kind("count")
"""Is a whole number."""

MEASURE = Kind("measure of error", has_error=False)
"""Says itself how good a run is."""

COST = Kind("cost", has_error=False)
"""Is a cost of the run."""
