"""Equilibrium and coefficients of a bearing: closed forms, tables, and the law's own force."""

import json
import math

import numpy as np
import pytest

from exu_press import InputError, Scene, bearing_coefficients
from exu_press.cli import main
from exu_press.studies.bearing.coefficients import critical_mass
from exu_press.studies.bearing.figure import bearing_figure
from exu_press.studies.bearing.journal import Journal
from exu_press.studies.bearing.report import BearingReport
from exu_press.studies.bearing.study import BearingStudy

RADIUS, CLEARANCE, LENGTH, VISCOSITY, SPEED = 0.05, 1e-4, 0.05, 0.05, 300.0
TURNING = SPEED * math.tau / 60.0
OIL = {"viscosity_cst": [68.0, 8.7], "density": 870.0, "supply_celsius": 40.0}


def scene_with(law, **film):
    sizes = {"kind": "lubricated", "clearance": CLEARANCE, "radius": RADIUS}
    film = {"law": law, "length": LENGTH, "viscosity": VISCOSITY} | film
    if "oil" in film:
        del film["viscosity"]
    return Scene(mechanism="slider_crank", joints={"crank_pin": sizes}, film=film)


def coefficients(law, load, **film):
    return bearing_coefficients(scene_with(law, **film), "crank_pin", load=load, speed_rpm=SPEED)


@pytest.mark.parametrize("eps", [1e-25, 1e-11, 0.1, 0.5, 0.8])
def test_ocvirks_bearing(eps):
    """Ocvirk 1952: load, attitude, flow; Petroff's torque, and the load's couple, as the loss."""
    s2 = 1.0 - eps * eps
    size = VISCOSITY * LENGTH**3 * RADIUS * TURNING / (4.0 * CLEARANCE**2)
    load = size * eps / s2**2 * math.sqrt(16.0 * eps**2 + math.pi**2 * s2)
    bearing = coefficients("short", (load, 0.0))
    attitude = math.atan(math.pi * math.sqrt(s2) / (4.0 * eps))
    assert bearing.eccentricity_ratio == pytest.approx(eps, rel=1e-8)
    assert bearing.attitude_angle == pytest.approx(attitude, rel=1e-8)
    assert bearing.side_flow == pytest.approx(eps * TURNING * RADIUS * CLEARANCE * LENGTH)
    petroff = VISCOSITY * LENGTH * RADIUS**3 / CLEARANCE * math.tau / math.sqrt(s2) * TURNING**2
    couple = 0.5 * load * eps * CLEARANCE * math.sin(attitude) * TURNING
    assert bearing.power == pytest.approx(petroff + couple, rel=1e-8)


@pytest.mark.parametrize(
    ("law", "film"),
    [
        ("pinkus", {}),
        ("pi_film", {}),
        ("short", {}),
        ("finite", {}),
        ("finite", {"at_contact": "mixed", "roughness": 4e-6}),
    ],
)
def test_matrices_are_the_derivatives_of_the_force_that_bears_the_load(law, film):
    """Against differences of the joint's own force, in a direction of no symmetry."""
    load = (3000.0, -20000.0)
    scene = scene_with(law, **film)
    bearing = bearing_coefficients(scene, "crank_pin", load=load, speed_rpm=SPEED)
    journal = Journal(scene, "crank_pin", TURNING)
    e = np.array(bearing.eccentricity)
    assert journal.force(tuple(e)) == pytest.approx((-load[0], -load[1]), rel=1e-8)
    step = 1e-6 * CLEARANCE
    for column, direction in enumerate(np.eye(2)):
        ahead, behind = (journal.force(tuple(e + sign * step * direction)) for sign in (1, -1))
        slope = -np.subtract(ahead, behind) / (2.0 * step)
        largest = np.abs(bearing.stiffness).max()
        assert slope == pytest.approx(bearing.stiffness[:, column], abs=1e-5 * largest)
    if law in ("short", "finite") and not film:  # Reynolds' damping is symmetric
        c_xy, c_yx = bearing.damping[0, 1], bearing.damping[1, 0]
        assert c_xy == pytest.approx(c_yx, abs=2e-3 * np.abs(bearing.damping).max())


def test_critical_mass_is_where_an_eigenvalue_crosses():
    bearing = coefficients("pi_film", (0.0, -5000.0))
    k, c = bearing.stiffness, bearing.damping
    assert critical_mass(k, c) == bearing.critical_mass
    for share, grows in ((0.99, False), (1.01, True)):
        m = share * bearing.critical_mass
        system = np.block([[np.zeros((2, 2)), np.eye(2)], [-k / m, -c / m]])
        assert (np.linalg.eigvals(system).real.max() > 0.0) == grows


def test_warm_oil_has_the_temperature_of_its_heat_balance():
    bearing = coefficients("finite", (0.0, -5000.0), oil={**OIL, "conductance": 2.0})
    rise = bearing.temperature - 40.0
    assert bearing.power == pytest.approx((1.8e6 * bearing.side_flow + 2.0) * rise, rel=1e-5)
    oil = scene_with("finite", oil=OIL).joints["crank_pin"].film.oil
    assert bearing.viscosity == pytest.approx(oil.viscosity(bearing.temperature), rel=1e-9)


