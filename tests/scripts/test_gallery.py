"""Scripts of the gallery are short, and end in the numbers they should.

Where there is a closed form or a balance it is the number; elsewhere it is what the script printed.
"""

import math
import runpy
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from running import SCRIPTS
from scipy.integrate import solve_ivp

GALLERY = sorted((SCRIPTS / "gallery").glob("*.py"))

PATH = [str(Path(__file__).parent), str(Path(__file__).parents[1])]

WEIGHT = 10.0 * 9.81


def check_ideal_press(found):
    assert found["deviation"] < 1e-12
    assert found["stroke"] == pytest.approx(0.026172, rel=1e-4)


def check_ideal_dry_lubricated(found):
    """Impacts show in what is resolved; a film hardly shows."""
    peaks = found["peaks"]
    assert peaks["ideal"][0] == pytest.approx(20.437, rel=2e-3)
    assert peaks["lubricated"][0] == pytest.approx(peaks["ideal"][0], rel=5e-3)
    assert peaks["dry"][0] > 1.5 * peaks["dry"][1] > 1.5 * peaks["ideal"][1]


def check_clearance_study(found):
    forces = found["forces"]
    assert forces == sorted(forces)
    assert forces[0] == pytest.approx(33_973, rel=0.02)
    assert forces[-1] == pytest.approx(142_002, rel=0.02)


def check_flexible_crank(found):
    assert found["forces"]["flexible"] != found["forces"]["rigid"]
    assert all(1e3 < force < 1e7 for force in found["forces"].values())


def check_own_mechanism(found):
    ideal, worn = found["strokes"]
    assert ideal == pytest.approx(0.0685458, rel=1e-5)
    assert 0.0 < abs(worn - ideal) < 2e-3


def check_joint_in_an_exudyn_model(found):
    """A rod that falls from the horizontal swings through with 5/2 of its weight."""
    assert found["force"].max() == pytest.approx(2.5 * WEIGHT, rel=0.01)
    assert 0.0 < found["record"][:, -2].min() < 5e-5


def check_any_exudyn_model(found):
    assert found["deviation"] < found["bound"] < 1e-4 * found["START"]


def check_fit_clearance(found):
    assert found["low"] < found["TRUE"] < found["high"]
    assert found["clearance"] == pytest.approx(found["TRUE"], rel=1e-3)


def check_wear(found):
    clearances = found["clearances"]
    assert clearances[0] == pytest.approx(5e-5)
    assert clearances == sorted(clearances) and clearances[-1] < 1e-4


def check_press_in_the_shop(found):
    assert found["force"] == pytest.approx(320e3, rel=0.01)
    assert found["crank"] == pytest.approx(6719.0, rel=0.02)
    assert found["motor"] < 0.05 * found["crank"]


def check_attractor(found):
    assert str(found["motion"].period) == "1 revolution"
    assert found["high"] < 0.0


def check_optimise_counterweight(found):
    assert found["mass"] == pytest.approx(2126.0, rel=0.02)
    assert found["force"] == pytest.approx(16_888.0, rel=1e-3)


def check_two_point_press(found):
    """The load rises slowly against its vibrations: the points bear what statics says."""
    for side, share in found["shares"].items():
        assert found["peaks"][side] == pytest.approx(share, rel=0.04)
    assert found["tilt"] == pytest.approx(27.4e-6, rel=0.05)


def check_counterbalance(found):
    """At 30 rpm the weight is most of the torque; the air's pressure rises by its polytropic."""
    assert found["torques"]["with"] < 0.25 * found["torques"]["without"]
    stroke = found["result"].quantity("stroke").value
    rise = (0.2 / (0.2 - 0.03 * stroke)) ** 1.3
    assert found["pressure"] == pytest.approx(found["cylinder"].pressure * rise, rel=1e-6)


def check_cycloidal_press(found):
    assert found["deviation"] < 1e-12
    assert found["rest"] == pytest.approx(65e-6, rel=0.02)
    assert found["torque"] == pytest.approx(112.0, rel=0.02)


def check_own_friction_law(found):
    """Friction brakes; without it the pendulum is a uniform rod on a fixed pin."""
    angles = found["angles"]
    rod = solve_ivp(
        lambda _, y: [y[1], -1.5 * 9.81 * math.cos(y[0])], (0.0, 0.6), [0.0, 0.0], rtol=1e-9
    )
    assert angles[0.0] == pytest.approx(rod.y[0, -1], abs=2e-3)
    assert angles[0.0] < angles[0.1] < angles[0.3] < -math.pi / 2


def check_bearing_coefficients(found):
    """The more load, the stiffer; the last bearing carries any mass."""
    stiffness = [bearing.stiffness[1, 1] for bearing in found["bearings"].values()]
    assert stiffness == sorted(stiffness)
    assert found["bearing"].eccentricity_ratio == pytest.approx(0.8423, rel=1e-3)
    assert math.isinf(found["bearing"].critical_mass)


def check_slides_and_slots(found):
    """Travels by the crank's radius and the lengths; a looser block knocks harder."""
    travels, forces = found["travels"], found["forces"]
    arm = 0.75  # of the shaper, whose crank is a quarter as long as its shaft is away
    assert travels["crank_shaper"] == pytest.approx(2.0 * arm * 0.25, rel=1e-6)
    assert travels["scotch_yoke"] == pytest.approx(0.2, rel=1e-6)
    assert travels["oscillating_cylinder"] == pytest.approx(0.12, rel=1e-6)
    assert forces[5e-5] > forces[1e-5] > 0.0


def check_of(script):
    return globals()[f"check{script.stem[2:]}"]


@pytest.mark.parametrize("script", GALLERY, ids=lambda path: path.stem)
def test_a_script_is_short_and_has_a_check(script):
    lines = script.read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 40 and lines[0].startswith('"""') and lines[0].endswith('."""')
    assert "print(" in lines[-1] or lines[-1].startswith("    print(")
    assert check_of(script)


@pytest.mark.long
@pytest.mark.parametrize("script", GALLERY, ids=lambda path: path.stem)
def test_a_script_ends_in_its_numbers(script, tmp_path):
    """In a process of its own: what one has loaded would be loaded for the next."""
    if "flexible" in script.stem and find_spec("ngsolve") is None:
        pytest.skip("needs NGSolve")
    code = f"import sys; sys.path[:0] = {PATH!r}; import test_gallery as t; t.run({str(script)!r})"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout


def run(path):
    """Run a script here, and check what it ends in."""
    check_of(Path(path))(runpy.run_path(path, run_name="__main__"))
