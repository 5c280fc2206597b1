"""Do the errors that runs state of their sensors cover the true ones? On systems by chance.

`solve_dynamic(errors=True)` at 1e-3, against a run at 4e-6, whose own error another one at 1e-5
tells. Sensors: velocities of all nodes, forces of all springs and joints, 500 rows each. What
counts is off by ten times what the references are off by, and by a millionth of the largest value.
Run with: python scripts/sensor_errors.py [--seeds 340 510]
"""

import argparse
import warnings

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exu_press import solve_dynamic
from exudyn_models.table import CLEAR
from random_systems import settings_of, system

TOLERANCE, FINE, NEARLY_AS_FINE = 1e-3, 4e-6, 1e-5
STEPS, ROWS, BUDGET = 100, 500, 200_000
NOTHING = 1e-6
"""Of the largest value, below which an error is none."""

FORCES = {
    "ForceLocal": ("JointGeneric", "Prismatic", "RevoluteZ", "RollingDisc", "RigidBodySpring"),
    "Force": ("JointSpherical", "JointRevolute2D", "SpringDamper", "ConnectorCoordinate"),
}


def observe(mbs):
    """Add sensors of all velocities and forces."""
    kept = {"storeInternal": True, "writeToFile": False}
    for number in range(mbs.systemData.NumberOfNodes()):
        kind = mbs.GetNode(number)["nodeType"]
        if "Ground" in kind or "Data" in kind:
            continue
        velocity = "Velocity" if "RigidBody" in kind else "Coordinates_t"
        what = getattr(exu.OutputVariableType, velocity)
        mbs.AddSensor(items.SensorNode(nodeNumber=number, outputVariableType=what, **kept))
    for number in range(mbs.systemData.NumberOfObjects()):
        kind = mbs.GetObject(number)["objectType"]
        for force, kinds in FORCES.items():
            if any(name in kind for name in kinds):
                what = getattr(exu.OutputVariableType, force)
                sensor = items.SensorObject(objectNumber=number, outputVariableType=what, **kept)
                mbs.AddSensor(sensor)
                break


def run(seed, tolerance, errors=False):
    """Return how a system's run ended, and its sensors' rows without the time."""
    by = system(seed)
    mbs, settings = by.mbs, settings_of(by)
    observe(mbs)
    mbs.Assemble()
    integration = settings.timeIntegration
    period = integration.endTime / integration.numberOfSteps
    integration.numberOfSteps = STEPS
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = integration.endTime / ROWS
    outcome = solve_dynamic(
        mbs, settings, tolerance=tolerance, sample=period, errors=errors, max_steps=BUDGET
    )
    count = mbs.systemData.NumberOfSensors()
    rows = [np.array(mbs.GetSensorStoredData(number))[:, 1:] for number in range(count)]
    return outcome, rows


def pairs(seed):
    """Yield true and stated errors of each sensor's values: those of rows and those of peaks."""
    outcome, rows = run(seed, TOLERANCE, errors=True)
    if outcome.error is None or outcome.error.reason:
        return
    references = [run(seed, tolerance) for tolerance in (FINE, NEARLY_AS_FINE)]
    if not all(reference.status.ended for reference, _ in references):
        return
    error = outcome.error
    stated = zip(error.sensors, error.peaks, strict=True)
    for ours, fine, other, said in zip(rows, *(r for _, r in references), stated, strict=True):
        size, both = np.abs(fine).max(axis=0), []
        for found, measure in zip(said, (worst_row, peak), strict=True):
            true, own = measure(ours, fine), measure(other, fine)
            known = (own <= CLEAR * true) & (true > NOTHING * size)
            both.append((true[known], found[known]))
        yield both


def worst_row(one, other):
    """By how much two runs differ in a row."""
    return np.abs(one - other).max(axis=0)


def peak(one, other):
    """By how much the largest magnitudes of two runs differ."""
    return np.abs(np.abs(one).max(axis=0) - np.abs(other).max(axis=0))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, nargs=2, default=(340, 510))
    warnings.simplefilter("ignore")
    found = [pair for seed in range(*parser.parse_args().seeds) for pair in pairs(seed)]
    print("of sensors in systems by chance; stated over true: median; least of 99, of 95 %")
    for name, chosen in zip(("worst row", "peak"), zip(*found, strict=True), strict=True):
        true, stated = (np.concatenate(part) for part in zip(*chosen, strict=True))
        ratio = stated / true
        least = np.percentile(ratio, [50, 1, 5])
        print(
            f"{name}: {np.sum(ratio >= 1.0)} of {len(ratio)} covered; "
            f"{least[0]:.2g}; {least[1]:.2g}, {least[2]:.2g}"
        )


if __name__ == "__main__":
    main()
