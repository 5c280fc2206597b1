"""Andrews' squeezer: seven bodies and a published endpoint, to check the integrator against.

A motor drives a planar mechanism of seven bodies from rest for 0.03 s. Numbers and endpoint are
those of the test set for initial value problem solvers, computed there with a tolerance of 1e-14.

References
----------
.. [1] F. Mazzia, C. Magherini, Test Set for Initial Value Problem Solvers, release 2.4,
   University of Bari 2008, problem "Andrews' squeezing mechanism".
.. [2] E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, Springer 1996, VII.7.
"""

import time
from collections.abc import Iterable
from functools import partial
from math import cos, sin
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    LoadTorqueVector,
    MarkerBodyPosition,
    MarkerBodyRigid,
    ObjectConnectorSpringDamper,
    ObjectGround,
    ObjectJointRevolute2D,
)

from exu_press.integrate import SolverStatus, solve_dynamic
from exu_press.mechanism import Body, Motion
from exu_press.model.rigid_body import RigidBody
from exu_press.numerics.arrays import Array
from exu_press.studies.precision.errors import Errors, Trajectory
from exu_press.studies.precision.timing import FIXED, TOLERANCE, Attempt, TimedRun

__all__ = ["DURATION", "END", "END_RATE", "squeezer_attempts", "squeezer_errors"]

DURATION = 0.03  # s

MASS = (0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498)  # kg
INERTIA = (2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5)  # kg m^2
A, B, C = (-0.06934, -0.00227), (-0.03635, 0.03273), (0.014, 0.072)  # m, points of the frame
STIFFNESS, FREE_LENGTH, TORQUE = 4530.0, 0.07785, 0.033  # N/m, m, N m

START = (
    -0.0617138900142764496358948458001,
    0.0,
    0.455279819163070380255912382449,
    0.222668390165885884674473185609,
    0.487364979543842550225598953530,
    -0.222668390165885884674473185609,
    1.23054744454982119249735015568,
)
"""beta, Theta, gamma, Phi, delta, Omega, epsilon at rest, rad."""

END = (
    15.81077119629904,
    -15.75637105984298,
    0.04082224013073101,
    -0.5347301163226948,
    0.5244099658805304,
    0.5347301163226948,
    1.048080741042263,
)
"""The same at 0.03 s, rad."""

END_RATE = (
    1139.920302151208,
    -1424.379294994111,
    11.03291221937134,
    19.29337464421385,
    0.5735699284790808,
    -19.29337464421385,
    0.3231791658026955,
)
"""Their rates, rad/s."""

POINTS = {
    1: {"shaft": (-0.00092, 0.0), "crank pin": (0.007 - 0.00092, 0.0)},
    2: {"crank pin": (0.0115, 0.0), "fork": (0.0115 - 0.028, 0.0)},
    3: {"fork": (-0.01043, 0.01874 - 0.035), "B": (-0.01043, 0.01874)},
    4: {"fork": (0.0, -0.01421), "upper": (0.0, 0.02 - 0.01421)},
    5: {"A": (-0.02308, -0.00916), "upper": (0.04 - 0.02308, -0.00916)},
    6: {"fork": (0.01421, 0.0), "lower": (0.01421 - 0.02, 0.0)},
    7: {"A": (0.00449, 0.01228), "lower": (0.00449, 0.01228 - 0.04)},
}
"""Joints in the bodies' frames, which sit in the centres of mass, m."""

SPRING_END = (0.02 - 0.01043, 0.01874 - 0.018)  # on body 3, m
FRAME = {"shaft": (0.0, 0.0), "A": A, "B": B}
JOINTS = (
    ("shaft", 0, 1),
    ("crank pin", 1, 2),
    ("fork", 2, 3),
    ("fork", 2, 4),
    ("fork", 2, 6),
    ("B", 0, 3),
    ("A", 0, 5),
    ("A", 0, 7),
    ("upper", 5, 4),
    ("lower", 7, 6),
)
"""Name and the two bodies, 0 the frame."""

LARGEST_STEPS = 190  # so many of the largest step that a tolerance may lead to make the run

LEVELS = exu.OutputVariableType.Coordinates, exu.OutputVariableType.Coordinates_t


def squeezer_attempts(steps: Iterable[float], tolerances: Iterable[float]) -> list[Attempt]:
    """Return the runs with fixed steps (s) and with tolerances."""
    fixed = [Attempt(FIXED, "step", h, partial(_run, round(DURATION / h), None)) for h in steps]
    controlled = [
        Attempt(TOLERANCE, "tolerance", tol, partial(_run, LARGEST_STEPS, tol))
        for tol in tolerances
    ]
    return fixed + controlled


