"""Pictures of results, drawn without a display; the only package that imports matplotlib."""

from exu_press.plots.energy import energy_figure
from exu_press.plots.force import force_figure
from exu_press.plots.orbit import orbit_figure
from exu_press.plots.press import press_figure
from exu_press.plots.save import save_comparison, save_pictures
from exu_press.plots.slider import slider_figure

__all__ = [
    "energy_figure",
    "force_figure",
    "orbit_figure",
    "press_figure",
    "save_comparison",
    "save_pictures",
    "slider_figure",
]
