"""How far a run is off a finer one, over the scale that `solve_dynamic` itself uses."""

import itertools
import time as clock
from dataclasses import dataclass

import exudyn as exu
import numpy as np
from scipy.interpolate import CubicHermiteSpline

from exu_press import solve_dynamic
from exu_press.integrate.scales import kinetic_weights
from exu_press.integrate.system import System

__all__ = ["Run", "at_equal_error", "error", "run"]

CURRENT = exu.ConfigurationType.Current


@dataclass
class Run:
    """What a run went through: at each of its instants, velocities, accelerations, first-order."""

    time: np.ndarray
    states: list[np.ndarray]  # positions, velocities, accelerations, first-order and their rates
    weight: np.ndarray  # of coordinates, to a body's kinetic norm: sqrt(inertia / mass)
    body: np.ndarray  # of each coordinate
    steps: int
    rejected: int
    seconds: float  # of processor time, of the integration
    outcome: object


def run(example, *, tolerance=None, steps=None, end=None, record=True):
    """Solve an example to a tolerance, or with fixed steps by Exudyn alone."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    example.build(mbs)
    own = mbs.GetPostStepUserFunction()
    own = own["function"] if isinstance(own, dict) else None
    times, rows = [], []

    def keep(mbs, time):
        data = mbs.systemData
        if times and time <= times[-1]:
            return True
        times.append(time)
        rows.append(
            [
                np.array(part(CURRENT))
                for part in (
                    data.GetODE2CoordinatesTotal,
                    data.GetODE2Coordinates_t,
                    data.GetODE2Coordinates_tt,
                    data.GetODE1Coordinates,
                    data.GetODE1Coordinates_t,
                )
            ]
        )
        return own(mbs, time) if own else True

    if record:
        mbs.SetPostStepUserFunction(keep)
    mbs.Assemble()
    settings = example.settings(end or example.end, steps)
    begun = clock.process_time()
    if steps is None:
        outcome = solve_dynamic(mbs, settings, tolerance=tolerance)
        count, rejected = outcome.steps, outcome.rejected_steps
    else:
        outcome = mbs.SolveDynamic(settings)
        count, rejected = len(times) - 1, 0
    seconds = clock.process_time() - begun
    weight, body = _weights(mbs)
    container.Reset()
    states = [np.array([row[i] for row in rows]) for i in range(5)]
    return Run(np.array(times), states, weight, body, count, rejected, seconds, outcome)


def _weights(mbs):
    """Weight and body of each coordinate, from the mass matrix."""
    system = System.of(mbs)
    if not system.nodes:
        return np.zeros(0), np.zeros(0, int)
    inertias, masses = kinetic_weights(system.nodes, mbs.sys["dynamicSolver"].GetSystemMassMatrix())
    sizes = [node.size for node in system.nodes]
    body = np.repeat(np.arange(len(sizes)), sizes)
    mass = np.array(masses)[body]
    mass[mass == 0.0] = np.nan  # no displacements: its own largest energy is the scale
    return np.sqrt(np.array(inertias) / mass), body


def error(one, fine, positions=False):
    """Largest error of any body's velocity in the kinetic norm, over the largest speed.

    Or of its position, over the longest way.

    First-order coordinates: over each one's largest value. Angles and modes that belong to no mass:
    over their largest velocity.
    """
    found = 0.0
    level = 0 if positions else 1
    fine_v, fine_a = fine.states[level] - fine.states[level][0] * positions, fine.states[level + 1]
    fine_y, fine_rate = fine.states[3:]
    time = np.clip(one.time, fine.time[0], fine.time[-1])
    if len(fine.weight):
        there = CubicHermiteSpline(fine.time, fine_v, fine_a)(time)
        missed = one.states[level] - fine.states[level][0] * positions - there
        owned = ~np.isnan(fine.weight)
        weight = np.where(owned, fine.weight, 0.0)

        def norms(values):
            squares = (weight * values) ** 2
            return np.sqrt(
                np.stack([squares[:, fine.body == b].sum(axis=1) for b in np.unique(fine.body)])
            )

        scale = norms(fine_v).max()
        if scale > 0.0:
            found = norms(missed).max() / scale
        for i in np.flatnonzero(~owned):
            found = max(found, np.abs(missed[:, i]).max() / np.abs(fine_v[:, i]).max())
    if fine_y.shape[1]:
        missed = one.states[3] - CubicHermiteSpline(fine.time, fine_y, fine_rate)(time)
        found = max(found, (np.abs(missed).max(axis=0) / np.abs(fine_y).max(axis=0)).max())
    return found


def at_equal_error(found, missed):
    """Run time with fixed steps at an error, between those that were run; nan beyond them.

    `found` has errors and run times, from coarse to fine.
    """
    for (coarse, short), (fine, long) in itertools.pairwise(found):
        if fine <= missed <= coarse:
            part = np.log(coarse / missed) / np.log(coarse / fine) if fine < coarse else 0.0
            return short * (long / short) ** part
    return found[0][1] if found and missed >= found[0][0] else np.nan
