"""exu-press doctor: says what is there, and tells a sound installation from a broken one."""

import dataclasses

import numpy as np
import pytest
from independent.reduced_slider_crank import ReducedSliderCrank
from packaging.markers import default_environment

from exu_press import Scene, simulate
from exu_press.cli import main
from exu_press.installation import check


def test_a_sound_installation(capsys):
    assert main(["doctor"]) == 0
    text = capsys.readouterr().out
    for name in ("Python", "exudyn", "numpy", "fatigue", "benchmark", "joints:"):
        assert name in text
    assert text.count("ok: ") == 2
    assert text.rstrip().endswith("this installation works")


def test_the_stored_number_is_that_of_the_independent_model():
    """Without its film the slider-crank is further from it than a sound run may be."""
    reduced = ReducedSliderCrank("pinkus").slider(np.array([0.05, 0.1]), 1e-10)
    assert reduced[-1] == pytest.approx(check.LUBRICATED_SLIDER, abs=1e-9)
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "ideal"}, revolutions=0.4)
    ideal = simulate(scene)["slider_position"][-1]
    assert abs(ideal - check.LUBRICATED_SLIDER) > 10 * check.LUBRICATED_ERROR


def test_a_wrong_number_a_broken_run_and_a_missing_package_are_status_1(monkeypatch, capsys):
    def broken():
        raise ImportError("libsomething.so: cannot open")

    sound = check.runs()
    wrong = dataclasses.replace(sound[1], value=sound[1].expected + 2 * sound[1].allowed)
    monkeypatch.setattr(check, "versions", lambda: {"exudyn": "1.13.6", "scipy": None})
    monkeypatch.setattr(check, "_lubricated_run", broken)
    assert main(["doctor"]) == 1
    text = capsys.readouterr().out
    assert "WRONG: lubricated film: ImportError: libsomething.so" in text
    assert "scipy            MISSING" in text
    monkeypatch.setattr(check, "runs", lambda: [sound[0], wrong])
    assert main(["doctor"]) == 1
    assert "WRONG: slider-crank" in capsys.readouterr().out


def test_ngsolve_is_needed_where_it_has_wheels(monkeypatch):
    systems = {
        ("linux", "x86_64"): True,
        ("linux", "aarch64"): False,
        ("darwin", "arm64"): True,
        ("win32", "AMD64"): True,
    }
    for (system, processor), has_wheels in systems.items():
        here = {**default_environment(), "sys_platform": system, "platform_machine": processor}
        monkeypatch.setattr("packaging.markers.default_environment", lambda here=here: here)
        assert ("ngsolve" in check.versions()) == has_wheels, system
