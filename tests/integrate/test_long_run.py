"""A run that will be long says so early."""

import pytest

from exu_press import Scene, simulate

SCENE = Scene.from_dict(
    {
        "mechanism": "slider_crank",
        "speed_rpm": 60.0,
        "revolutions": 0.1,
        "joints": {"crank_pin": "ideal"},
        "guide": {"clearance": 2e-5, "width": 0.1, "friction": "lugre"},
        "solver": {"tolerance": 1e-4},
    }
)


def test_it_says_how_long_and_why(monkeypatch, capsys) -> None:
    monkeypatch.setattr("exu_press.integrate.monitor.SOON", 0.0)
    monkeypatch.setattr("exu_press.integrate.monitor.LONG", 0.0)
    simulate(SCENE, quiet=False)
    said = [line for line in capsys.readouterr().err.splitlines() if "s left: steps of" in line]
    assert len(said) == 1
    for part in ("run: about ", "slider's guide", "guide.friction = 'lugre'", "solver.tolerance"):
        assert part in said[0]


@pytest.mark.parametrize("quiet", [False, True])
def test_a_short_run_says_nothing(quiet: bool, capsys) -> None:
    simulate(SCENE.replace({"revolutions": 0.02}), quiet=quiet)
    assert "s left: steps of" not in capsys.readouterr().err