def squeezer_errors(run: Trajectory) -> Errors:
    """Return the endpoint's largest errors of angle (rad) and rate (rad/s)."""
    angle, rate = run.position[-1], run.velocity[-1]
    return Errors(float(np.abs(angle - END).max()), float(np.abs(rate - END_RATE).max()), None)


def _run(steps: int, tolerance: float | None) -> TimedRun:
    """Integrate it as any Exudyn system, with fixed steps or with a tolerance."""
    mbs, nodes = _build()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.timeIntegration.numberOfSteps = DURATION, steps
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    settings.linearSolver.solverType = exu.LinearSolverType.EigenDense
    settings.solution.file.write = False
    start = time.process_time()
    outcome = solve_dynamic(mbs, settings, tolerance=tolerance, max_steps=10_000_000)
    cpu_time = time.process_time() - start
    done = outcome.status is SolverStatus.COMPLETED
    return TimedRun(
        trajectory=_end_of(mbs, nodes) if done else None,
        wall_times=(outcome.wall_time,),
        cpu_times=(cpu_time,),
        status=outcome.status.value,
        reason=outcome.reason,
        steps=outcome.steps,
        rejected_steps=outcome.rejected_steps,
        newton_iterations=outcome.newton_iterations,
        law_evaluations=outcome.law_evaluations,
    )


def _build() -> tuple[exu.MainSystem, list[int]]:
    """Return the assembled system and the nodes of its seven bodies."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    ground = mbs.AddObject(ObjectGround())
    objects, nodes, still = [ground], [], np.zeros((1, 3))
    places = _start_places()
    for number, (place, mass, inertia) in enumerate(zip(places, MASS, INERTIA, strict=True), 1):
        motion = Motion(np.array([place]), still, still)
        body = RigidBody(mbs, Body(str(number), mass, inertia), motion)
        nodes.append(body.node)
        objects.append(body.number)

    def marker(body: int, point: tuple[float, float], kind: Any = MarkerBodyRigid) -> int:
        return int(mbs.AddMarker(kind(bodyNumber=objects[body], localPosition=[*point, 0.0])))

    for name, first, second in JOINTS:
        ends = [
            marker(body, POINTS[body][name] if body else FRAME[name]) for body in (first, second)
        ]
        mbs.AddObject(ObjectJointRevolute2D(markerNumbers=ends))
    mbs.AddObject(
        ObjectConnectorSpringDamper(
            markerNumbers=[
                marker(0, C, MarkerBodyPosition),
                marker(3, SPRING_END, MarkerBodyPosition),
            ],
            referenceLength=FREE_LENGTH,
            stiffness=STIFFNESS,
        )
    )
    mbs.AddLoad(LoadTorqueVector(markerNumber=marker(1, (0.0, 0.0)), loadVector=[0, 0, TORQUE]))
    mbs.Assemble()
    return mbs, nodes


def _start_places() -> list[list[float]]:
    """Return x, y and absolute angle of the seven bodies at rest, m and rad."""
    beta, theta, gamma, phi, delta, omega, epsilon = START
    angles = (beta, beta + theta, gamma, phi + delta, delta, omega + epsilon, epsilon)
    known: dict[str, tuple[float, float]] = dict(FRAME)
    places: dict[int, list[float]] = {}
    for body in (1, 2, 3, 5, 4, 7, 6):  # each hangs on a point that is known by then
        angle = angles[body - 1]
        name = next(name for name in POINTS[body] if name in known)
        along, across = _turned(POINTS[body][name], angle)
        x, y = known[name][0] - along, known[name][1] - across
        places[body] = [x, y, angle]
        for other, point in POINTS[body].items():
            along, across = _turned(point, angle)
            known.setdefault(other, (x + along, y + across))
    return [places[body] for body in range(1, 8)]


def _turned(point: tuple[float, float], angle: float) -> tuple[float, float]:
    c, s = cos(angle), sin(angle)
    return point[0] * c - point[1] * s, point[0] * s + point[1] * c


def _end_of(mbs: exu.MainSystem, nodes: list[int]) -> Trajectory:
    """Return the seven angles and rates at the end, (1, 7)."""
    angles, rates = (
        np.array([mbs.GetNodeOutput(node, kind)[-1] for node in nodes]) for kind in LEVELS
    )
    angles += [place[2] for place in _start_places()]
    end = np.array([DURATION])
    return Trajectory(end, _relative(angles)[None, :], _relative(rates)[None, :], end)


def _relative(absolute: Array) -> Array:
    """Return beta .. epsilon of the seven absolute angles, or their rates."""
    a = absolute
    return np.array([a[0], a[1] - a[0], a[2], a[3] - a[4], a[4], a[5] - a[6], a[6]])
