import subprocess
import sys

import matplotlib

from exu_press.plots import force_figure
from exu_press.plots.style import look


def test_no_global_state_changes(results):
    matplotlib.rcParams["font.size"] = 7.0
    before = dict(matplotlib.rcParams)
    force_figure({"run": results["dry"]})
    assert dict(matplotlib.rcParams) == before
    matplotlib.rcdefaults()


def test_the_users_settings_do_not_reach_our_pictures():
    with matplotlib.rc_context({"lines.marker": "o"}), look():
        assert matplotlib.rcParams["lines.marker"] == "None"


def test_pictures_never_import_pyplot():
    code = "import sys, exu_press.plots; assert 'matplotlib.pyplot' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