@pytest.mark.long
def test_an_inclined_journal_warms_its_oil_as_a_parallel_one_does():
    """Its film bears no load without bound: that of the hottest oil would not bear this one."""
    inclined = coefficients("grooved", (0.0, -1000.0), tilt=5e-4, oil=OIL)
    parallel = coefficients("finite", (0.0, -1000.0), oil=OIL)
    assert inclined.temperature == pytest.approx(parallel.temperature, abs=1.0)
    oil = scene_with("finite", oil=OIL).joints["crank_pin"].film.oil
    carried = oil.heat_capacity * inclined.side_flow * (inclined.temperature - oil.supply_celsius)
    lost = oil.conductance * (inclined.temperature - oil.frame)
    assert inclined.power == pytest.approx(carried + lost, rel=1e-5)


def test_what_is_no_bearing_is_refused():
    scene = scene_with("finite")
    for joint, load, speed, words in (
        ("wrist_pin", (0.0, 1.0), 1.0, "no lubricated journal; allowed: crank_pin"),
        ("crank_pn", (0.0, 1.0), 1.0, "crank_pn"),
        ("crank_pin", (0.0, 0.0), 1.0, "load = "),
        ("crank_pin", (0.0, 1.0), math.inf, "speed_rpm = inf: allowed is a number"),
    ):
        with pytest.raises(InputError, match=words):
            bearing_coefficients(scene, joint, load=load, speed_rpm=speed)


@pytest.mark.parametrize(("load", "cure"), [(1e-200, "more load"), (1e200, "less load")])
def test_a_load_without_equilibrium_is_refused_with_the_cure(load, cure):
    with pytest.raises(InputError, match=f"no equilibrium; allowed is {cure}"):
        coefficients("finite", (0.0, -load))


@pytest.mark.parametrize(
    ("load", "at_contact", "warns"),
    [("1e9", "stop", True), ("1e6", "mixed", False), ("1e4", "stop", False)],
)
def test_a_film_thinner_than_rough_surfaces_has_a_warning(
    load, at_contact, warns, tmp_path, capsys
):
    words = ["--set", "film.law=short", "--set", f"film.at_contact={at_contact}", "--no-pictures"]
    where = ["--load", load, "--speed", "240", "--out", str(tmp_path)]
    assert main(["bearing", "press", "crank_pin", *words, *where]) == 0
    assert ("rms touch" in " ".join(capsys.readouterr().err.split())) == warns


def test_a_mixed_film_bears_what_a_film_alone_does_before_the_surfaces_are_pressed(
    tmp_path, capsys
):
    film = {"law": "short", "viscosity": 0.4}
    mixed, alone = (
        bearing_coefficients(
            Scene(film={**film, "at_contact": at_contact}),
            "crank_pin",
            load=(0.0, -1e5),
            speed_rpm=1.0,
        )
        for at_contact in ("mixed", "stop")
    )
    assert mixed.eccentricity == pytest.approx(alone.eccentricity, rel=1e-6)
    thin = ["--set", "film.at_contact=mixed", "--set", "film.viscosity=0.004", "--load", "1e5"]
    words = [*thin, "--set", "film.law=short", "--speed", "1", "--no-pictures"]
    assert main(["bearing", "press", "crank_pin", *words, "--out", str(tmp_path)]) == 0
    shown = " ".join(capsys.readouterr().err.split())
    assert "press the surfaces" in shown and "where no law of a film holds" in shown


def test_a_load_has_its_sign_from_the_direction(tmp_path, capsys):
    words = ["--load", "-5", "--speed", "240", "--out", str(tmp_path / "out")]
    assert main(["bearing", "press", "crank_pin", *words]) == 2
    assert "load = -5: allowed is a number > 0 (N)" in capsys.readouterr().err


def test_command(tmp_path, capsys):
    """The locus in the picture goes to loads above those, and ends where surfaces bear them."""
    words = ["--set", "film.law=short", "--set", "film.at_contact=mixed"]
    words += ["--load", "1e4", "1e6", "--speed", "240"]
    assert main(["bearing", "press", "crank_pin", *words, "--out", str(tmp_path)]) == 0
    assert "c_yy, N s/m" in capsys.readouterr().out
    rows = json.loads((tmp_path / "bearing.json").read_text())["equilibria"]
    assert [row["load"][1] for row in rows] == [-1e4, -1e6]
    assert {"bearing.csv", "bearing.png"} <= {file.name for file in tmp_path.iterdir()}


def test_the_picture_has_a_line_for_each_speed():
    """Stiffness over the load: no line goes from one speed to another."""
    scene, loads, speeds = scene_with("short"), (1e3, 4e3), (60.0, 200.0)
    rows = [
        bearing_coefficients(scene, "crank_pin", load=(0.0, -load), speed_rpm=speed)
        for speed in speeds
        for load in loads
    ]
    report = BearingReport(BearingStudy(scene, joint="crank_pin", loads=loads, speeds=speeds), rows)
    stiffness = bearing_figure(report).axes[2]
    lines = [line.get_xdata() for line in stiffness.lines if len(line.get_xdata())]
    assert [list(line) for line in lines] == [list(loads)] * 8
    assert {"60 rpm", "200 rpm"} <= {t.get_text() for t in stiffness.get_legend().texts}


def test_the_other_sense_of_rotation_is_the_mirror_image():
    load, flipped = (3000.0, -4000.0), np.diag([-1.0, 1.0])
    scene = scene_with("finite")
    left = bearing_coefficients(scene, "crank_pin", load=load, speed_rpm=SPEED)
    right = bearing_coefficients(scene, "crank_pin", load=(-3000.0, -4000.0), speed_rpm=-SPEED)
    assert right.attitude_angle == pytest.approx(left.attitude_angle)
    assert right.stiffness == pytest.approx(flipped @ left.stiffness @ flipped)
