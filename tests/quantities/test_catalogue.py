"""The catalogue: every quantity is declared once, and everything else asks it."""

import dataclasses
import importlib
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from matplotlib.text import Text
from scipy.io import netcdf_file

import exu_press
from exu_press import InputError, Scene, simulate
from exu_press.quantities import CATALOGUE, add, quantities_of, values_of
from exu_press.quantities.catalogue import QuantityAt, find_quantity
from exu_press.quantities.remarks import run_lines
from exu_press.quantities.units import meaning_of, unit_of
from exu_press.report.run_report import run_report
from exu_press.studies.sweep import Sweep, sweep
from exu_press.studies.sweep.figure import axes_of, sweep_figure
from exu_press.verification.run import with_errors

ROOT = Path(exu_press.__file__).parent
CRANK = Scene(mechanism="slider_crank", joints={}, revolutions=0.1)


@pytest.mark.parametrize(
    "scene",
    [
        Scene(joints={"crank_pin": "dry"}, guide={"clearance": 1e-4}, revolutions=0.02),
        Scene(
            mechanism="slider_crank",
            joints={},
            revolutions=0.1,
            load={"press": {"kind": "blanking", "force": 1e3}},
        ),
    ],
)
def test_what_a_scene_will_have_is_what_its_run_has(scene):
    result = simulate(scene)
    assert set(values_of(result)) == set(quantities_of(scene))
    for name, placed in quantities_of(scene).items():
        assert find_quantity(name) == placed


MINE = """
from exu_press.quantities import Quantity, add
from exu_press.quantities.kind import MOTION

MINE = add(
    Quantity(
        "lowest_velocity",
        "m/s",
        "least velocity of the slider, of a test",
        MOTION,
        lambda run, _: float(run["slider_velocity"].min()),
        title="lowest velocity",
        signed=True,
    )
)
"""


@pytest.fixture
def mine(tmp_path, monkeypatch):
    """A quantity that a module of the user's own adds."""
    (tmp_path / "my_quantities.py").write_text(MINE)
    monkeypatch.syspath_prepend(str(tmp_path))
    added = importlib.import_module("my_quantities").MINE
    yield added
    CATALOGUE.remove(added)
    del sys.modules["my_quantities"]


def test_a_quantity_of_ones_own_is_everywhere(mine, tmp_path, monkeypatch):
    """In one file; in summary, errors, terminal, report, sweep with its workers, and reference."""
    with pytest.raises(InputError, match="is declared already"):
        add(mine)
    result = with_errors(simulate(CRANK), beside=False)
    told = result.quantity("lowest_velocity")
    assert told.value == result["slider_velocity"].min() and told.error is not None
    assert result.summary()["quantities"]["lowest_velocity"] == told.to_dict()
    assert any(line.startswith("  lowest velocity, m/s") for line in run_lines(result))
    monkeypatch.setattr("exu_press.report.pictures.save_pictures", lambda *_: [])
    assert "lowest velocity" in run_report(result, "run.nc")
    assert unit_of("lowest_velocity") == "m/s" and meaning_of("lowest_velocity")

    table = sweep(Sweep(scene=CRANK, keys={"speed_rpm": [100.0, 200.0]}), tmp_path, workers=1)
    assert table["lowest_velocity"][1] == pytest.approx(2.0 * table["lowest_velocity"][0], rel=1e-2)
    selected = replace(table, selected=["lowest_velocity"])
    assert "lowest_velocity, m/s" in selected.lines()[0]
    figure = sweep_figure(table, axes_of(table), ["lowest_velocity"])
    assert any("lowest velocity" in text.get_text().lower() for text in figure.findobj(Text))
    with netcdf_file(tmp_path / "table.nc", mmap=False) as file:
        assert file.variables["lowest_velocity"].units == b"m/s"

    monkeypatch.syspath_prepend(str(ROOT.parent / "docs"))
    directives = pytest.importorskip("sphinx_parts.directives")
    (reference,) = directives.Quantities.run(None)
    assert mine.meaning in reference.astext()


def test_one_that_workers_cannot_declare_is_refused(mine, tmp_path):
    CATALOGUE.remove(mine)
    try:
        add(mine)
        with pytest.raises(
            InputError, match="lowest_velocity: is added in the script itself or in"
        ):
            sweep(Sweep(scene=CRANK, keys={"speed_rpm": [100.0]}), tmp_path, workers=1)
    finally:
        assert mine in CATALOGUE


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"name": "my speed"}, "quantity 'my speed': 'my speed' is no name"),
        ({"name": "mine."}, "quantity 'mine.': '' is no name"),
        ({"name": "mine", "display_unit": "km/h"}, "display_unit = 'km/h'; allowed are nm/s"),
    ],
)
def test_a_quantity_of_ones_own_that_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        add(dataclasses.replace(find_quantity("peak_velocity").quantity, **change))


def test_a_quantity_that_gives_no_number_is_named():
    with pytest.raises(InputError, match="quantity stroke: gives 'a'; allowed is a number"):
        QuantityAt(dataclasses.replace(CATALOGUE[0], read=lambda run, at: "a")).read(None)
