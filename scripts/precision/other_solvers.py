"""What the campaign adds: other solvers on two coordinates, and a published endpoint."""

from collections.abc import Sequence
from functools import cache

from exu_press.scene import Scene
from exu_press.studies.precision.amount import Amount
from exu_press.studies.precision.errors import Errors, errors_of
from exu_press.studies.precision.measured import Attempt
from exu_press.studies.precision.trajectory import Trajectory
from exu_press.studies.precision.truth import Reference, parting
from precision.compiled import CompiledModel, compile_model
from precision.peers import PEERS, peer_attempts
from precision.squeezer import DURATION, squeezer_attempts, squeezer_errors

__all__ = ["Reduced", "Squeezer"]

PEER_TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)


class Reduced:
    """A slider-crank by hand on two coordinates, for other people's integrators."""

    duration: float | None = None

    def reference(self, scene: Scene | None, amount: Amount) -> Reference:
        """Return SciPy's Radau on the reduced slider-crank, checked against its LSODA."""
        model = _model(scene)
        peers = {peer.name: peer for peer in PEERS}
        tight = {"SciPy Radau": 1e-10 * amount.loosen, "SciPy LSODA": 1e-12 * amount.loosen}
        radau, lsoda = (peers[name].trajectory(model, tol) for name, tol in tight.items())
        method = " against ".join(f"{name} {tol:.0e}" for name, tol in tight.items())
        assert scene is not None
        parted = parting(scene, radau, lsoda)
        difference = errors_of(lsoda, radau, parted.horizon or scene.duration)
        return Reference(f"two coordinates: {method}", radau, difference, parted)

    def attempts(
        self,
        scene: Scene | None,
        amount: Amount,
        steps: Sequence[float],
        tolerances: Sequence[float],
    ) -> list[Attempt]:
        """Return the runs of every peer that is installed."""
        tight = [tol for tol in PEER_TOLERANCES if tol >= amount.finest_peer]
        return peer_attempts(_model(scene), tight)

    def errors(self, run: Trajectory) -> Errors | None:
        """Return None: it is compared with its reference."""
        return None


class Squeezer:
    """Andrews' squeezer, which is no scene; its endpoint is published with 13 digits."""

    duration: float | None = DURATION

    def reference(self, scene: Scene | None, amount: Amount) -> Reference:
        """Return the endpoint's precision; there is no trajectory."""
        return Reference("published endpoint, tolerance 1e-14", None, Errors(1e-13, 1e-9, None))

    def attempts(
        self,
        scene: Scene | None,
        amount: Amount,
        steps: Sequence[float],
        tolerances: Sequence[float],
    ) -> list[Attempt]:
        """Return the package's runs of the squeezer."""
        return squeezer_attempts(steps, tolerances)

    def errors(self, run: Trajectory) -> Errors | None:
        """Return the errors at the endpoint."""
        return squeezer_errors(run)


@cache
def _model(scene: Scene | None) -> CompiledModel:
    assert scene is not None
    return compile_model(scene)
