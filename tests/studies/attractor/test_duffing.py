"""Duffing's equation after Ueda, solved by the engine of the presses, against its tangent."""

import math

import exudyn as exu
import numpy as np
import pytest
from exudyn.itemInterface import NodeGenericODE2, ObjectGenericODE2
from scipy.integrate import solve_ivp

from exu_press.integrate import solve_dynamic
from exu_press.studies.attractor.lyapunov import combine_exponents

DAMPING, FORCE = 0.05, 7.5
"""Y. Ueda, J. Stat. Phys. 20 (1979) 181-196."""

ERROR = 1e-4
"""Tolerance, and bound of a point's error."""


def advanced(state):
    """Return Duffing's state a period later."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    node = mbs.AddNode(
        NodeGenericODE2(
            referenceCoordinates=[0.0],
            initialCoordinates=[float(state[0])],
            initialCoordinates_t=[float(state[1])],
            numberOfODE2Coordinates=1,
        )
    )
    mbs.AddObject(
        ObjectGenericODE2(
            nodeNumbers=[node],
            massMatrix=np.eye(1),
            stiffnessMatrix=np.zeros((1, 1)),
            dampingMatrix=DAMPING * np.eye(1),
            forceVector=[0.0],
            forceUserFunction=lambda mbs, t, item, q, q_t: [FORCE * math.cos(t) - q[0] ** 3],
        )
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = 2.0 * math.pi
    settings.timeIntegration.numberOfSteps = 60
    settings.solution.file.write = False
    solve_dynamic(mbs, settings, tolerance=ERROR).check()
    data = mbs.systemData
    found = np.array([data.GetODE2Coordinates()[0], data.GetODE2Coordinates_t()[0]])
    container.Reset()
    return found


def tangent_exponent(periods, skip=20):
    """Return the exponent per period from the linearised equation: another method, another code."""

    def right(t, s):
        x, v, a, b = s
        force = FORCE * math.cos(t) - DAMPING * v - x**3
        return [v, force, b, -DAMPING * b - 3.0 * x * x * a]

    state, total = np.array([2.5, 0.0, 1.0, 0.0]), 0.0
    for period in range(periods + skip):
        solved = solve_ivp(right, (0.0, 2.0 * math.pi), state, "LSODA", rtol=1e-8, atol=1e-10)
        state = solved.y[:, -1]
        growth = float(np.hypot(*state[2:]))
        state[2:] /= growth
        total += math.log(growth) if period >= skip else 0.0
    return total / periods


def engine_exponent():
    """The exponent from neighbours over 80 periods, by the engine."""
    distances = (1e-2, 3e-2)
    x = np.array([2.5, 0.0])
    for _ in range(20):
        x = advanced(x)
    near = [x + np.array([d, 0.0]) for d in distances]
    growths = [[] for _ in distances]
    for _ in range(81):
        x = advanced(x)
        for i, d in enumerate(distances):
            gone = advanced(near[i]) - x
            apart = float(np.linalg.norm(gone))
            growths[i].append(math.log(apart / d))
            near[i] = x + gone * d / apart
    errors = [math.log1p(2.0 * ERROR / d) for d in distances]
    return combine_exponents([np.array(each[1:]) for each in growths], distances, ERROR, errors)


@pytest.mark.validation(
    "independent",
    "Ueda's chaotic oscillator",
    "its linearised equation, integrated by SciPy's LSODA over 600 periods",
    "this package's",
)
@pytest.mark.long
def test_the_interval_holds_the_exponent_of_the_tangent(compare):
    exponent = engine_exponent()
    half = 0.5 * (exponent.high - exponent.low)
    middle = 0.5 * (exponent.high + exponent.low)
    name = "largest Lyapunov exponent per period, from neighbours over 80 periods"
    compare(name, tangent_exponent(600), middle, error=half, abs=half)
    assert exponent.sign == "chaotic"
