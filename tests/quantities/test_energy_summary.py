"""The energy balance in numbers: relative to what, and where there is none."""

from pathlib import Path

import numpy as np
import pytest
from exudyn.itemInterface import LoadForceVector, MarkerBodyRigid

import exu_press
from exu_press import Result, Scene, simulate
from exu_press.plots.save import save_pictures
from exu_press.quantities.energy import energy_residual
from exu_press.result import record

SCENES = Path(exu_press.__file__).parent / "scenes"


class Balance(dict):
    """The channels of a balance, and the scene that they are of."""

    scene = Scene()


def _balance(given, stored, lost):
    channels = {"energy_input": given, "energy_stored": stored, "energy_dissipated": lost}
    return Balance({name: np.array(values) for name, values in channels.items()})


def test_a_rotor_that_runs_down_is_put_nothing_in():
    """Relative to the work put in the residual would be 0, however wrong."""
    closed = _balance([0.0, 0.0, 0.0], [0.0, -2.0, -4.0], [0.0, 2.0, 4.0])
    open_ = _balance([0.0, 0.0, 0.0], [0.0, -2.0, -4.0], [0.0, 2.0, 3.0])
    assert energy_residual(closed) == 0.0
    assert energy_residual(open_) == pytest.approx(0.25)


def test_a_flight_without_contact_exchanges_nothing_that_a_residual_could_be_relative_to():
    """1.6e-7 J of 10 J of kinetic energy, all of it the method's, was called wrong."""
    keys = ["contact.modulus=1.15e8", "revolutions=0.02"]
    flight = simulate(Scene.load(SCENES / "slider_crank.toml", keys))
    assert energy_residual(flight) is None
    assert energy_residual(simulate(Scene.load(SCENES / "slider_crank.toml", keys[1:]))) < 1e-4


def test_the_user_s_own_load_leaves_no_balance(tmp_path, monkeypatch):
    """A kilonewton against the slider did 26 J of work that the balance missed."""
    scene = Scene(joints={"crank_pin": "ideal", "balls": "ideal"}, revolutions=0.1)
    model = scene.build()
    marker = MarkerBodyRigid(bodyNumber=model.bodies["slider"])
    load = LoadForceVector(markerNumber=model.mbs.AddMarker(marker), loadVector=[0.0, 1e3, 0.0])
    model.mbs.AddLoad(load)
    model.mbs.Assemble()
    result = record(model, model.solve())
    summary = result.summary()
    assert summary["own_items"] == 1
    energies = [v for name, v in summary["quantities"].items() if name.startswith("energy.")]
    assert len(energies) == 6 and all(entry["value"] is None for entry in energies)
    result.save(tmp_path / "run.nc")
    result = Result.load(tmp_path / "run.nc")
    assert not any(name.startswith("energy_") for name in result)
    assert any("no energy balance" in warning for warning in summary["warnings"])
    monkeypatch.setattr("exu_press.plots.save.draw_figures", lambda draws, *_: list(draws))
    assert save_pictures(result, tmp_path) == ["slider", "force"]
