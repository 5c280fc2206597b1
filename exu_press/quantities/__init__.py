"""Quantities of interest: from channels to the numbers that people compare."""

from exu_press.quantities.acceleration import differentiated_peak, mean_peak, mean_peak_of, peak
from exu_press.quantities.catalogue import (
    CATALOGUE,
    QuantityAt,
    add,
    own_modules,
    quantities_of,
    quantity_of,
)
from exu_press.quantities.dead_centre import (
    DeadCentre,
    bottom_dead_centres,
    ideal_angles,
    lowest_of_strokes,
)
from exu_press.quantities.quantity import Extreme, Owner, Quantity
from exu_press.quantities.reading import Reading
from exu_press.quantities.summary import summary
from exu_press.quantities.value import Value, value_of, values_of

__all__ = [
    "CATALOGUE",
    "DeadCentre",
    "Extreme",
    "Owner",
    "Quantity",
    "QuantityAt",
    "Reading",
    "Value",
    "add",
    "bottom_dead_centres",
    "differentiated_peak",
    "ideal_angles",
    "lowest_of_strokes",
    "mean_peak",
    "mean_peak_of",
    "own_modules",
    "peak",
    "quantities_of",
    "quantity_of",
    "summary",
    "value_of",
    "values_of",
]
