"""Run one script of Exudyn's up to the end of its first dynamic solution, and keep what it did.

A process of its own, as scripts print, open windows, crash and hang:
python scripts/exudyn_models/one_run.py SCRIPT VARIANT FILE, with the scripts' folder in PYTHONPATH
and VARIANT as JSON:
`tolerance` and `steps` (of the settings, at most), or `times`, by which the user's own steps are
made finer.
"""

import builtins
import contextlib
import json
import math
import os
import random
import resource
import runpy
import sys
import time as clock
from pathlib import Path

import exudyn as exu
import exudyn.advancedUtilities
import exudyn.basicUtilities
import exudyn.beams
import exudyn.graphicsDataUtilities
import exudyn.itemInterface
import exudyn.plot
import exudyn.processing
import exudyn.rigidBodyUtilities
import exudyn.solver
import exudyn.utilities
import numpy as np
import scipy.sparse.linalg
from exu_press.integrate.motion import velocities_of
from exu_press.integrate.problem import Problem
from exu_press.integrate.set_numbers import SetNumbers

from exu_press import InputError, solve_dynamic
from exu_press.integrate.scales import weights
from exudyn_models.renamed import put_back

EXPORTED = (
    math,
    exudyn.basicUtilities,
    exudyn.advancedUtilities,
    exudyn.rigidBodyUtilities,
    exudyn.graphicsDataUtilities,
    exudyn.beams,
    exudyn.itemInterface,
)
SAMPLES = 20
MOST_KEPT = 2000, 4_000_000
"""Rows, and numbers in them, of which a motion's largest speeds are found."""
MEMORY = 6 << 30  # bytes
CURRENT = exu.ConfigurationType.Current
IMPLICIT = exu.DynamicSolverType.GeneralizedAlpha, exu.DynamicSolverType.TrapezoidalIndex2


