"""A problem without an Exudyn system behind it, in a given state."""

from types import SimpleNamespace

import exudyn as exu
import numpy as np

from exu_press.integrate.problem import Problem, State


def problem_at(nodes, velocities, accelerations=None, joints=None, length=1.0, positions=None):
    """Return a problem of nodes that are at zero unless given."""
    rest = np.zeros(len(velocities))
    placed = rest if positions is None else np.asarray(positions, dtype=float)
    moving = np.array(velocities, dtype=float)
    pushed = rest if accelerations is None else np.array(accelerations, dtype=float)
    none = np.zeros(0)
    data = SimpleNamespace(
        GetODE2Coordinates=lambda *_: placed,
        GetODE2Coordinates_t=lambda *_: moving,
        GetODE2Coordinates_tt=lambda *_: pushed,
        GetAECoordinates=lambda *_: none,
        GetODE1Coordinates=lambda *_: none,
        GetODE1Coordinates_t=lambda *_: none,
        GetDataCoordinates=lambda *_: none,
    )
    state = State(data, exu.ConfigurationType.Current)
    return Problem(
        kinds=(),
        mbs=None,
        data=data,
        current=state,
        start=state,
        reference=rest,
        nodes=tuple(nodes),
        joints=joints,
        modes=False,
        modal_stiffness=False,
        switching=False,
        switching_forces=False,
        forces_in_python=False,
        springs=False,
        rigid_markers=False,
        untold_rates=False,
        places=(),
        length=length,
    )
