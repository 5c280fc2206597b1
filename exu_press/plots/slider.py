"""The slider's motion over crank angle, against the ideal mechanism."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from exu_press.mechanism import mechanism_of
from exu_press.plots.canvas import angle_range, crank_degrees, curve, new_figure
from exu_press.plots.scales import crank_angle_axis, impact_scale, widen
from exu_press.plots.style import COLOURS, IDEAL, colour_of, styled
from exu_press.result import Result

__all__ = ["slider_figure"]

Array = NDArray[np.float64]

WINDOW = 1e-3
"""Over which the acceleration is averaged, s: about what a measurement resolves (spec 7)."""

MOST_OF_IDEAL = 8.0
"""The averaged acceleration's panel ends at this multiple of the ideal peak, and says so."""


@styled
def slider_figure(results: Mapping[str, Result]) -> Figure:
    """Return position, velocity and acceleration of one slider or several, by label.

    On the left the motion (mm, m/s, m/s^2) with the ideal mechanism's in closed form; on the right
    its deviation from the ideal (um, mm/s) and the acceleration as resolved, impacts and all.
    """
    figure = new_figure("Slider motion against the ideal mechanism", results, (13.0, 8.6))
    panels = figure.subplots(3, 2, sharex=True)
    single = len(results) == 1
    ideals = {label: _ideal(result) for label, result in results.items()}
    alike = len({_ideal_key(result) for result in results.values()}) == 1
    for index, (label, result) in enumerate(results.items()):
        colour, (position, velocity, _) = colour_of(index), ideals[label]
        wide, thin = {"color": colour, "linewidth": 1.8}, {"color": colour, "linewidth": 0.8}
        simulated = result["slider_position"], result["slider_velocity"]
        resolved = result["slider_acceleration"]
        averaged = _mean_acceleration(result.time, result["slider_velocity"])
        curve(panels[0, 0], result, 1e3 * simulated[0], **wide, label=label)
        curve(panels[1, 0], result, simulated[1], **wide)
        curve(panels[0, 1], result, 1e6 * (simulated[0] - position), **thin)
        curve(panels[1, 1], result, 1e3 * (simulated[1] - velocity), **thin)
        if single:
            curve(panels[2, 0], result, resolved, **(thin | {"color": COLOURS["sky blue"]}),
                  alpha=0.55)
        curve(panels[2, 0], result, averaged, **(thin | {"linewidth": 1.3}))
        curve(panels[2, 1], result, resolved, **thin, alpha=1.0 if single else 0.75)
    for index, (label, result) in enumerate(results.items()):
        if not alike or index == 0:
            dashes = {
                "color": IDEAL if alike else colour_of(index),
                "linewidth": 1.0,
                "linestyle": (0, (4, 2)),
                "zorder": 3,
            }
            name = "ideal mechanism" if alike else f"{label}, ideal"
            angle = crank_degrees(result)
            for row, scale in enumerate((1e3, 1.0, 1.0)):
                panels[row, 0].plot(angle, scale * ideals[label][row], **dashes,
                                    label=name if row == 0 else None)
            panels[2, 1].plot(angle, ideals[label][2], **dashes)
    _name(panels)
    _scale_accelerations(panels[2, 0], panels[2, 1], results, ideals, single=single)
    for axes in panels[:2, 1]:
        widen(axes, 1.0)
    crank_angle_axis(panels.flat, *angle_range(results))
    return figure
