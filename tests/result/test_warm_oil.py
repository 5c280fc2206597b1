"""Oil that warms: closed forms, balances, what it depends on, and how a run goes on with it."""

import math

import numpy as np
import pytest

from exu_press import InputError, Result, Scene, simulate
from exu_press.laws.film.oil import roelands, walther
from exu_press.laws.film.side_flow import finite_flow
from exu_press.quantities.law_errors import temperature_error
from exu_press.scene import mechanism_of
from exu_press.studies.attractor.orbit import Orbit

OIL = {"viscosity_cst": (68.0, 8.7), "density": 870.0, "supply_celsius": 40.0, "conductance": 5.0}


def scene_of(oil=None, **keys):
    given = {"mechanism": "slider_crank", "joints": {"crank_pin": "lubricated"}}
    given |= {"revolutions": 4.0, "solver": {"tolerance": 1e-2}}
    return Scene(**(given | {"film": {"oil": OIL | (oil or {})}} | keys))


def of_pin(result, name):
    return result.quantity(f"joints.crank_pin.{name}").value


def celsius(temperature):
    points = zip((40.0, 100.0), OIL["viscosity_cst"], strict=True)
    return walther(temperature, *points)[0] * 1e-6 * OIL["density"]


@pytest.fixture(scope="module")
def result():
    return simulate(scene_of())


def test_the_heat_balance_closes(result):
    """Dissipation is what side flow and frame take, within what the warnings allow."""
    assert abs(of_pin(result, "film.residual")) < 0.01
    assert abs(of_pin(result, "film.change")) < 0.02
    lost, taken_off = of_pin(result, "mean_power"), of_pin(result, "film.carried_off")
    assert of_pin(result, "film.residual") == pytest.approx((lost - taken_off) / lost)
    errors = result.scene.joints["crank_pin"].film.law.errors
    assert temperature_error(result.scene, "crank_pin", 60.0) == pytest.approx(20.0 * sum(errors))
    warmer = of_pin(result, "film.temperature") - 40.0
    per_kelvin = 1.8e6 * of_pin(result, "film.side_flow") + 5.0
    assert of_pin(result, "film.carried_off") == pytest.approx(per_kelvin * warmer, rel=1e-6)
    assert of_pin(result, "mean_power") == pytest.approx(per_kelvin * warmer, rel=0.01)
    assert not [words for words in result.summary()["warnings"] if "film" in words]
    assert result.quantity("energy.residual").value < 1e-4  # through changes of viscosity
    assert (np.diff(result.time) > 0.0).all()
    temperature, viscosity = result["crank_pin_temperature"], result["crank_pin_viscosity"]
    assert temperature[0] == 40.0
    for instant in (1, -1):
        assert viscosity[instant] == pytest.approx(celsius(temperature[instant]), rel=1e-12)


def test_a_run_with_the_viscosity_found_dissipates_the_same(result):
    """The fixed point by another way: a constant viscosity, with which the balance closes."""
    viscosity = float(result["crank_pin_viscosity"][-1])
    constant = simulate(result.scene.replace({"film.viscosity": viscosity, "settle": 3.0}))
    assert "crank_pin_temperature" not in constant
    assert "oil" not in constant.scene.film
    for name in ("mean_power", "max_eccentricity_ratio", "peak_force"):
        assert of_pin(constant, name) == pytest.approx(of_pin(result, name), rel=2e-3)


def test_side_flow_is_that_of_the_recorded_motion(result):
    """From differences of eccentricities and of the bodies' angles; the flow does not jump."""
    time, e = result.time, result.joints["crank_pin"].eccentricity
    pin = result.scene.joints["crank_pin"]
    drawn = next(j for j in mechanism_of(result.scene).joints if j.name == "crank_pin")
    turning = sum(
        np.gradient(result["body_position"][:, result.bodies.index(body), 2], time)
        for body in (drawn.journal, drawn.bearing)
    )
    eps = np.linalg.norm(e, axis=1) / pin.clearance
    eps_dot = np.gradient(eps, time)
    gamma_dot = np.gradient(np.unwrap(np.arctan2(e[:, 1], e[:, 0])), time)
    size = pin.film.length * pin.radius * pin.clearance
    flow = finite_flow(pin.film.length / (2.0 * pin.radius))
    by_hand = size * flow(eps, eps_dot, eps * (turning - 2.0 * gamma_dot))
    inside = time > 0.5 * time[-1]
    found = result["crank_pin_side_flow"]
    assert np.abs(by_hand - found)[inside].mean() < 0.01 * found[inside].mean()


