"""Changes of the step hand over the energy that the method's error holds."""

import exudyn as exu
import exudyn.utilities as eu
import numpy as np
import pytest
from patched import PATCHED

from exu_press.integrate import solve_dynamic
from exu_press.integrate.kept_energy import KeptEnergy
from exudyn_examples.example import GRAVITY
from exudyn_examples.planar import bar, pin

SWING = 2.0  # s


def links(count):
    """Return a pendulum of rods, 1 m and 1 kg each, that hang on each other, level at the start."""
    mbs = exu.SystemContainer().AddSystem()
    before, place = mbs.AddObject(eu.ObjectGround()), (0.0, 0.0)
    for i in range(count):
        body, half, _ = bar(mbs, (i, 0.0), (i + 1.0, 0.0), 1.0)
        pin(mbs, before, place, body, (-half, 0.0))
        before, place = body, (half, 0.0)
    mbs.Assemble()
    return mbs


def settings(duration, steps):
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime = duration
    chosen.timeIntegration.numberOfSteps = steps
    chosen.solution.file.write = False
    return chosen


def swung(count, tolerance=3e-4, duration=8.0):
    """Return the steps of such a pendulum, and how far its energy is off at the end, J."""
    mbs, found = links(count), []

    def energy(mbs, time):
        speeds = np.array(mbs.systemData.GetODE2Coordinates_t()).reshape(-1, 3)
        places = np.array(mbs.systemData.GetODE2Coordinates()).reshape(-1, 3)
        kinetic = 0.5 * (speeds**2 @ [1.0, 1.0, 1.0 / 12.0]).sum()
        found.append((time, kinetic + GRAVITY * places[:, 1].sum()))
        return True

    mbs.SetPostStepUserFunction(energy)
    outcome = solve_dynamic(mbs, settings(duration, 100), tolerance=tolerance).check()
    late = np.linspace(duration - SWING, duration, 200)
    return outcome.steps, abs(np.interp(late, *np.array(found).T).mean())


def left_out(monkeypatch):
    monkeypatch.setattr(KeptEnergy, "per_square", lambda self, step, v, *rest: np.zeros(len(v)))


@PATCHED
@pytest.mark.parametrize("count", [1, 2])
def test_energy_drifts_by_less_than_half(count, monkeypatch):
    steps, off = swung(count)
    left_out(monkeypatch)
    steps_without, off_without = swung(count)
    assert steps < 1.05 * steps_without
    assert off < 0.5 * off_without


def tumbled():
    """Return where a body ends that tumbles freely in space, and in how many steps."""
    mbs = exu.SystemContainer().AddSystem()
    mbs.CreateRigidBody(
        inertia=eu.InertiaCuboid(density=1000.0, sideLengths=[0.3, 0.2, 0.1]),
        initialAngularVelocity=[3.0, 2.0, 1.0],
    )
    mbs.Assemble()
    steps = solve_dynamic(mbs, settings(2.0, 20)).check().steps
    return steps, list(mbs.systemData.GetODE2Coordinates())


@PATCHED
def test_rotations_in_space_are_left_as_they_are(monkeypatch):
    found = tumbled()
    left_out(monkeypatch)
    assert tumbled() == found
