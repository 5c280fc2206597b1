"""The energy balance in numbers: relative to what, and where there is none."""

from pathlib import Path

import numpy as np
import pytest
from exudyn.itemInterface import LoadForceVector, MarkerBodyRigid

from exu_press import Result, Scene
from exu_press.plots.save import save_pictures
from exu_press.quantities.energy import energy_residual
from exu_press.result import record


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
    assert energy_residual(_balance([0.0, 1e-14], [0.0, -1e-14], [0.0, 0.0])) is None


def test_a_flywheel_that_coasts_misses_a_part_of_its_kinetic_energy():
    """Stored energy that changes by 4.6e-5 of it was the whole energy of the balance."""
    drive = {"inertia": 50.0, "table_speed_rpm": [0.0, 60.0], "table_torque": [500.0, 0.0]}
    joints = {"crank_pin": "ideal"}
    scene = Scene(mechanism="slider_crank", speed_rpm=60.0, joints=joints, drive=drive)
    model = scene.build()
    result = record(model, model.solve())
    assert energy_residual(result) < 1e-3
    assert not any("energy balance" in text for text in result.summary()["warnings"])


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
    monkeypatch.setattr("exu_press.plots.save.draw_figures", lambda draws, *_: [*map(Path, draws)])
    assert save_pictures(result, tmp_path) == [Path("slider"), Path("force")]
