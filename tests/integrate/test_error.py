"""What a step misses, told from three instants, and what it may."""

import itertools
import math
from types import SimpleNamespace

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from stand_in import problem_at

from exu_press import Scene, SolverStatus, simulate, solve_dynamic
from exu_press.integrate.criteria.bodies import BodyError
from exu_press.integrate.criteria.curvature import Curvature
from exu_press.integrate.criteria.eccentricity import JointError
from exu_press.integrate.criteria.share import ErrorPerStep
from exu_press.integrate.criteria.turning import Turning
from exu_press.integrate.criteria.vibration import Quiet
from exu_press.integrate.problem import Node
from exu_press.integrate.scales import ErrorScales, FoundScales
from exu_press.integrate.settings import SolverTuning
from exu_press.joints.path import Path
from exu_press.scene import flexible_press

TUNING = SolverTuning()
NOISE = 1e-13


def scales_of(masses):
    """Scales of bodies that rest, each of one mass and a moment of inertia of 0.5."""
    nodes = (Node(i, "", 3 * i, 3, mass) for i, mass in enumerate(masses))
    problem = problem_at(nodes, np.zeros(3 * len(masses)))
    scales = FoundScales(ErrorScales(speed=1.0, force=1.0), problem, longest=1.0)
    scales.begin(np.diag([value for mass in masses for value in (mass, mass, 0.5)]))
    return scales


def errors(velocity_limit=1e-3, masses=(2.0,)):
    """Errors of bodies that rest at first."""
    return BodyError(
        [0.0] * (3 * len(masses)),
        per_step=ErrorPerStep(velocity_limit),
        scales=scales_of(masses),
        tuning=TUNING,
        noise=NOISE,
    )


def test_accelerations_that_change_at_one_rate_are_followed_exactly():
    error = errors()
    error.tried([1.0, 2.0, 3.0], 0.1)
    error.accept()
    assert error.tried([2.0, 4.0, 6.0], 0.1) == 0.0


def test_velocities_are_off_by_the_cube_of_the_step():
    """a = b t^2: its second derivative is 2 b."""
    b, h = 3.0, 0.01
    error = errors()
    error.tried([1e6, 0.0, 0.0], h)
    error.accept()
    error.tried([0.0, 0.0, 0.0], h)
    error.accept()
    error.tried([0.0, b * h * h, 0.0], h)
    error.accept()
    value = error.tried([0.0, 4.0 * b * h * h, 0.0], h)
    assert value == pytest.approx(h**3 * 2.0 * b / 6.0 / 1e-3)


def test_rotations_count_by_their_energy():
    """An angular acceleration counts sqrt(J/m) of it."""
    turning, moving = errors(), errors()
    value = turning.tried([0.0, 0.0, 4.0], 0.01)
    assert value == pytest.approx(moving.tried([4.0 * math.sqrt(0.5 / 2.0), 0.0, 0.0], 0.01))


def test_what_has_no_say_and_what_rounding_makes():
    assert errors(masses=(math.inf,)).tried([1e3, 1e3, 0.0], 0.01) == 0.0
    step = 1e-8
    rounding = 0.99 * NOISE / step**2
    assert errors(velocity_limit=1e-30).tried([rounding, 0.0, 0.0], step) < 1.0


def test_jumps_are_told_by_body():
    error = errors(masses=(2.0, 8.0))
    error.tried([3.0, 4.0, 0.0, 0.0, 0.0, 4.0], 0.01)
    assert error.of_jump() == pytest.approx(5.0)


def test_what_rounding_makes_alternate_is_no_offset():
    error, h = errors(), 1e-8
    for size in (0.9 * NOISE / h**2, 1.1 * NOISE / h**2):
        error.tried([-size, 0.0, 0.0], h)
        error.accept()
        error.tried([size, 0.0, 0.0], h)
        found = error.offset(h)
        assert found == (0.0 if size < NOISE / h**2 else pytest.approx(h * size / 6.0))


def curvature_after(accelerations, h=0.1, tolerance=1e-2):
    bodies, scales = errors(), scales_of([2.0])
    curvature = Curvature(bodies, scales, NOISE, tolerance)
    for value in accelerations:
        curvature.accept()
        bodies.accept()
        bodies.tried([value, 0.0, 0.0], h)
        found = curvature.error(h)
    return found


