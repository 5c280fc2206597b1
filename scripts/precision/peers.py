"""Other people's integrators on the reduced slider-crank; what is not installed is left out."""

import ctypes
import importlib
import importlib.util
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from exu_press.numerics.arrays import Array
from exu_press.studies.precision.errors import Trajectory
from exu_press.studies.precision.timing import Attempt, TimedRun
from precision.compiled import CompiledModel, has_numba

__all__ = ["PEERS", "Peer", "PeerError", "installed", "left_out", "peer_attempts"]

FIRST_STEP = 1e-7  # s: all of them start in the middle of a clearance, where nothing says how stiff
SCALES = np.array([1.0, 1.0, 10.0, 10.0])
"""Absolute tolerance of the state's parts, times the relative one: m and rad, m/s and rad/s."""
MOST_STEPS = 10_000_000
SAMPLES_APART = 5e-6
"""s, between the instants at which a peer's dense output is looked at."""

HOW = {
    "scipy": "pip install scipy",
    "numba": "pip install '.[benchmark]'",
    "sksundae": "pip install '.[benchmark]'",
    "numbalsoda": "pip install numbalsoda builds it, with cmake and a Fortran compiler",
}
"""How to install what; numbalsoda has no wheels, so that the extra would fail with it."""

Solution = tuple[Array, Array, int | None]
"""Instants (n,), states (n, 4), and how often the right-hand side was asked for."""


class PeerError(RuntimeError):
    """A peer did not reach the end; the message is its own."""


@dataclass(frozen=True)
class Peer:
    """One integrator.

    Attributes:
        name: as it is shown.
        package: what must be installed.
        solve: (model, tolerance, instants) -> solution at the instants; without instants at what
            steps it likes (that is what is time_runs).
        needs_numba: it takes nothing but compiled functions.
    """

    name: str
    package: str
    solve: Callable[[CompiledModel, float, Array | None], Solution]
    needs_numba: bool = False

    def trajectory(self, model: CompiledModel, tolerance: float) -> Trajectory:
        """Integrate once for the result: dense, and at its own steps, which resolve impacts."""
        own_steps = self.solve(model, tolerance, None)[0]
        count = round(model.scene.duration / SAMPLES_APART)
        grid = np.linspace(0.0, model.scene.duration, count + 1)
        steps = own_steps[
            np.abs(own_steps - SAMPLES_APART * np.rint(own_steps / SAMPLES_APART)) > 1e-9
        ]
        time, states, _ = self.solve(model, tolerance, np.sort(np.concatenate([grid, steps])))
        return model.trajectory(time, states)


def installed(peer: Peer) -> str:
    """Return an empty text, or why the peer is left out."""
    for package in (peer.package, *(("numba",) if peer.needs_numba else ())):
        if importlib.util.find_spec(package) is None:
            return f"{peer.name} left out: {package} is not installed ({HOW[package]})"
    return ""


def left_out() -> list[str]:
    """Return what is not installed, and what that leaves out."""
    reasons = [why for peer in PEERS if (why := installed(peer))]
    if not has_numba():
        reasons.append("numba is not installed: the peers' right-hand side is not compiled")
    return reasons


def _scipy(method: str) -> Callable[[CompiledModel, float, Array | None], Solution]:
    def solve(model: CompiledModel, tolerance: float, instants: Array | None) -> Solution:
        try:
            solution = solve_ivp(
                model.rate,
                (0.0, model.scene.duration),
                model.start,
                method=method,
                rtol=max(tolerance, 1e-13),
                atol=tolerance * SCALES,
                first_step=FIRST_STEP,
                t_eval=instants,
            )
        except ValueError as error:  # a film ends at eccentricity ratio 1, where all is NaN
            raise PeerError(str(error)) from None
        if not solution.success:
            raise PeerError(str(solution.message))
        return solution.t, np.ascontiguousarray(solution.y.T), int(solution.nfev)

    return solve


def _span(model: CompiledModel, instants: Array | None) -> Array:
    return np.array([0.0, model.scene.duration]) if instants is None else instants


def _cvode(model: CompiledModel, tolerance: float, instants: Array | None) -> Solution:
    solver = importlib.import_module("sksundae.cvode").CVODE(model.fill, **_sundials(tolerance))
    return _solution(solver.solve(_span(model, instants), model.start))


def _ida(model: CompiledModel, tolerance: float, instants: Array | None) -> Solution:
    fill = model.fill

    def residual(t: float, x: Array, x_t: Array, out: Array) -> None:
        fill(t, x, out)
        np.subtract(x_t, out, out=out)

    solver = importlib.import_module("sksundae.ida").IDA(residual, **_sundials(tolerance))
    start_rate = model.rate(0.0, model.start)
    return _solution(solver.solve(_span(model, instants), model.start, start_rate))