class Record:
    """Velocities and first-order coordinates at the instants, by cubics between steps.

    Those of bodies with three angles are about their own axes: rates of angles are as fast as may
    be near 90 degrees.
    """

    def __init__(self, mbs, start, end):
        self.data, self.steps = mbs.systemData, -1
        self.times = np.linspace(start, end, SAMPLES + 1)[1:]
        self.rows, self.before = [], None
        self.kept, self.apart = [], 1  # rows of every so many steps
        self.close = 1e-9 * (end - start)
        own = mbs.GetPostStepUserFunction()
        self.own = own["function"] if isinstance(own, dict) else None
        self.problem = None
        with contextlib.suppress(InputError):  # then it is refused, too
            problem = Problem.of(mbs)
            if any(node.rotations == 3 for node in problem.nodes):
                self.problem = problem

    def state(self):
        """Return positions, velocities and first-order coordinates, and the rates of all three."""
        data = self.data
        values = data.GetODE2Coordinates, data.GetODE2Coordinates_t, data.GetODE1Coordinates
        slopes = data.GetODE2Coordinates_t, data.GetODE2Coordinates_tt, data.GetODE1Coordinates_t
        return [
            np.concatenate([np.array(part(CURRENT)) for part in parts])
            for parts in (values, slopes)
        ]

    def told(self, value):
        """Return velocities and first-order coordinates of a state."""
        size = self.data.ODE2Size()
        if self.problem is None:
            return value[size:]
        return np.concatenate([velocities_of(self.problem, value[None])[0], value[2 * size :]])

    def __call__(self, mbs, time):
        self.steps += 1
        value, slope = self.state()
        if self.steps % self.apart == 0:
            self.kept.append(self.told(value))
            if len(self.kept) > min(MOST_KEPT[0], max(SAMPLES, MOST_KEPT[1] // (len(value) + 1))):
                self.kept, self.apart = self.kept[::2], 2 * self.apart
        while len(self.rows) < SAMPLES and time >= self.times[len(self.rows)] - self.close:
            at = self.times[len(self.rows)]
            if self.before is None or time - at < self.close:
                self.rows.append(self.told(value))
                continue
            begin, old, old_slope = self.before
            h = time - begin
            s = (at - begin) / h
            within = (
                old * (1 + 2 * s) * (1 - s) ** 2
                + value * s * s * (3 - 2 * s)
                + h * s * (1 - s) * ((1 - s) * old_slope - s * slope)
            )
            self.rows.append(self.told(within))
        self.before = time, value, slope
        return self.own(mbs, time) if self.own else True


def on_grid(function, numbers, start, period):
    """Return a pre-step function that calls one once a period, with its end, as by the user."""
    called = [start]

    def call(mbs, time):
        end, go_on = start + math.ceil((time - start) / period - 1e-6) * period, True
        if end != called[0]:
            go_on = numbers.call(lambda: function(mbs, end), called[0], end)
            called[0] = end
        numbers.at(time)
        return go_on

    return call


def quiet():
    """No windows, no pictures, no files."""

    def nothing(*args, **keys):
        return True

    for name in ("Start", "Stop", "DoIdleTasks", "RedrawAndSaveImage", "SendRedrawSignal"):
        setattr(exu.Renderer, name, nothing)
    for name in ("StartRenderer", "StopRenderer", "DoRendererIdleTasks"):
        setattr(exu, name, nothing)
    for name in ("SolutionViewer", "PlotSensor", "WaitForUserToContinue", "DrawSystemGraph"):
        if hasattr(exu.MainSystem, name):
            setattr(exu.MainSystem, name, nothing)
    exudyn.plot.PlotSensor = exudyn.utilities.PlotSensor = nothing
    for module in EXPORTED:  # by exudyn.utilities, in earlier versions
        for name, value in vars(module).items():
            if not name.startswith("_") and not hasattr(builtins, name):
                setattr(builtins, name, value)
    put_back()
    builtins.np, builtins.exudyn = np, exu
    variants = exudyn.processing.ProcessParameterList

    def in_turn(function, sets, *args, **keys):  # else any of these may end first
        return variants(function, sets, False)

    exudyn.processing.ProcessParameterList = in_turn
    random.seed(1)
    np.random.seed(1)
    eigsh = scipy.sparse.linalg.eigsh  # from a start by chance, modes have their signs by chance

    def same_signs(*args, **keys):
        size = (args[0] if args else keys["A"]).shape[0]
        return eigsh(*args, **{"v0": np.random.RandomState(1).rand(size), **keys})

    scipy.sparse.linalg.eigsh = same_signs
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def replace(variant, file):
    """Put our run in the place of Exudyn's."""
    theirs = exu.SolveDynamic

    def solve(mbs, *args, **keys):
        given = {**dict(zip(("simulationSettings", "solverType"), args, strict=False)), **keys}
        settings = given.get("simulationSettings") or exu.SimulationSettings()
        integration = settings.timeIntegration
        solver = given.get("solverType") or integration.solverType
        if solver not in IMPLICIT:
            finish(file, {"status": "explicit", "solver": str(solver)})
        if not mbs.systemIsConsistent:
            mbs.Assemble()
        settings.solution.file.write = False
        integration.verboseMode = 0
        settings.displayComputationTime = settings.displayStatistics = False
        settings.timeIntegration.simulateInRealtime = False
        users = integration.numberOfSteps
        period = (integration.endTime - integration.startTime) / users
        watched = contextlib.nullcontext()
        if "times" in variant:
            integration.numberOfSteps = max(SAMPLES, round(users * variant["times"]))
            before = mbs.GetPreStepUserFunction()
            if variant["times"] > 1 and isinstance(before, dict) and before["function"]:
                numbers = SetNumbers(mbs)
                watched = numbers.watched()
                mbs.SetPreStepUserFunction(
                    on_grid(before["function"], numbers, integration.startTime, period)
                )
        elif variant.get("steps"):
            integration.numberOfSteps = variant["steps"]
        record = Record(mbs, integration.startTime, integration.endTime)
        mbs.SetPostStepUserFunction(record)
        found = {"users_steps": users, "end": integration.endTime, "reason": ""}
        found["unknowns"] = mbs.systemData.ODE2Size() + mbs.systemData.ODE1Size()
        begun = clock.process_time()
        try:
            if "times" in variant:
                with watched:
                    theirs(mbs, settings, solver)
                found["status"] = "completed"
            else:
                integration.solverType = solver
                for output in (settings.solution.sensors, settings.solution.file):
                    if output.writePeriod > 0.0:  # no more rows than the user's steps have
                        output.writePeriod = max(output.writePeriod, period)
                outcome = solve_dynamic(
                    mbs,
                    settings,
                    tolerance=variant["tolerance"],
                    sample=period,
                    errors=variant.get("errors", False),
                )
                if outcome.error is not None:
                    found["stated"], found["why"] = outcome.error.motion, outcome.error.reason
                found["status"], found["reason"] = outcome.status.value, outcome.reason
                found["tries"] = outcome.steps + outcome.rejected_steps
        except InputError as error:
            found["status"], found["reason"] = "refused", str(error)
        except exu.ExudynError as error:
            found["status"] = "failed"
            found["reason"] = f"{type(error).__name__}: {str(error).strip()[:300]}"
        found["seconds"] = clock.process_time() - begun
        found["steps"], found["reached"] = record.steps, mbs.systemData.GetTime()
        finish(file, found, mbs, record.rows, record.kept)

    exu.SolveDynamic = exudyn.solver.SolveDynamic = exu.MainSystem.SolveDynamic = solve
    if hasattr(exudyn.utilities, "SolveDynamic"):
        exudyn.utilities.SolveDynamic = solve


def fastest(rows, weight, body):
    """Return the row in which a body is fastest; what belongs to none has its largest values."""
    found = np.abs(rows).max(axis=0)
    owned = ~np.isnan(weight)
    if owned.any():
        squares = np.where(owned, weight * rows[:, : len(weight)], 0.0) ** 2
        first = np.unique(body, return_index=True)[1]
        here = np.add.reduceat(squares, first, axis=1).max(axis=1).argmax()
        found[: len(weight)][owned] = rows[here, : len(weight)][owned]
    return found


def finish(file, found, mbs=None, rows=(), kept=()):
    arrays = {"rows": np.array(rows)}
    if mbs is not None:
        try:
            problem = Problem.of(mbs)
            matrix = mbs.sys["dynamicSolver"].GetSystemMassMatrix()
            inertias, masses = weights(problem.nodes, matrix)
            sizes = [node.size for node in problem.nodes]
            arrays["body"] = np.repeat(np.arange(len(sizes)), sizes)
            mass = np.array(masses)[arrays["body"]] if sizes else np.zeros(0)
            mass[mass == 0.0] = np.nan  # no displacements: its own largest velocity is the scale
            arrays["weight"] = np.sqrt(np.array(inertias) / mass)
            arrays["fastest"] = fastest(np.array(kept), arrays["weight"], arrays["body"])
        except Exception as error:  # then no tolerance run is possible either
            found["no_weights"] = str(error)
    own = f"{file}.{os.getpid()}.npz"  # some scripts start processes that come here as well
    np.savez(own, found=json.dumps(found), **arrays)
    Path(own).replace(file)
    os._exit(0)


def main():
    script, variant, file = sys.argv[1:]
    quiet()
    replace(json.loads(variant), file)
    folder = str(Path(script).parent)
    os.chdir(folder)
    sys.path[0] = folder
    sys.argv = [script]
    runpy.run_path(script, run_name="__main__")
    finish(file, {"status": "no dynamic solution"})


if __name__ == "__main__":
    main()