def test_accelerations_between_two_instants_are_off_a_line():
    """Of a = b t^2, by b h^2 / 4 in the middle of a step."""
    b, h = 3.0, 0.1
    instants = [b * (i * h) ** 2 for i in range(6)]
    assert curvature_after(instants) == pytest.approx(0.25 * b * h * h / (1e-2 * instants[4]))


def test_a_repeated_step_knows_the_curvature_that_the_longer_one_has_found():
    """Steps that grew one by one had none in common, and what two equal ones had was forgotten."""
    bodies, scales, time, found = errors(), scales_of([2.0]), 0.0, 0.0
    curvature = Curvature(bodies, scales, NOISE, 1e-2)
    for step in (0.1, 0.12, 0.144, 0.144):
        curvature.accept()
        bodies.accept()
        bodies.tried([(time + step) ** 2, 0.0, 0.0], step)
        found, last, time = curvature.error(step), step, time + step
        assert (found > 0.0) is (time > 0.4)
    bodies.tried([(time - 0.5 * last) ** 2, 0.0, 0.0], 0.5 * last)
    assert curvature.error(0.5 * last) == pytest.approx(0.25 * found)


FADING = [(-0.8) ** i for i in range(6)]


@pytest.mark.parametrize(
    "accelerations", [[1.0, -1.0] * 3, FADING, [1.0] * 4 + [2.0], [1.0] * 4 + [2.0] * 2]
)
def test_what_alternates_or_jumps_is_no_curvature(accelerations):
    assert curvature_after(accelerations) == pytest.approx(0.0)


CLEARANCE, LIMIT = 1e-4, 1e-9


def error_of(missed, *, place, contact_onset=CLEARANCE, drift=math.inf, step=1e-4):
    """The error of a step in which a joint at rest is found `missed` away from its place."""
    path = Path()
    path.go_on(place, (0.0, 0.0), step, depth=0.0, memory=0.0)
    there = tuple(p + m for p, m in zip(place, missed, strict=True))
    joint = SimpleNamespace(
        clearance=CLEARANCE,
        contact_onset=contact_onset,
        path=path,
        eccentricity=there,
        relative_velocity=(0.0, 0.0),
    )
    return JointError(joint, LIMIT, drift, 1e-14, TUNING.penetration).error(step)


def test_a_penetration_counts_against_itself():
    deep = (CLEARANCE + 5e-6, 0.0)
    across = error_of((1e-10, 0.0), place=deep)
    assert across == pytest.approx(0.1 / (TUNING.penetration * 0.05), rel=1e-3)
    assert error_of((0.0, 1e-10), place=deep) == pytest.approx(0.1)
    assert error_of((1e-10, 0.0), place=(5e-5, 0.0)) == pytest.approx(0.1)


def test_contacts_follow_the_tolerance_too():
    """Steps of a lasting contact went with tolerance^(-1/15) while rounding was overrated."""
    steps = []
    for tolerance in (1e-3, 1e-4):
        scene = Scene(
            joints={"crank_pin": "dry", "balls": "dry"},
            revolutions=0.025,
            solver={"tolerance": tolerance},
        )
        info = simulate(scene).info
        assert info["newton_iterations"] < 1.3 * info["steps"]
        steps.append(info["steps"])
    assert 2.0 < steps[1] / steps[0] < 5.0


def test_in_a_film_alone_errors_count_over_time():
    in_film = {"place": (5e-5, 0.0), "drift": 1e-6}
    assert error_of((1e-10, 0.0), contact_onset=math.inf, **in_film) == pytest.approx(1.0)
    assert error_of((1e-10, 0.0), **in_film) == pytest.approx(0.1)


def test_thin_films_follow_the_tolerance():
    """Errors of 0.1 and 0.01 at 1e-2 and 1e-3 while each step had its part of the clearance."""
    ratios = {}
    for tolerance in (1e-2, 1e-3, 1e-4):
        thin = {"crank_pin": {"kind": "lubricated", "clearance": 1e-5}}
        given = {"mechanism": "slider_crank", "joints": thin, "revolutions": 0.12}
        scene = Scene(solver={"tolerance": tolerance}, **given)
        run = simulate(scene)
        ratios[tolerance] = np.linalg.norm(run["crank_pin_eccentricity"], axis=1).max() / 1e-5
    for tolerance in (1e-2, 1e-3):
        assert abs(ratios[tolerance] - ratios[1e-4]) < 2.0 * tolerance


