"""What every tuned number of the integration buys: each is halved and doubled, and rules are off.

For a set of systems, prints how much the error and the work change against the defaults. Error: of
the output's velocity over the whole run, against a tolerance a hundred times finer, over its
largest value. Work: Newton iterations, which no busy machine changes.
Run with: python scripts/ablation.py [--quick] [--tolerance 1e-3]
"""

import argparse
import dataclasses
import math
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context

import exudyn as exu
import exudyn.utilities as items
import numpy as np

from exu_press import Scene, SolverStatus, SolverTuning, solve_dynamic
from exu_press.mechanism.press import PAPER_LAWS
from exu_press.scene import flexible_press
from exudyn_examples.planar import rods

GRID = 4000  # instants at which runs are compared
FINER = 1e-2
BUDGET = 50_000  # steps; a variant that needs more counts as stopped

OFF = {
    "factor_max": 1e9,
    "beside_joints": 1.0,
    "penetration": 1e9,
    "modal_mass": 0.0,
    "refit": 0.0,
}
"""Numbers at which their rule does nothing."""


def scene(tolerance, tuning, **keys):
    """Time, output velocity, iterations and status of a scene."""
    model = Scene.from_dict(
        {**keys, "solver": {"tolerance": tolerance, "max_steps": BUDGET}}
    ).build()
    try:
        outcome = model.solve(tuning=tuning)
        sensor = model.sensors[model.mechanism.slider, "velocity"]
        record = np.array(model.mbs.GetSensorStoredData(sensor))
    finally:
        model.SC.Reset()
    moving = 1 + int(np.argmax(np.abs(record[:, 1:]).max(axis=0)))
    return record[:, 0], record[:, moving], outcome


def system(tolerance, tuning, *, build, end):
    """The same of an Exudyn system: of its last body's last coordinate."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    node = build(mbs)
    sensor = mbs.AddSensor(
        items.SensorNode(
            nodeNumber=node,
            storeInternal=True,
            outputVariableType=exu.OutputVariableType.Coordinates_t,
        )
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = end
    settings.solution.file.write, settings.solution.sensors.writePeriod = False, 0.0
    outcome = solve_dynamic(mbs, settings, tolerance=tolerance, tuning=tuning, max_steps=BUDGET)
    record = np.array(mbs.GetSensorStoredData(sensor))
    container.Reset()
    return record[:, 0], record[:, -1], outcome


def pendulum(mbs, links=1):
    """Rods of a metre that hang on each other, let go while horizontal."""
    _, _, nodes, _ = rods(mbs, [1.0] * links)
    return nodes[-1]


def spring(mbs):
    """A mass on a stiff, lightly damped spring, moved by a soft one."""
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], initialVelocities=[1.0]))
    mbs.AddObject(items.ObjectMass1D(mass=1.0, nodeNumber=node))
    still = mbs.AddNode(items.NodePointGround())
    markers = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
        for number in (still, node)
    ]
    mbs.AddObject(
        items.ObjectConnectorCoordinateSpringDamper(
            markerNumbers=markers, stiffness=1e4, damping=1.0
        )
    )
    return node


DRY = {"crank_pin": "dry", "balls": "dry"}
SYSTEMS: dict[str, Callable] = {
    "press ideal": partial(scene, joints={}, revolutions=0.5),
    "press lubricated": partial(scene, revolutions=0.15),
    "press dry": partial(scene, joints=DRY, revolutions=0.15),
    "press flexible": partial(scene, bodies=flexible_press(modes=8), revolutions=0.12),
    "slider-crank dry": partial(
        scene,
        mechanism="slider_crank",
        joints={"crank_pin": "dry"},
        revolutions=0.15,
        contact=PAPER_LAWS["contact"],
        friction=PAPER_LAWS["friction"],
    ),
    "four-bar lubricated": partial(
        scene,
        mechanism="four_bar",
        joints={"crank_pin": {"kind": "lubricated", "clearance": 1e-4, "radius": 0.07}},
        film={"viscosity": 0.4, "length": 0.1},
        revolutions=0.2,
    ),
    "pendulum": partial(system, build=pendulum, end=3.0),
    "triple pendulum": partial(system, build=partial(pendulum, links=3), end=1.0),
    "spring": partial(system, build=spring, end=0.5),
}


def error_of(run, reference):
    """Largest difference of the outputs over the common time, over the largest output."""
    (time, values, outcome), (fine_time, fine, _) = run, reference
    if outcome.status not in (SolverStatus.COMPLETED, SolverStatus.UNDER_RESOLVED):
        return math.inf
    grid = np.linspace(0.0, fine_time[-1], GRID)
    difference = np.interp(grid, time, values) - np.interp(grid, fine_time, fine)
    return float(np.abs(difference).max() / np.abs(fine).max())


def variants():
    """Name and numbers of every variant."""
    defaults = SolverTuning()
    for field in dataclasses.fields(SolverTuning):
        value = getattr(defaults, field.name)
        for word, factor in (("half", 0.5), ("double", 2.0)):
            changed = type(value)(value * factor)
            if field.name == "factor_max":
                changed = 1.0 + (value - 1.0) * factor
            yield f"{field.name} {word}", {field.name: changed}
        if field.name in OFF:
            yield f"{field.name} off", {field.name: OFF[field.name]}


def main():
    """Print the table, a row a variant: error and work over those of the defaults."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="two systems, four variants")
    parser.add_argument("--tolerance", type=float, default=1e-3)
    options = parser.parse_args()
    systems = dict(list(SYSTEMS.items())[:: 5 if options.quick else 1])
    chosen = list(variants())[:4] if options.quick else list(variants())
    width = max(len(name) for name, _ in chosen) + 2
    defaults = SolverTuning()
    references, usual = {}, {}
    for name, run in systems.items():
        references[name] = run(FINER * options.tolerance, defaults)
        usual[name] = run(options.tolerance, defaults)
    print(f"tolerance {options.tolerance:g}; error | work, over those of the defaults")
    print(" " * width + "".join(f"{name:>21}" for name in systems))
    cells = [
        f"{error_of(usual[name], references[name]):.1e} | {usual[name][2].newton_iterations}"
        for name in systems
    ]
    print(f"{'defaults':{width}}" + "".join(f"{cell:>21}" for cell in cells))

    tried = partial(row, systems=tuple(systems), references=references, usual=usual)
    tolerances = [options.tolerance] * len(chosen)
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        for (label, _), cells in zip(chosen, pool.map(tried, chosen, tolerances), strict=True):
            print(f"{label:{width}}" + "".join(f"{cell:>21}" for cell in cells), flush=True)


def row(variant, tolerance, *, systems, references, usual):
    """Return a variant's cells."""
    numbers = variant[1]
    cells = []
    for name in systems:
        tried = SYSTEMS[name](tolerance, SolverTuning(**numbers))
        before = error_of(usual[name], references[name])
        work = tried[2].newton_iterations / usual[name][2].newton_iterations
        error = error_of(tried, references[name])
        cells.append("stopped" if error == math.inf else f"{error / before:.2f} | {work:.2f}")
    return cells


if __name__ == "__main__":
    main()
