"""Pictures, drawn without a display; the only package that imports matplotlib.

Names are loaded on first access: the picture of a mechanism needs no result, and so no Exudyn.
"""

from typing import TYPE_CHECKING

from fe_models.lazy import lazy_names

if TYPE_CHECKING:
    from exu_press.plots.drawing import drawing_figure
    from exu_press.plots.energy import energy_figure
    from exu_press.plots.force import force_figure
    from exu_press.plots.orbit import orbit_figure
    from exu_press.plots.press import press_figure
    from exu_press.plots.save import save_comparison, save_pictures
    from exu_press.plots.slider import slider_figure

__all__ = [
    "drawing_figure",
    "energy_figure",
    "force_figure",
    "orbit_figure",
    "press_figure",
    "save_comparison",
    "save_pictures",
    "slider_figure",
]

__getattr__ = lazy_names(__name__)
