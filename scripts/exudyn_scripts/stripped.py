"""Exudyn without windows, pictures, waiting and chance, as scripts run unattended."""

import builtins
import math
import random
import resource
import time

import exudyn as exu
import exudyn.advancedUtilities
import exudyn.basicUtilities
import exudyn.beams
import exudyn.graphicsDataUtilities
import exudyn.itemInterface
import exudyn.plot
import exudyn.processing
import exudyn.rigidBodyUtilities
import exudyn.utilities
import numpy as np
import scipy.sparse.linalg

from exudyn_scripts.renamed import put_back

__all__ = ["strip"]

EXPORTED = (
    math,
    exudyn.basicUtilities,
    exudyn.advancedUtilities,
    exudyn.rigidBodyUtilities,
    exudyn.graphicsDataUtilities,
    exudyn.beams,
    exudyn.itemInterface,
)
MEMORY = 6 << 30  # bytes


def strip():
    """No windows and pictures, no processes, the same numbers by chance each time."""

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
    time.sleep = nothing
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
