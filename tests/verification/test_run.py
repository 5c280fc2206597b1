"""Runs tell how far their figures can be believed."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.mechanism.press import PAPER_LAWS
from exu_press.quantities import Quantity, QuantityAt
from exu_press.quantities.kind import DIFFERENCE, RESULTANT
from exu_press.scene import flexible_press
from exu_press.verification.estimate import ORDERS
from exu_press.verification.refinement import RefinementRuns
from exu_press.verification.run import errors_of
from exu_press.verification.stated_errors import compare_errors

DRY = {
    "mechanism": "slider_crank",
    "joints": {"crank_pin": "dry"},
    "start": "centred",
    "contact": PAPER_LAWS["contact"],
    "friction": PAPER_LAWS["friction"],
}
"""Whose impacts part motions within a tenth of a revolution."""


@pytest.fixture(scope="module")
def result():
    return simulate(Scene(**DRY, revolutions=0.1))


SCENES = {
    "ideal": {"joints": {"crank_pin": "ideal"}, "revolutions": 0.3},
    "film": {
        "joints": {"crank_pin": {"kind": "lubricated", "clearance": 2e-5}},
        "revolutions": 0.2,
    },
    "dry": {"joints": {"crank_pin": "dry"}, "revolutions": 0.1},
    "steps": {"revolutions": 0.03, "solver": {"step": 2e-5}},
    "flexible": {
        "mechanism": "press",
        "joints": {"crank_pin": "dry"},
        "bodies": flexible_press(modes=4),
        "revolutions": 0.15,
        "solver": {"tolerance": 1e-2},
    },
}


LONG = ("flexible", "film", "steps")


@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=pytest.mark.long) if n in LONG else n for n in SCENES],
)
def test_stated_errors_cover_the_true_ones(name):
    """Of at least nineteen in twenty figures, against a hundredth of the tolerance."""
    scene = Scene.from_dict({"mechanism": "slider_crank", **SCENES[name]})
    if scene.solver.step is not None:
        finer = {"solver.step": scene.solver.step / 10.0}
    else:
        finer = {"solver.tolerance": scene.solver.tolerance / 100.0}
    compared = list(compare_errors(simulate(scene, errors=True), simulate(scene.replace(finer))))
    assert len(compared) > 10
    assert np.mean([figure.is_covered for figure in compared]) >= 0.95


def test_motions_that_part_leave_bounds(result):
    """What happens later is not determined; magnitudes are not below zero, and energies may be."""
    other = simulate(result.scene.replace({"joints.crank_pin.clearance": 4e-4}))
    stated = errors_of(result, [(4.0, other)])
    assert stated["horizon"] is not None
    assert not stated["errors"]["joints.crank_pin.peak_force"]["determined"]
    assert stated["errors"]["peak_acceleration.mean_1ms"]["low"] == 0.0
    assert stated["errors"]["energy.stored"]["low"] < 0.0
    assert stated["errors"]["joints.crank_pin.share_contact"]["high"] == 1.0


@pytest.mark.parametrize(
    ("shift", "side", "error"), [(3e-7, 1.0, 0.0), (5e-7, 1.0, 1.0), (0.0, -1.0, 4.0)]
)
def test_a_count_is_exact_where_its_errors_make_or_lose_no_impact(result, shift, side, error):
    """Five touches and the flights between them are 1 um high; the runs have as many of them.

    The gap's error is 1 / (1 - 0.5**0.6) = 2.9 times the shift. Motions that have parted say least.
    """
    part = result.time / result.time[-1]
    joint = result.scene.joints["crank_pin"]
    runs = []
    for moved in (0.0, shift):
        distance = joint.clearance - joint.onset - 1e-6 * np.cos(10.0 * np.pi * part) + moved
        sides = np.where((part > 0.5) & (len(runs) > 0), side, 1.0)
        place = np.column_stack([sides * distance, 0.0 * part])
        runs.append(result.with_values({"crank_pin_eccentricity": place}))
    stated = errors_of(runs[0], [(0.5, runs[1]), (4.0, runs[1])])
    told = stated["errors"]["joints.crank_pin.impacts"]
    assert (told["error"], told["low"], told["high"]) == (error, 5.0 - error, 5.0 + error)


def test_errors_go_with_the_tolerance_until_journals_are_apart(result):
    """The same forces count otherwise once their journals have nothing in common."""
    clearance = result.scene.joints["crank_pin"].clearance
    late = (result.time > 0.5 * result.time[-1])[:, None]
    force = result["crank_pin_force"] * np.where(late, 1e3, 1.0)
    found = []
    for part in (0.2, 0.4):
        away = result["crank_pin_eccentricity"] + np.where(late, part * clearance, 0.0) * [1.0, 0.0]
        beside = {"crank_pin_force": force, "crank_pin_eccentricity": away}
        found.append(errors_of(result, [(9.0, result.with_values(beside))]))
    near, apart = (one["errors"]["joints.crank_pin.peak_force"]["error"] for one in found)
    assert [one["horizon"] is None for one in found] == [True, False]
    assert apart > 3.0 * near


def test_a_peak_may_be_exceeded_after_the_horizon_although_it_was_in_no_run(result):
    """Later forces scatter by half of the peak, beneath it."""
    peak = result.quantity("joints.crank_pin.peak_force").value
    part = (result.time / result.time[-1])[:, None]
    away = np.where(part > 0.9, 2e-4, 0.0) * [1.0, 0.0]
    runs = [
        result.with_values(
            {
                "crank_pin_eccentricity": result["crank_pin_eccentricity"] + shift,
                "crank_pin_force": np.where(
                    part > 0.9, [later * peak, 0.0], result["crank_pin_force"]
                ),
            }
        )
        for later, shift in ((0.4, 0.0 * away), (0.9, away), (0.2, away))
    ]
    errors = errors_of(runs[0], [(4.0, runs[1]), (8.0, runs[2])])["errors"]
    force = errors["joints.crank_pin.peak_force"]
    assert runs[0].quantity("joints.crank_pin.peak_force").value == pytest.approx(peak)
    assert force["low"] == pytest.approx(peak, rel=0.02)
    assert force["high"] > 1.3 * peak
    assert not force["determined"]


def test_a_run_is_not_lost_with_its_refinements(monkeypatch):
    """Their process may be ended from outside, as where memory is short."""

    def fails(refinements):
        raise RuntimeError("a refinement run failed (-9)")

    monkeypatch.setattr(RefinementRuns, "results", fails)
    scene = Scene(mechanism="slider_crank", joints={}, revolutions=0.02)
    with pytest.warns(UserWarning, match=r"no errors of the quantities are known: .*\(-9\)"):
        result = simulate(scene, errors=True)
    assert result.completed
    assert result.info["errors"] == {}


@pytest.mark.parametrize(
    ("kind", "signed", "determined"),
    [(RESULTANT, False, False), (DIFFERENCE, False, True), (RESULTANT, True, True)],
)
def test_a_peak_that_is_smaller_than_its_error_is_not_determined(kind, signed, determined):
    """265 +- 1669 N says nothing of a force; a difference of 0 +- 1 um says that it is small."""
    run = simulate(Scene(mechanism="slider_crank", joints={}, revolutions=0.1))
    other = run.with_values({"shaking_force": 10.0 * run["shaking_force"]})
    largest = Quantity(
        "largest",
        "N",
        "of a force",
        kind,
        lambda reading, _: float(np.abs(reading["shaking_force"]).max()),
        signed=signed,
    )
    told = errors_of(run, [(4.0, other)], {"largest": QuantityAt(largest, "")})["errors"]["largest"]
    assert told["error"] > told["high"] - told["error"] > 0.0
    assert told["determined"] is determined


def test_a_peak_while_a_film_passes_its_load_over_is_seen():
    """At the end of a pulse the load changes sides within 2 us; the force is then across: 1012 N.

    Runs that passed over this peak said 1633 +- 1250 N and 993 +- 3870 N.
    """
    scene = Scene(
        mechanism="slider_crank",
        speed_rpm=100.0,
        revolutions=1.0,
        joints={"wrist_pin": {"kind": "lubricated", "clearance": 1e-4}},
        film={"at_contact": "mixed"},
        load={"pulse": {"kind": "blanking", "force": 65e3}},
        solver={"tolerance": 3e-3},
    )
    told = simulate(scene, errors=True).quantity("shaking.horizontal")
    assert told.low < 1012.5 < told.high
    assert told.error < 0.6 * told.value


@pytest.mark.long
def test_the_vibration_behind_a_slow_cut_is_within_its_error():
    """An independent model with steps of 0.1 us has a peak of 168368.54 N."""
    contact = {"shape": "point", "stiffness": 2e9, "exponent": 1.0}
    contact |= {"damping": "step", "damping_max": 1e5, "damping_depth": 1e-6}
    pin = {"kind": "dry", "clearance": 5e-5, "radius": 0.07, "friction": {"law": "none"}}
    sheet = {"kind": "sheet", "height": 0.003, "thickness": 0.002, "shear_strength": 3e8}
    sheet |= {"cut_length": 0.2, "penetration": 0.4, "crack_time": 2e-4, "stripping": 0.05}
    scene = Scene(
        mechanism="slider_crank",
        speed_rpm=30.0,
        revolutions=0.2,
        start_angle_deg=130.0,
        start="centred",
        settle=0.0,
        joints={"wrist_pin": pin | {"contact": contact}},
        load={"sheet": sheet},
    )
    told = simulate(scene, errors=True, beside=False).quantity("joints.wrist_pin.peak_force")
    assert told.low < 168368.54 < told.high
    assert told.error < 0.02 * told.value


def test_energies_that_agree_at_the_end_by_chance_are_not_known_so_well(result):
    """Those of a run with clearance swing, and so do their differences."""
    swing = np.cos(6.5 * np.pi * result.time / result.time[-1])  # nothing at the end
    away = result["crank_pin_eccentricity"] * (1.0 + 1e-3 * swing[:, None])
    found = []
    for joules in (0.0, 0.2):
        energy = {"energy_stored": result["energy_stored"] + joules * swing}
        other = result.with_values({"crank_pin_eccentricity": away, **energy})
        told = errors_of(result, [(0.5, other), (8.0, other)])
        assert told["horizon"] is None
        found.append(told["errors"]["energy.stored"]["error"])
    assert found[0] < 1e-3
    expected = 0.2 / (1.0 - 0.5 ** ORDERS["tolerance"])
    assert expected <= 1.1 * found[1] <= 1.2 * expected


@pytest.mark.parametrize("twist", [0.0, 5e-6])  # of a flexible crank
def test_a_sum_over_whole_revolutions_is_known_as_well_as_per_stroke(twist):
    """What runs differ by within a stroke, as in energy that flows back, is no error of either."""
    film = {"law": "short", "viscosity": 0.1, "length": 0.05}
    joints = {"crank_pin": "lubricated"}
    run = simulate(Scene(mechanism="slider_crank", joints=joints, film=film, revolutions=1.0))
    run = run.with_values({"crank_angle": run["crank_angle"] * (1.0 + twist)})
    swing = np.sin(20.0 * np.pi * run.time / run.time[-1])
    away = run["crank_pin_eccentricity"] * (1.0 + 1e-3 * swing[:, None])
    values = {"crank_pin_eccentricity": away, "energy_input": run["energy_input"] + 9.0 * swing}
    other = run.with_values(values)
    errors = errors_of(run, [(0.5, other), (8.0, other)])["errors"]
    total, per_stroke = (errors[f"energy.input{of}"]["error"] for of in ("", "_per_stroke"))
    assert total == pytest.approx(per_stroke) and 0.0 < total < 1.0


def test_what_energies_differ_by_while_a_run_settles_is_no_error():
    run = simulate(Scene(**DRY, revolutions=0.1, settle=0.04))
    early = np.where(run.time > 0.2 * run.time[-1], 5.0, 0.0)
    away = run["crank_pin_eccentricity"] * (1.0 + 1e-3 * np.sin(run.time))[:, None]
    energy = {"energy_stored": run["energy_stored"] + early}
    other = run.with_values({"crank_pin_eccentricity": away, **energy})
    told = errors_of(run, [(0.5, other), (8.0, other)])
    assert told["errors"]["energy.stored"]["error"] < 1e-3


def test_a_force_that_symmetry_makes_nothing_is_known():
    """Its error is what Newton's method leaves of large forces that cancel."""
    run = simulate(Scene(mechanism="press", joints={}, revolutions=0.04), errors=True)
    known = run.info["errors"]["shaking.horizontal"]
    assert known["determined"]
    lifting = run.with_values({"shaking_force": 1e-12 * run["shaking_force"]})
    told = errors_of(lifting, [(4.0, lifting), (8.0, lifting)])["errors"]["shaking.horizontal"]
    assert told["error"] > 1e-12 * known["high"]
    assert told["determined"]


def test_samples_are_not_expected_above_means(result):
    """Their second difference is the mean over 1 ms of means over 1 ms."""
    late = result.time > 0.5 * result.time[-1]
    beside = {
        "crank_pin_eccentricity": np.where(late[:, None], [2e-4, 0.0], 0.0),
        "slider_position": np.where(late, 1e-3 * np.sin(1e3 * result.time), 0.0),
    }
    other = result.with_values({name: result[name] + more for name, more in beside.items()})
    errors = errors_of(result, [(4.0, other), (8.0, other)])["errors"]
    samples, means = (
        errors[f"peak_acceleration.{name}"] for name in ("differentiated_1khz", "mean_1ms")
    )
    assert samples["high"] == means["high"]
    assert (
        samples["error"]
        >= samples["high"] - result.quantity("peak_acceleration.differentiated_1khz").value
    )