@pytest.mark.long
def test_vibrating_bodies_follow_the_tolerance():
    """The impact at 44 ms follows from how the bodies vibrate after the one at 34 ms."""
    scene = Scene(revolutions=0.2, bodies=flexible_press(modes=4))
    peaks = {}
    for tolerance in (1e-1, 1e-3):
        run = simulate(scene.replace({"solver.tolerance": tolerance}))
        late = run.time > 0.04
        peaks[tolerance] = np.abs(run["slider_acceleration"][late]).max()
    assert peaks[1e-1] == pytest.approx(peaks[1e-3], rel=0.3)  # 51 % too high


def test_a_usual_run_gives_each_step_the_whole():
    per_step = ErrorPerStep.of(1e-4, duration=1.0, many_steps=10.0, impacts=False)
    assert per_step.at(1e-3) == pytest.approx(1e-6)  # a thousand steps
    assert per_step.at(1e-5) == pytest.approx(1e-8)  # a hundred times as many
    assert per_step.relaxing(1e-5) == pytest.approx(1e-7)


def test_impacts_leave_a_hundredth():
    assert ErrorPerStep.of(1e-6, 1.0, 10.0, impacts=True).at(1e-9) == pytest.approx(1e-8)
    assert ErrorPerStep.of(1e-6, 1.0, 10.0, impacts=False).whole == pytest.approx(1e-9)


def test_constraints_leave_what_positions_miss_along_a_circle():
    """At a speed of 1 m/s: a = w, da/dt = w^2 along the circle, as much as of an oscillator."""
    w, h = 3.0, 0.01
    error = errors()
    error.tried([w, 0.0, 0.0], h)
    assert error.of_positions([0.0, w * w, 0.0], h) == pytest.approx((w * h) ** 3 / 6.0 / 1e-3)


def test_what_is_to_turn_yet_may_be_off_by_less_along_its_way():
    error = errors()
    one = error.tried([3.0, 4.0, 0.0], 0.01)
    error.velocities = [0.0, 7.0, 0.0]
    error.turning = 0.5
    assert error.error(error.change, 0.01) == one
    error.turning = 10.0
    assert error.error(error.change, 0.01) == pytest.approx(10.0 * 0.8 * one)
    error.velocities = [4.0, -3.0, 0.0]
    assert error.error(error.change, 0.01) == one


def turning_after(motion, *, duration=10.0, time=2.0, steps=2000, quaternion=False):
    """The angle to come of a body whose velocity and acceleration are given at each time."""
    size = 4 if quaternion else 2
    node = Node(0, "", 0, size, 2.0, displacements=2, rotations=4 if quaternion else 0)
    problem = problem_at([node], np.zeros(size))
    state = problem.current
    scales = FoundScales(ErrorScales(speed=1.0, force=1.0), problem, longest=1.0)
    scales.masses, scales.inertias = [2.0], [2.0] * size
    turning = Turning(problem, scales, duration, foreseen=3.0)
    for i in range(1, steps + 1):
        state.velocities, state.accelerations = motion(i * time / steps)
        found = turning.stepped(time / steps)
    return found


def circling(t, w=5.0):
    velocity = np.array([-np.sin(w * t), np.cos(w * t)])
    return velocity, w * np.array([-velocity[1], velocity[0]])


def swinging(t, w=5.0):
    """An ellipse to and fro: to one side and back, with a still smaller circle."""
    return (
        np.array([np.cos(w * t), 0.01 * np.sin(w * t)]),
        w * np.array([-np.sin(w * t), 0.01 * np.cos(w * t)]),
    )


def test_a_circle_goes_on_to_be_turned():
    assert turning_after(circling) == pytest.approx(3.0 * 2.0 * 5.0)  # thrice as long as so far
    assert turning_after(circling, duration=5.0) == pytest.approx(3.0 * 5.0)
    assert turning_after(circling, duration=2.0) == pytest.approx(0.0, abs=1e-9)