def test_concentric_journal_is_petroffs_against_the_conductance():
    """2 pi mu(T) L R^3 / c mean(w^2) = G (T - T_s), with next to no side flow.

    A light slider on a slow crank without weight: the journal stays near its bearing's centre.
    """
    own = {"conductance": 0.5, "frame_celsius": 30.0, "heat_capacity": 1e-3}
    scene = scene_of(own, speed_rpm=30.0, gravity=0.0, start="centred")
    scene = scene.replace({f"slider_crank.{body}_mass": 1e-2 for body in ("rod", "slider")})
    run = simulate(scene)
    assert of_pin(run, "max_eccentricity_ratio") < 0.05
    mechanism, pin = mechanism_of(scene), scene.joints["crank_pin"]
    drawn = next(joint for joint in mechanism.joints if joint.name == "crank_pin")
    angles = np.linspace(0.0, 2.0 * math.pi, 3601)[:-1]
    motion = mechanism.motion(angles, scene.angular_speed)
    turning = motion[drawn.journal].velocity[:, 2] - motion[drawn.bearing].velocity[:, 2]
    petroff = 2.0 * math.pi * pin.film.length * pin.radius**3 / pin.clearance
    petroff *= float((turning**2).mean())
    temperature = 30.0
    for _ in range(200):
        heat = petroff * celsius(temperature)
        temperature += 0.3 * (30.0 + heat / 0.5 - temperature)
    assert temperature > 32.0
    assert of_pin(run, "film.temperature") == pytest.approx(temperature, abs=0.02)
    assert of_pin(run, "mean_power") == pytest.approx(petroff * celsius(temperature), rel=2e-3)


def test_pressure_thickens_the_oil(result):
    run = simulate(scene_of({"pressure_viscosity": 2e-8}))
    pin = run.scene.joints["crank_pin"]
    thin = celsius(of_pin(run, "film.temperature"))
    force = np.linalg.norm(run.joints["crank_pin"].force, axis=1)
    last = run.time > run.time[-1] - 60.0 / run.scene.speed_rpm
    mean = np.trapezoid(force[last], run.time[last]) / (60.0 / run.scene.speed_rpm)
    pressure = mean / (2.0 * pin.radius * pin.film.length)
    assert of_pin(run, "film.viscosity") == pytest.approx(
        roelands(thin, 2e-8, pressure)[0], rel=1e-3
    )
    highest = 50.0 * force.max() / (2.0 * pin.radius * pin.film.length)
    struck = run.with_values({"crank_pin_force": 50.0 * run["crank_pin_force"]})
    (warning,) = [text for text in struck.summary()["warnings"] if "times as thick" in text]
    assert f"{highest / 1e6:.3g} MPa" in warning
    thicker = roelands(thin, 2e-8, highest)[0] / of_pin(run, "film.viscosity")
    assert f"{thicker:.2g} times" in warning
    assert of_pin(run, "max_eccentricity_ratio") < of_pin(result, "max_eccentricity_ratio")


def test_friction_of_a_mixed_film_heats_it_too():
    thin = {"viscosity_cst": (5.0, 2.0), "supply_celsius": 60.0}
    mixed = {"at_contact": "mixed", "roughness": 1e-6}
    run = simulate(scene_of(thin, film={"oil": OIL | thin, **mixed}, revolutions=2.0))
    assert of_pin(run, "share_contact") > 0.01
    lost = of_pin(run, "mean_power")
    assert of_pin(run, "film.carried_off") == pytest.approx(lost, rel=0.03)


@pytest.mark.long
def test_errors_are_those_of_the_whole_run(result):
    run = simulate(result.scene, errors=True, beside=False)
    told = run.quantity("joints.crank_pin.film.temperature")
    finer = simulate(result.scene.replace({"solver.tolerance": 1e-3}))
    assert told.determined
    assert 0.0 < told.error < 0.1
    assert told.value == of_pin(result, "film.temperature")
    assert abs(of_pin(finer, "film.temperature") - told.value) <= told.error


def test_a_run_goes_on_warm(result, tmp_path):
    result.save(tmp_path / "run.nc")
    loaded = Result.load(tmp_path / "run.nc")
    assert loaded.scene == result.scene
    assert of_pin(loaded, "film.change") == of_pin(result, "film.change")
    further = simulate(loaded.scene.replace({"revolutions": 1.0}), start=loaded.info["state"])
    change = of_pin(result, "film.change")
    now = further["crank_pin_temperature"][0]
    assert now == result["crank_pin_temperature"][-1] + change
    assert abs(of_pin(further, "film.change")) < 0.02


def test_a_motor_goes_on_by_the_same_revolutions_of_the_crank():
    drive = {"rated_torque": 300.0, "inertia": 20.0}
    run = simulate(scene_of(drive=drive, revolutions=1.3))
    further = simulate(run.scene.replace({"revolutions": 2.0}), start=run.info["state"])
    (changed,) = np.flatnonzero(np.diff(further["crank_pin_temperature"]))
    turns = (further["crank_angle"][changed] - run.scene.start_angle) / (2.0 * math.pi)
    assert turns == pytest.approx(3.0, abs=1e-5)  # of part of a revolution nothing is known


def test_a_film_that_keeps_its_heat_ends_the_run():
    own = {"conductance": 1e-9, "heat_capacity": 1e-6}
    with pytest.warns(UserWarning, match="film too hot"):
        run = simulate(scene_of(own))
    assert run.info["status"] == "film broke down"
    assert "250 deg C" in run.info["reason"]
    assert run.time[-1] == pytest.approx(60.0 / run.scene.speed_rpm)


def test_an_orbit_has_one_viscosity():
    with pytest.raises(InputError, match=r"film\.oil: .*film\.viscosity"):
        Orbit(scene_of())
