"""Run one script of Exudyn's up to its first dynamic solution, and compare what solves it.

A process of its own, as scripts print, open windows, crash and hang:
python scripts/exudyn_scripts/one_script.py SCRIPT TOLERANCE LIMIT REFERENCE FILE.
"""

import json
import math
import os
import runpy
import sys
import warnings
from pathlib import Path

import exudyn as exu
import exudyn.solver
import exudyn.utilities
import numpy as np

from exu_press import InputError
from exu_press.exudyn_systems import solve_dynamic
from exu_press.exudyn_systems.difference import common, differences, scales_of
from exu_press.exudyn_systems.level import Levels
from exu_press.exudyn_systems.refine import grid
from exu_press.exudyn_systems.samples import Variables
from exudyn_scripts.branch import branch
from exudyn_scripts.stripped import strip
from exudyn_scripts.totals import OVER

LADDER = 9
"""Doublings of the coarsest level among which the smallest sufficient number of steps is."""


class Comparison:
    """Runs of one system, each in a branch of this process."""

    def __init__(self, mbs, settings, tolerance, limit, reference):
        self.mbs, self.settings = mbs, settings
        self.tolerance, self.limit, self.left = tolerance, limit, reference
        integration = settings.timeIntegration
        self.users = int(integration.numberOfSteps)
        start, self.end = integration.startTime, integration.endTime
        period = settings.solution.sensors.writePeriod or math.inf
        rows = max(1, round((self.end - start) / period))
        self.coarsest, self.count = grid(self.users, rows)
        self.duration = self.end - start
        self.variables = Variables(mbs)
        self.levels = Levels(mbs, settings, self.count, math.inf, None, False)

    def fixed(self, steps):
        """Return the level with a number of steps, or nothing, within the time that is left."""

        def work():
            silence()
            return self.levels.run(steps, alone=True)

        level, seconds = branch(work, self.left)
        self.left -= seconds
        return level if level is not None and not level.failure else None

    def refined(self):
        """Return outcome and samples of the refinement, and its processor time."""

        def work():
            silence()
            held, beside, run_beside = [], [], Levels.run_beside

            def run_and_keep(levels, numbers, *, last=False):
                runs = run_beside(levels, numbers, last=last)
                held.extend(runs[-1:] if last else [])
                beside.append([level.seconds for level in runs])
                return runs

            Levels.run_beside = run_and_keep
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                try:
                    outcome = solve_dynamic(
                        self.mbs, self.settings, tolerance=self.tolerance, method="refine"
                    )
                except InputError as error:
                    return {"status": "refused", "reason": str(error)}, None
                except exu.ExudynError as error:
                    return {"status": "failed", "reason": str(error)[:300]}, None
            told = {
                "status": outcome.status.value,
                "reason": outcome.reason,
                "steps": outcome.steps,
                "levels": outcome.levels,
                "beside": beside,
                "error": outcome.error,
            }
            return told, held[-1].samples if held else None

        return branch(work, self.limit)

    def compare(self):
        """Return a row of the campaign's table."""
        (answer, seconds), row = self.refined(), {}
        row["users"], row["coarsest"], row["seconds"] = self.users, self.coarsest, seconds
        if answer is None:
            return {**row, "status": OVER if seconds else "crashed"}
        told, samples = answer
        stated = told.pop("error", None)
        row |= told
        if row["status"] in ("refused", "failed"):
            return row
        base = self.count * -(-8 * self.users // self.count)
        nearly, truth = self.fixed(base), self.fixed(2 * base)
        if nearly is None or truth is None:
            return {**row, "reference": OVER if self.left <= 0 else "failed"}
        scales = scales_of(truth.samples, self.variables, self.duration)

        def apart(samples):
            return (differences(samples, truth.samples, self.variables) / scales).max(axis=0)

        own = apart(nearly.samples)
        row["own"] = float(own.max())
        if samples is not None:
            missed = apart(samples)
            row["missed"] = float(missed.max())
            row |= self.stated(stated, missed, own, scales, samples, nearly.samples, truth.samples)
        if row["own"] <= self.tolerance / 3.0:
            row |= self.smallest(apart)
        return row

    def stated(self, error, missed, own, scales, samples, nearly, truth):
        """Return how the stated errors cover the true ones, relative."""
        if error is None:
            return {}
        scale = scales[-1 - sum(self.variables.sensors) : -1]
        values = slice(len(missed) - 1 - len(scale), -1)

        def pairs(true, stated, own):
            return np.array([true, stated, own]).T.tolist()

        def peaks(samples):
            ours, theirs = common(samples, truth)
            values = np.abs(samples.sensors[ours]), np.abs(truth.sensors[theirs])
            return np.abs(values[0].max(axis=0) - values[1].max(axis=0)) / scale

        motion = [part[: values.start].max(initial=0.0) for part in (missed, own)]
        sensors = np.concatenate([*error.sensors, []]) / scale
        return {
            "stated": max([error.motion, *sensors]),
            "pairs": [
                [motion[0], error.motion, motion[1]],
                *pairs(missed[values], sensors, own[values]),
            ],
            "peaks": pairs(
                peaks(samples), np.concatenate([*error.peaks, []]) / scale, peaks(nearly)
            ),
        }

    def smallest(self, apart):
        """Return the smallest sufficient number of steps on the ladder, and its time."""
        for k in range(LADDER):
            level = self.fixed(self.coarsest * 2**k)
            if level is not None and apart(level.samples).max() <= self.tolerance:
                again = [self.fixed(level.steps) for _ in range(2 if level.seconds < 0.5 else 0)]
                seconds = [one.seconds for one in (level, *again) if one is not None]
                return {"sufficient": level.steps, "single": min(seconds)}
            if self.left <= 0.0:
                break
        return {}


def silence():
    """Write nothing to the terminal."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for terminal in (1, 2):
        os.dup2(nowhere, terminal)


def main():
    script, tolerance, limit, reference, file = sys.argv[1:]

    def finish(row):
        Path(file).write_text(json.dumps(row), encoding="utf-8")
        os._exit(0)

    def solve(mbs, *args, **keys):
        options = {**dict(zip(("simulationSettings", "solverType"), args, strict=False)), **keys}
        settings = options.get("simulationSettings") or exu.SimulationSettings()
        integration = settings.timeIntegration
        integration.solverType = options.get("solverType") or integration.solverType
        exu.SolveDynamic = exudyn.solver.SolveDynamic = exu.MainSystem.SolveDynamic = theirs
        settings.solution.file.write = False
        settings.parallel.numberOfThreads = 1
        integration.realtime.active = False
        if not mbs.systemIsConsistent:
            mbs.Assemble()
        if "ngsolve" in sys.modules:
            finish({"status": "refused", "reason": "NGSolve is loaded"})
        try:
            comparison = Comparison(mbs, settings, float(tolerance), float(limit), float(reference))
            finish(comparison.compare())
        except Exception as error:
            finish({"status": "crashed", "reason": repr(error)[:300]})

    theirs = exu.SolveDynamic
    strip()
    exu.SolveDynamic = exudyn.solver.SolveDynamic = exu.MainSystem.SolveDynamic = solve
    if hasattr(exudyn.utilities, "SolveDynamic"):
        exudyn.utilities.SolveDynamic = solve
    folder = str(Path(script).parent)
    os.chdir(folder)
    sys.path[0] = folder
    sys.argv = [script]
    runpy.run_path(script, run_name="__main__")
    finish({"status": "no dynamic solution"})


if __name__ == "__main__":
    main()
