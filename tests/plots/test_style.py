import subprocess
import sys

import matplotlib
import pytest
from matplotlib.figure import Figure

from exu_press.plots import force_figure
from exu_press.plots.style import COLOURS, colour_of, look, with_style


def test_no_global_state_changes(results):
    matplotlib.rcParams["font.size"] = 7.0
    before = dict(matplotlib.rcParams)
    force_figure({"run": results["dry"]})
    assert dict(matplotlib.rcParams) == before
    matplotlib.rcdefaults()


def test_no_global_state_changes_when_drawing_fails():
    @with_style
    def failing() -> Figure:
        raise RuntimeError

    before = dict(matplotlib.rcParams)
    with pytest.raises(RuntimeError):
        failing()
    assert dict(matplotlib.rcParams) == before


def test_the_users_settings_do_not_reach_our_pictures():
    with matplotlib.rc_context({"lines.marker": "o"}), look():
        assert matplotlib.rcParams["lines.marker"] == "None"


def test_ticks_are_numbers_without_an_offset_in_the_titles_place():
    def dead_centres():
        figure = Figure()
        figure.subplots().plot([469.80698, 469.80744])
        return figure

    figure = with_style(dead_centres)()
    figure.draw_without_rendering()
    assert figure.axes[0].yaxis.get_offset_text().get_text() == ""


def test_colours_start_again():
    assert colour_of(len(COLOURS)) == colour_of(0)


def test_pictures_never_import_pyplot():
    code = "import sys, exu_press.plots; assert 'matplotlib.pyplot' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
