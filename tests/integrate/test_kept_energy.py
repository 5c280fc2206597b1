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
    nothing = lambda self, step, q, v, *rest: np.zeros((2, len(v)))  # noqa: E731
    monkeypatch.setattr(KeptEnergy, "per_square", nothing)


@PATCHED
@pytest.mark.parametrize("count", [1, 2])
def test_energy_drifts_by_less_than_half(count, monkeypatch):
    steps, off = swung(count)
    left_out(monkeypatch)
    steps_without, off_without = swung(count)
    assert steps < 1.05 * steps_without
    assert off < 0.5 * off_without


def swung_in_space(duration=40.0):
    """Return the steps of a bar of 1 m on an axis askew, and what its energy loses or gains, J/kg.

    It is let go level.
    """
    mbs = exu.SystemContainer().AddSystem()
    axis, along = np.array([2.0, 1.0, 2.0]) / 3.0, np.array([1.0, -2.0, 0.0]) / np.sqrt(5.0)
    body = mbs.CreateRigidBody(
        inertia=eu.InertiaCuboid(density=1000.0, sideLengths=[1.0, 0.1, 0.1]),
        referencePosition=0.5 * along,
        referenceRotationMatrix=np.array([along, np.cross(axis, along), axis]).T,
        gravity=[0.0, 0.0, -GRAVITY],
    )
    ground = mbs.CreateGround()
    mbs.CreateRevoluteJoint(itemNumbers=[ground, body], position=[0.0, 0.0, 0.0], axis=axis)
    mbs.Assemble()
    found = []

    def energy(mbs, time):
        kind = exu.OutputVariableType
        speed = mbs.GetObjectOutputBody(body, kind.Velocity, [0.0, 0.0, 0.0])
        place = mbs.GetObjectOutputBody(body, kind.Position, [0.0, 0.0, 0.0])
        turning = 1.01 / 12.0 / 0.5**2  # of the inertia about its middle, over the mass
        found.append((time, 0.5 * (1.0 + turning) * speed @ speed + GRAVITY * place[2]))
        return True

    mbs.SetPostStepUserFunction(energy)
    steps = solve_dynamic(mbs, settings(duration, 100), tolerance=1e-3).check().steps
    late = np.linspace(duration - SWING, duration, 200)
    return steps, abs(np.interp(late, *np.array(found).T).mean())


@PATCHED
def test_a_bar_that_swings_in_space_keeps_its_energy(monkeypatch):
    steps, off = swung_in_space()
    left_out(monkeypatch)
    steps_without, off_without = swung_in_space()
    assert steps < 1.05 * steps_without
    assert off < 0.5 * off_without


def test_a_rotor_that_turns_steadily_keeps_its_speed():
    """All its accelerations are those of constraints; counted from nothing, it lost 2e-3 rad/s."""
    mbs = exu.SystemContainer().AddSystem()
    body = mbs.CreateRigidBody(
        inertia=eu.InertiaCuboid(density=1000.0, sideLengths=[0.3, 0.2, 0.1]),
        initialAngularVelocity=[0.0, 0.0, 30.0],
    )
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(2.0, 20)).check()
    assert outcome.steps > 100, "in steps that change"
    kind = exu.OutputVariableType.AngularVelocity
    speed = mbs.GetObjectOutputBody(body, kind, [0.0, 0.0, 0.0])[2]
    assert speed == pytest.approx(30.0, abs=1e-4)
