"""The entry from Python: a scene in, a result out."""

from pathlib import Path

from exu_press.model.state import State
from exu_press.result import Result
from exu_press.result.run import run_once
from exu_press.scene import Scene

__all__ = ["simulate"]


def simulate(
    scene: Scene,
    *,
    errors: bool = False,
    start: State | None = None,
    unfinished: str | Path | None = None,
    quiet: bool = True,
    beside: bool = True,
) -> Result:
    """Build a scene's model, advance it to its end or an early stop, and return what came out.

    Args:
        scene: to be simulated.
        errors: whether every quantity gets its error, by refinement runs: runs of the scene at
            other tolerances, which take about as long as the run itself.
        start: `info["state"]` of another run, from whose end this one goes on, for as long as the
            scene says; its geometry has to be that run's. Time and crank angle go on, too. Steps
            begin as the others ended, but what step control remembers is lost: a run in two pieces
            is within its tolerance of one in one piece, not equal to the last digit.
        unfinished: directory in which a run of more than ten revolutions leaves what it has while
            it goes on, for `Result.load`, should its process be killed. The result's channels stand
            there, too: remove it when the result has been saved, as one with finished blocks is
            refused. None: a temporary one.
        quiet: False shows the progress on standard error.
        beside: refinement runs go in a further process meanwhile; else in this one afterwards, as
            is right where all cores have their runs already.

    Returns:
        The result. After an early stop too, `completed` False and `info["reason"]` saying when,
        where, why and what to try. With errors, `info` and the summary have the error of each
        quantity, `horizon` and `lyapunov_exponent`; a run that stopped early has none.

    Raises:
        InputError: `start` is the state of a run with other bodies, joints or loads, or at another
            constant speed, or another run is in `unfinished`, or has left finished blocks there.
        DiskFullError: there is no room for the channels of a long run.
    """
    directory = None if unfinished is None else Path(unfinished)
    if not errors:
        return run_once(scene, start=start, unfinished=directory, quiet=quiet, settling=True)
    from exu_press.verification.run import simulate_with_errors  # a run without them loads less

    return simulate_with_errors(
        scene, start=start, unfinished=directory, quiet=quiet, beside=beside
    )
