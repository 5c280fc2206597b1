"""What clearance joints cost: time per step against the same mechanism with ideal joints.

Prints medians over alternating repeats; all rows of one mechanism have the same solver settings.
Run with: python scripts/benchmark_joint_cost.py [--quick]
"""

import argparse
import math
import statistics
import time

import exudyn as exu
import exudyn.utilities as items
import numpy as np
from exudyn.itemInterface import (
    MarkerBodyRigid,
    ObjectConnectorRigidBodySpringDamper,
    ObjectGround,
)

from exu_press import Scene, add_lubricated_revolute
from exu_press.integrate import ErrorScales, SolverStatus, SolverTuning
from exu_press.integrate.system import System
from exu_press.integrate.task import Task, prepared_settings
from exu_press.joints import COMPILED
from exu_press.laws.film import film_scale, pinkus
from exu_press.model.settings import settings_for

STEP = 1e-5  # s
PRESS = {
    "press, ideal joints": ("ideal", "ideal"),
    "press, lubricated pin, dry balls": ("lubricated", "dry"),
    "press, dry pin, dry balls": ("dry", "dry"),
}
BODIES, LENGTH, MASS = 10, 0.2, 1.0  # of the chain; m, kg
BEARING = {"radius": 0.02, "clearance": 5e-5, "length": 0.08, "viscosity": 0.4}  # m, Pa s


def bar(mbs, start, end, mass):
    """A uniform bar between two points of the drawing: its body, half its length, its node."""
    (x0, y0), (x1, y1) = start, end
    half, angle = 0.5 * np.hypot(x1 - x0, y1 - y0), np.arctan2(y1 - y0, x1 - x0)
    middle = [0.5 * (x0 + x1), 0.5 * (y0 + y1), angle]
    node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=middle))
    inertia = mass * (2.0 * half) ** 2 / 12.0
    body = mbs.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=mass, inertia=inertia))
    centre = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=body))
    mbs.AddLoad(items.LoadMassProportional(markerNumber=centre, loadVector=[0.0, -9.81, 0.0]))
    return body, half, node


def pin(mbs, journal, at_journal, bearing, at_bearing):
    """A revolute joint between points of two bodies."""
    markers = [
        mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[*at, 0.0]))
        for body, at in ((journal, at_journal), (bearing, at_bearing))
    ]
    return mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=markers))


def run_press(joints, steps):
    """Time per step (us) and Newton iterations per step of a press from top dead centre on."""
    pin, balls = joints
    revolutions = steps * STEP * 240.0 / 60.0
    scene = {
        "joints": {"crank_pin": pin, "balls": balls},
        "revolutions": revolutions,
        "solver": {"step": STEP},
    }
    outcome = Scene.from_dict(scene).build().solve()
    assert outcome.status is SolverStatus.COMPLETED, outcome
    steps = outcome.steps  # a film begins with a few shorter ones
    return outcome.wall_time / steps * 1e6, outcome.newton_iterations / steps


def run_chain(add_joint, steps):
    """The same of a chain that hangs from the ground at one end, let go while horizontal."""
    mbs = exu.SystemContainer().AddSystem()
    previous, end = mbs.AddObject(ObjectGround()), (0.0, 0.0, 0.0)
    for i in range(BODIES):
        body, half, _ = bar(mbs, (LENGTH * i, 0.0), (LENGTH * (i + 1), 0.0), MASS)
        add_joint(mbs, (body, (-half, 0.0, 0.0)), (previous, end))
        previous, end = body, (half, 0.0, 0.0)
    mbs.Assemble()
    settings = settings_for(Scene.from_dict({"solver": {"step": STEP}}))
    settings.timeIntegration.endTime, settings.timeIntegration.numberOfSteps = steps * STEP, steps
    # accelerations to 1e-4 of gravity's, as a scene with fixed steps has them
    settings.timeIntegration.newton.absoluteTolerance = 1e-4 * BODIES * MASS * 9.81
    task = Task(System.of_mbs(mbs), settings, None, ErrorScales(), SolverTuning())
    task.smallest = STEP / 1024
    start = time.perf_counter()
    with prepared_settings(settings, task):
        mbs.SolveDynamic(settings, showHints=False)
    wall_time = time.perf_counter() - start
    solver = mbs.sys["dynamicSolver"]
    return wall_time / steps * 1e6, solver.it.newtonStepsCount / steps


def ideal(mbs, journal, bearing):
    pin(mbs, bearing[0], bearing[1][:2], journal[0], journal[1][:2])


def oiled_joint(mbs, journal, bearing):
    add_lubricated_revolute(mbs, journal, bearing, **BEARING, law=pinkus())


def by_user_function(mbs, journal, bearing):
    """The same film in Exudyn's own connector.

    In the bearing's frame, where omega_B = 0; the connector leaves the part omega_B x e out of the
    velocities it hands over, so that this film is a little off.
    """
    scale, c, law = film_scale(**BEARING), BEARING["clearance"], pinkus()

    def force(mbs, t, item, shift, rotation, velocity, spin, *rest):
        (x, y, _), (u, v, _), omega = shift, velocity, spin[2]
        e = math.hypot(x, y)
        n_x, n_y = (x / e, y / e) if e > 0.0 else (1.0, 0.0)
        e_dot, v_t = u * n_x + v * n_y, v * n_x - u * n_y
        f_r, f_t, *_ = law(e / c, e_dot / c, (e * omega - 2.0 * v_t) / c)
        f_x, f_y = scale * (f_r * n_x - f_t * n_y), scale * (f_r * n_y + f_t * n_x)
        return [-f_x, -f_y, 0.0, 0.0, 0.0, 0.5 * e * scale * f_t]

    markers = [
        mbs.AddMarker(MarkerBodyRigid(bodyNumber=body, localPosition=point))
        for body, point in (bearing, journal)
    ]
    mbs.AddObject(
        ObjectConnectorRigidBodySpringDamper(
            markerNumbers=markers,
            stiffness=np.zeros((6, 6)),
            damping=np.zeros((6, 6)),
            springForceTorqueUserFunction=force,
        )
    )


CHAIN = {
    "chain, ideal joints": ideal,
    "chain, ten lubricated joints": oiled_joint,
    "chain, user functions": by_user_function,
}


def medians(run, variants, steps, repeats):
    """Print a line for each variant; the first one is the ideal twin of all."""
    run(next(iter(variants.values())), 10)  # warm up
    costs = {name: [] for name in variants}
    for _ in range(repeats):
        for name, variant in variants.items():
            few = steps // 10 if name.endswith("user functions") else steps
            costs[name].append(run(variant, few))
    twin = [cost[0] for cost in next(iter(costs.values()))]
    for name, runs in costs.items():
        per_step, iterations = (statistics.median(column) for column in zip(*runs, strict=True))
        ratio = statistics.median(cost[0] / ideal for cost, ideal in zip(runs, twin, strict=True))
        print(f"{name:34}{per_step:10.1f}{iterations:12.2f}{ratio:10.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="few steps, to see that it runs")
    quick = parser.parse_args().quick
    steps, repeats = (100, 1) if quick else (2500, 7)
    exu.config.printToConsole = False
    name = f"joints {'compiled' if COMPILED else 'in Python'}"
    print(f"{name:34}{'us/step':>10}{'Newton/step':>12}{'ratio':>10}")
    medians(run_press, PRESS, steps, repeats)
    medians(run_chain, CHAIN, steps, repeats)


if __name__ == "__main__":
    main()