def test_a_swing_comes_back():
    assert turning_after(swinging) == pytest.approx(0.02 * turning_after(circling), rel=0.05)
    assert turning_after(lambda t: (np.zeros(2), np.ones(2))) == 0.0


def test_euler_parameters_turn_too():
    def motion(t):
        velocity, acceleration = circling(t)
        return np.array([0.0, *velocity, 0.0]), np.array([0.0, *acceleration, 0.0])

    assert turning_after(motion, quaternion=True) == pytest.approx(30.0)


def test_a_vibration_below_the_tolerance_is_not_followed_however_long_it_lasts():
    """Beside a swing at 1 m/s something vibrates at 1600 Hz and 1e-5 m/s, for 3200 periods."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddNode(items.NodePointGround())
    still = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    for omega, speed in ((2.0, 1.0), (1e4, 1e-5)):
        node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], initialVelocities=[speed]))
        mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=1.0))
        at = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))
        mbs.AddObject(
            items.ObjectConnectorCoordinateSpringDamper(
                markerNumbers=[still, at], stiffness=omega**2
            )
        )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = 2.0, False
    outcome = solve_dynamic(mbs, settings, tolerance=1e-3, max_steps=4000)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    speed = mbs.systemData.GetODE2Coordinates_t()[0]
    assert speed == pytest.approx(math.cos(4.0), abs=2e-3)


V, OMEGA, SIZE = 3.0, 2.0 * math.pi, 1.0 / 40.0


def amplitudes(steps, jump=None, told=None):
    """v = V cos(omega t), at the ends of steps; accelerations may jump in one of them."""
    vibration, found, time, before, last = Quiet(), [], 0.0, 0.0, None
    for i, size in enumerate(steps):
        time += size
        now = -V * OMEGA * math.sin(OMEGA * time) + (0.3 if jump is not None and i >= jump else 0.0)
        rate = (now - before) / size
        if last is not None:
            found.append(vibration.amplitude(abs(rate), abs(rate - last), size))
            vibration.accept()
            if told is not None and i == jump + told:
                vibration.forget()
        before, last = now, rate
    return found


@pytest.mark.parametrize("told", [0, -1, None])
def test_a_jump_beside_a_vibration_does_not_hide_it(told):
    """Once a contact switches in a short step, or behind one that Exudyn lets end where it does."""
    steps = [1e-3 if i in (30, 31) else SIZE for i in range(60)]
    assert (amplitudes(steps, 30, told)[-1] > 2.0) is (told is not None)


@pytest.mark.parametrize("longest", [1.0, 1.5, 3.0])
def test_the_amplitude_of_a_vibration_is_told_by_its_accelerations(longest):
    """Forty times a period and less, by steps that grow and shrink at once."""
    steps = [SIZE * longest ** (0.25 * min(i % 8, 4)) for i in range(100)]
    assert amplitudes(steps)[-1] == pytest.approx(V, rel=0.3)


def test_what_alternates_from_step_to_step_has_the_frequency_of_a_step():
    vibration = Quiet()
    for _ in range(60):
        found = vibration.amplitude(4.0, 8.0, 1.0)
        vibration.accept()
    assert found == pytest.approx(1.0)


def test_accelerations_that_become_constant_have_no_frequency():
    vibration = Quiet()
    assert vibration.amplitude(0.0, 8.0, 1.0) == pytest.approx(1.0)
    assert vibration.amplitude(0.0, 1e-200, 1.0) == math.inf


def test_a_slow_motion_beside_it_makes_a_vibration_no_smaller():
    """At a hundredth of the frequency and with a hundred times the velocity: a hundredth in j."""
    vibration = Quiet()
    rates = [
        -V * OMEGA**2 * (math.cos(OMEGA * t) + math.cos(OMEGA * t / 100.0) / 100.0)
        for t in (SIZE * i for i in range(200))
    ]
    for last, rate in itertools.pairwise(rates):
        found = vibration.amplitude(abs(rate), abs(rate - last), SIZE)
        vibration.accept()
    assert V < found < 1.2 * V
