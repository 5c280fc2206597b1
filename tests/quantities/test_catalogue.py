"""The catalogue: every quantity is declared once, and everything else asks it."""

import re
from pathlib import Path

import pytest

import exu_press
from exu_press import InputError, Scene, simulate
from exu_press.quantities import CATALOGUE, Place, Quantity, add, quantities_of, values_of
from exu_press.quantities.catalogue import declared
from exu_press.quantities.kind import MOTION
from exu_press.quantities.table import run_lines
from exu_press.report.run import run_report
from exu_press.studies.sweep.units import meaning_of, unit_of
from exu_press.verification.run import with_errors

ROOT = Path(exu_press.__file__).parent
TEXT = re.compile(r"""["']([^"'\n]*)["']""")
CRANK = Scene(mechanism="slider_crank", joints={}, revolutions=0.1)


@pytest.mark.parametrize(
    "scene",
    [
        Scene(revolutions=0.02),
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
        assert declared(name) == placed


def test_names_are_unique_and_everything_is_said():
    names = [(quantity.place, quantity.name) for quantity in CATALOGUE]
    assert len(set(names)) == len(names)
    for quantity in CATALOGUE:
        assert quantity.meaning and quantity.scale > 0.0


def test_no_name_of_a_quantity_stands_anywhere_else_in_the_package():
    """But in examples of docstrings, and where a channel or a key of a scene has the same name."""
    names = {quantity.name for quantity in CATALOGUE if len(quantity.name) > 8}
    names -= {
        "viscosity",
        "film.viscosity",
        "dissipated",
        "slider_tilt",
        "slider_lateral",
        "bottom_dead_centre",
    }
    for path in ROOT.rglob("*.py"):
        if "quantities" in path.parts:
            continue
        lines = [x for x in path.read_text().splitlines() if not x.lstrip().startswith(">>>")]
        for text in TEXT.findall("\n".join(lines)):
            assert text.split(".", 2)[-1] not in names and text not in names, (path, text)


def test_a_quantity_of_ones_own_is_everywhere():
    mine = Quantity(
        "lowest_velocity",
        "m/s",
        "least velocity of the slider, of a test",
        MOTION,
        lambda run, _: float(run["slider_velocity"].min()),
        title="lowest velocity",
        signed=True,
    )
    add(mine)
    try:
        with pytest.raises(InputError, match="is declared already"):
            add(mine)
        result = with_errors(simulate(CRANK), beside=False)
        told = result.quantity("lowest_velocity")
        assert told.value == result["slider_velocity"].min() and told.error is not None
        assert result.summary()["quantities"]["lowest_velocity"] == told.to_dict()
        assert any(line.startswith("lowest velocity, m/s") for line in run_lines(result))
        assert "lowest velocity" in run_report(result, "run.nc")
        assert unit_of("lowest_velocity") == "m/s" and meaning_of("lowest_velocity")
    finally:
        CATALOGUE.remove(mine)


@pytest.mark.parametrize(
    ("name", "kind"),
    [("loads.time.work", "work"), ("joints.power_pin.max_eccentricity_ratio", "motion")],
)
def test_a_kind_follows_from_the_quantity_and_not_from_a_name(name, kind):
    """In a joint named power_pin the eccentricity counted as a load, [load.time] had no errors."""
    placed = declared(name)
    assert placed is not None and placed.quantity.kind.name == kind
    assert placed.quantity.place in (Place.JOINT, Place.LOAD)