def _sundials(tolerance: float) -> dict[str, Any]:
    return {
        "rtol": tolerance,
        "atol": tolerance * SCALES,
        "first_step": FIRST_STEP,
        "max_num_steps": MOST_STEPS,
    }


def _solution(solution: Any) -> Solution:
    if not solution.success:
        raise PeerError(str(solution.message))
    return np.array(solution.t), np.ascontiguousarray(solution.y), int(solution.nfev)


def _numbalsoda(model: CompiledModel, tolerance: float, instants: Array | None) -> Solution:
    coarse = np.linspace(0.0, model.scene.duration, 251)
    instants = coarse if instants is None else instants
    address = _address(model)
    states, success = importlib.import_module("numbalsoda").lsoda(
        address, model.start.copy(), instants, np.zeros(1), tolerance, tolerance, MOST_STEPS
    )
    if not success:
        raise PeerError("numbalsoda's lsoda reports a failure without a reason")
    return instants, np.ascontiguousarray(states), None


_ADDRESSES: "dict[int, tuple[Any, CompiledModel]]" = {}
"""Compiled callbacks by the model they belong to; a callback lives as long as its model."""


def _address(model: CompiledModel) -> int:
    """Return the address of the right-hand side as numbalsoda calls it."""
    if id(model) not in _ADDRESSES:
        numba: Any = importlib.import_module("numba")
        signature = importlib.import_module("numbalsoda").lsoda_sig
        fill, carray = model.fill, numba.carray

        @numba.cfunc(signature)  # type: ignore[untyped-decorator]
        def callback(t: Any, x: Any, x_t: Any, data: Any) -> None:
            fill(t, carray(x, (4,)), carray(x_t, (4,)))

        _ADDRESSES[id(model)] = callback, model
    return int(_ADDRESSES[id(model)][0].address)


PEERS = (
    Peer("SciPy Radau", "scipy", _scipy("Radau")),
    Peer("SciPy BDF", "scipy", _scipy("BDF")),
    Peer("SciPy LSODA", "scipy", _scipy("LSODA")),
    Peer("CVODE", "sksundae", _cvode),
    Peer("IDA", "sksundae", _ida),
    Peer("numbalsoda LSODA", "numbalsoda", _numbalsoda, needs_numba=True),
)


def peer_attempts(model: CompiledModel, tolerances: Iterable[float]) -> list[Attempt]:
    """Return the runs of every peer that is installed."""
    tolerances = tuple(tolerances)
    return [
        Attempt(
            peer.name,
            "tolerance",
            tol,
            partial(_measure, peer, model, tol),
            again=partial(_time, peer, model, tol),
        )
        for peer in PEERS
        if not installed(peer)
        for tol in tolerances
    ]


def _time(peer: Peer, model: CompiledModel, tolerance: float, _number: int = 0) -> TimedRun:
    """Integrate as it is timed; once more from the same start, whatever its number."""
    evaluations, reason = None, ""
    with _silent_libraries():
        start, cpu_start = time.perf_counter(), time.process_time()
        try:
            evaluations = peer.solve(model, tolerance, None)[2]
        except PeerError as error:
            reason = str(error)
        times = (time.perf_counter() - start,), (time.process_time() - cpu_start,)
    status = "failed" if reason else "completed"
    return TimedRun(None, *times, status=status, reason=reason, law_evaluations=evaluations)


def _measure(peer: Peer, model: CompiledModel, tolerance: float) -> TimedRun:
    """Integrate as it is timed, then for the result."""
    run = _time(peer, model, tolerance)
    if run.status != "completed":
        return run
    try:
        with _silent_libraries():
            trajectory = peer.trajectory(model, tolerance)
    except PeerError as error:
        return replace(run, status="failed", reason=str(error))
    if not all(np.isfinite(x).all() for x in (trajectory.position, trajectory.acceleration)):
        return replace(run, status="failed", reason="its result is not finite")
    return replace(run, trajectory=trajectory)


@contextmanager
def _silent_libraries() -> Iterator[None]:
    """Keep what compiled libraries print off the terminal; a failure is told by its row."""
    streams = (sys.stdout, sys.stderr)
    for stream in streams:
        stream.flush()
    kept = [os.dup(number) for number in (1, 2)]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for number in (1, 2):
        os.dup2(nowhere, number)
    try:
        yield
    finally:
        if sys.platform != "win32":
            ctypes.CDLL(None).fflush(None)
        for number, copy in zip((1, 2), kept, strict=True):
            os.dup2(copy, number)
            os.close(copy)
        os.close(nowhere)
