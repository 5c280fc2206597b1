"""Words, units and settings of pictures."""

import subprocess
import sys

import matplotlib
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from exu_press.plots import force_figure
from exu_press.plots.style import look
from exu_press.plots.typesetting import plain, typeset


@pytest.mark.parametrize("text", [r"$\frac{$", "5 $", r"a\$b$c$", "$$"])
def test_no_text_is_a_formula(text):
    """Matplotlib draws it, and draws the same as with formulas switched off."""

    def drawn(shown, **options):
        figure = Figure()
        figure.text(0.1, 0.5, shown, **options)
        FigureCanvasAgg(figure).draw()
        return np.asarray(figure.canvas.buffer_rgba())

    assert np.array_equal(drawn(plain(text)), drawn(text, parse_math=False))


@pytest.mark.parametrize(
    ("ascii_text", "printed"),
    [
        ("m/s^2", "m/s²"),
        ("N/m^1.5", "N/m^1.5"),
        ("film 93.7 um, tilt 0.2 urad.", "film 93.7 µm, tilt 0.2 µrad."),
        ("12.3 +- 0.4", "12.3 ± 0.4"),
        ("um.toml and out/um/run.nc", "um.toml and out/um/run.nc"),
        ("aluminium, museum, maximum", "aluminium, museum, maximum"),
    ],
)
def test_units_are_printed_and_names_stay(ascii_text, printed):
    assert typeset(ascii_text) == printed


def test_no_global_state_changes(results):
    matplotlib.rcParams["font.size"] = 7.0
    before = dict(matplotlib.rcParams)
    force_figure({"run": results["dry"]})
    assert dict(matplotlib.rcParams) == before
    matplotlib.rcdefaults()
    with matplotlib.rc_context({"lines.marker": "o"}), look():
        assert matplotlib.rcParams["lines.marker"] == "None", "the user's does not reach ours"


def test_pictures_never_import_pyplot():
    code = "import sys, exu_press.plots; assert 'matplotlib.pyplot' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
