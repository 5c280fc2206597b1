"""Masses and springs against SciPy's motions: errors stay within some tolerances."""

from dataclasses import dataclass, field

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from exu_press import solve_dynamic


@dataclass
class Chain:
    """Masses in a row, each on a spring and a damper to the one before, the first to the ground."""

    masses: list
    stiffness: list
    damping: list
    places: list
    speeds: list
    duration: float
    force: object = None  # on the last one, N, of the time, s
    corners: list = field(default_factory=list)  # of the force, s
    steps: int = 100
    turning: bool = False  # inertias that turn


def sine(frequency):
    return lambda time: np.sin(frequency * time)


CHAINS = {
    "a vibration from rest": Chain([1.0], [100.0], [0.0], [0.1], [0.0], 40.0),
    "one as fast at the start": Chain([1.0], [100.0], [0.0], [0.0], [1.0], 30.0),
    "in a single step": Chain([1.0], [100.0], [0.0], [0.1], [0.0], 20.0, steps=1),
    "in a thousand steps": Chain([1.0], [100.0], [0.0], [0.1], [0.0], 20.0, steps=1000),
    "damped": Chain([1.0], [100.0], [1.0], [0.1], [0.0], 30.0),
    "overdamped": Chain([1.0], [100.0], [200.0], [0.1], [0.0], 10.0),
    "stiff": Chain([1.0], [100.0], [1e4], [0.1], [1.0], 10.0),
    "five masses": Chain([1.0] * 5, [100.0] * 5, [0.0] * 5, [0.0] * 4 + [0.1], [0.0] * 5, 10.0),
    "a light one": Chain([1.0, 0.01], [100.0, 1e4], [0.0, 0.1], [0.1, 0.1], [0.0] * 2, 5.0),
    "forced": Chain([1.0], [100.0], [0.5], [0.0], [0.0], 10.0, sine(3.0)),
    "in resonance": Chain([1.0], [100.0], [0.5], [0.0], [0.0], 10.0, sine(10.0)),
    "a chirp": Chain([1.0], [100.0], [0.5], [0.0], [0.0], 6.0, lambda t: np.sin(2.0 * t * t)),
    "a late start": Chain(
        [1.0], [100.0], [1.0], [0.0], [0.0], 10.0, lambda t: max(0, t - 5.0) ** 3
    ),
    "a step": Chain([1.0], [100.0], [1.0], [0.0], [0.0], 10.0, lambda t: float(t > 5.37), [5.37]),
    "a shaft": Chain(
        [2.0] * 3, [500.0] * 3, [0.0] * 3, [0.2, 0.4, 0.6], [0.0] * 3, 5.0, turning=True
    ),
    "unstable": Chain([1.0], [-4.0], [0.0], [1e-4], [0.0], 5.0),
}


def ends(chain, tolerance):
    """Velocities at the end."""
    mbs = exu.SystemContainer().AddSystem()
    before = mbs.AddMarker(
        items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0)
    )
    for mass, stiffness, damping, place, speed in zip(
        chain.masses, chain.stiffness, chain.damping, chain.places, chain.speeds, strict=True
    ):
        node = mbs.AddNode(
            items.Node1D(
                referenceCoordinates=[0.0], initialCoordinates=[place], initialVelocities=[speed]
            )
        )
        if chain.turning:
            mbs.AddObject(items.ObjectRotationalMass1D(nodeNumber=node, inertia=mass))
        else:
            mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=mass))
        here = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))
        mbs.AddObject(
            items.ObjectConnectorCoordinateSpringDamper(
                markerNumbers=[before, here], stiffness=stiffness, damping=damping
            )
        )
        before = here
    if chain.force is not None:
        load = items.LoadCoordinate(
            markerNumber=before, load=1.0, loadUserFunction=lambda _mbs, t, _load: chain.force(t)
        )
        mbs.AddLoad(load)
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = chain.duration
    settings.timeIntegration.numberOfSteps = chain.steps
    settings.solution.file.write = False
    solve_dynamic(mbs, settings, tolerance=tolerance).check()
    return np.array(mbs.systemData.GetODE2Coordinates_t())


def exact(chain):
    """Velocities at the end, and the largest so far."""
    count = len(chain.masses)
    matrices = []
    for values in (chain.stiffness, chain.damping):
        stretched = np.eye(count) - np.eye(count, k=-1)
        matrices.append(stretched.T @ np.diag(values) @ stretched)

    def rates(time, state):
        forces = -matrices[0] @ state[:count] - matrices[1] @ state[count:]
        forces[-1] += chain.force(time) if chain.force else 0.0
        return np.concatenate([state[count:], forces / chain.masses])

    state, begin, fastest = np.array([*chain.places, *chain.speeds]), 0.0, 0.0
    for end in (*chain.corners, chain.duration):
        found = solve_ivp(rates, (begin, end), state, "LSODA", rtol=1e-10, atol=1e-14)
        state, begin = found.y[:, -1], end
        fastest = max(fastest, np.abs(found.y[count:]).max())
    return state[count:], fastest


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
@pytest.mark.parametrize("name", CHAINS)
def test_the_error_is_some_tolerances(name, tolerance):
    """A vibration from rest was 450 tolerances off in one largest step: its scale was too large.

    And the rotors of a shaft that have not begun to turn made each first step too long.
    """
    chain = CHAINS[name]
    expected, fastest = exact(chain)
    assert np.abs(ends(chain, tolerance) - expected).max() < 10.0 * tolerance * fastest
