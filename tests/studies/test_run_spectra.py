"""Spectra of a run: the command, its marks, and the names that it refuses."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from exu_press import InputError, Result, Scene, simulate
from exu_press.cli import main
from exu_press.result.column import column_of
from exu_press.result.windows import window
from exu_press.studies.spectrum import marks_of, spectra
from exu_press.studies.spectrum_figure import draw_spectrum

PIN = {"clearance": 1e-4, "radius": 0.03}
DRY = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "dry", **PIN}},
    contact={"length": 0.05},
    revolutions=0.3,
)


@pytest.fixture(scope="module")
def run():
    return simulate(DRY)


@pytest.fixture(scope="module")
def ideal():
    return simulate(
        Scene(
            mechanism="slider_crank",
            joints={"crank_pin": "ideal"},
            revolutions=3.0,
            solver={"step": 2e-4},
        )
    )


def test_at_constant_speed_lines_over_frequency_are_those_over_orders(ideal):
    """Two harmonics of an ideal slider's acceleration, and nothing that is below the error."""
    one = spectra(ideal)[0]
    lines = one.lines()
    assert lines[2].split() == ["4", "Hz", f"{one.over_angle.amplitude[1]:.4g}", "m/s^2"]
    assert one.over_angle.amplitude[1] == pytest.approx(18.95, rel=1e-3)
    assert one.over_time.frequency == pytest.approx(4.0 * one.over_angle.frequency, rel=1e-9)
    assert (one.over_time.amplitude == one.over_angle.amplitude).all()
    listed = [float(line.split()[2]) for line in lines if line.startswith("    ")]
    assert min(listed) > one.over_time.error
    assert "lies below the resolution" not in lines[-1]
    twisted = ideal.with_values({"crank_angle": ideal["crank_angle"] * (1.0 - 5e-6)})
    order = spectra(twisted)[0].over_angle
    assert order.frequency.tolist() == one.over_angle.frequency.tolist()
    assert order.amplitude[1] == pytest.approx(one.over_angle.amplitude[1], rel=1e-4)


def test_a_single_revolution_tells_its_largest_orders(ideal):
    """Each of them is a bin: the second one is no peak beside the first one."""
    one = spectra(window(ideal, 0.25, 0.5))[0]
    assert one.revolutions == 1
    told = [line.split() for line in one.lines() if "orders  " in line]
    assert [words[0] for words in told[:2]] == ["1", "2"]
    assert float(told[1][2]) == pytest.approx(one.over_angle.amplitude[1], rel=1e-3)


@pytest.mark.parametrize(("error", "label"), [(1e-2, "sampling"), (1e-9, "below the panel")])
def test_an_error_below_the_panel_is_a_number_without_a_line(ideal, error, label):
    axes = Figure().add_subplot()
    draw_spectrum(axes, replace(spectra(ideal)[0].over_time, error=error), "m/s^2")
    *_, line = axes.lines
    assert line.get_label().endswith(label)
    assert np.all(np.asarray(line.get_ydata()) > axes.get_ylim()[0])


def test_a_journal_on_a_linear_contact_has_its_frequency():
    stiff = DRY.replace({"contact": {"shape": "point", "stiffness": 1e8, "exponent": 1.0}})
    mark = marks_of(simulate(stiff))[0]
    bodies = simulate(stiff.replace({"revolutions": 0.01})).scene
    from exu_press.scene import mechanism_of

    rod = next(b.mass for b in mechanism_of(bodies).bodies if b.name == "rod")
    crank = next(b.mass for b in mechanism_of(bodies).bodies if b.name == "crank")
    assert mark.frequency == pytest.approx(
        np.sqrt(1e8 * (1.0 / rod + 1.0 / crank)) / (2.0 * np.pi), rel=1e-6
    )


def test_the_command(run, tmp_path, capsys):
    run.save(tmp_path / "run.nc")
    twice = ["crank_pin_force.x", "crank_pin_force.x"]
    assert main(["spectrum", str(tmp_path), *twice]) == 0
    told = capsys.readouterr().out
    assert "window flattop" in told
    assert "no order spectrum: the run has no whole revolution" in told
    assert told.count("spectrum_crank_pin_force_x.png") == 1
    assert "natural frequency: crank pin on its contact" in told
    assert (tmp_path / "spectrum_crank_pin_force_x.png").stat().st_size > 10_000
    assert main(["spectrum", str(tmp_path), "--window", "round"]) == 2
    assert main(["spectrum", str(tmp_path), "--format", ".bmp"]) == 2
    assert Result.load(tmp_path / "run.nc").completed


def test_names_that_are_refused(run):
    with pytest.raises(InputError, match=r"none of that name \(did you mean 'crank_pin_force.x'"):
        column_of(run, "crankpin_force.x")
    with pytest.raises(InputError, match=r"a column of it: crank_pin_force.x, crank_pin_force.y"):
        column_of(run, "crank_pin_force")
    with pytest.raises(InputError, match="slider_velocity has no columns"):
        column_of(run, "slider_velocity.x")
    with pytest.raises(InputError, match="allowed is one with a value, or columns, a step"):
        column_of(run, "body_position.x")
