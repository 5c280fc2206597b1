"""What the campaign adds: other solvers on two coordinates, and a published endpoint."""

from dataclasses import dataclass
from functools import cache

from exu_press.scene import Scene
from exu_press.studies.precision.cases import Case, Extent
from exu_press.studies.precision.errors import Errors, errors_of
from exu_press.studies.precision.references import Reference, divergence
from exu_press.studies.precision.timing import Attempt, TimedRun
from precision.compiled import CompiledModel, compile_model
from precision.peers import PEERS, peer_attempts
from precision.squeezer import DURATION, squeezer_attempts, squeezer_errors
from precision.variations import newton_modes, spectral_radii

__all__ = ["Reduced", "Squeezer"]

PEER_TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)


@dataclass(frozen=True)
class Reduced(Case):
    """A slider-crank, by hand on two coordinates too, for other people's integrators.

    Attributes:
        variations: whether spectral radius and Newton mode are varied.
    """

    variations: bool = False

    def reference(self, amount: Extent) -> Reference:
        """Return SciPy's Radau on the reduced slider-crank, checked against its LSODA."""
        model = _model(self._scene)
        peers = {peer.name: peer for peer in PEERS}
        tight = {"SciPy Radau": 1e-10 * amount.loosen, "SciPy LSODA": 1e-12 * amount.loosen}
        radau, lsoda = (peers[name].trajectory(model, tol) for name, tol in tight.items())
        method = " against ".join(f"{name} {tol:.0e}" for name, tol in tight.items())
        diverged = divergence(self._scene, radau, lsoda)
        difference = errors_of(lsoda, radau, diverged.horizon or self.duration)
        return Reference(f"two coordinates: {method}", radau, difference, diverged)

    def attempts(self, amount: Extent) -> list[Attempt]:
        """Return the package's own runs and those of every peer that is installed."""
        tight = [tol for tol in PEER_TOLERANCES if tol >= amount.finest_peer]
        found = super().attempts(amount)
        if self.variations:
            found += spectral_radii(self._scene, amount) + newton_modes(self._scene, amount)
        return found + peer_attempts(_model(self._scene), tight)


@dataclass(frozen=True)
class Squeezer(Case):
    """Andrews' squeezer, which is no scene; its endpoint is published with 13 digits."""

    @property
    def duration(self) -> float:
        """Simulated time, s."""
        return DURATION

    def reference(self, amount: Extent) -> Reference:
        """Return the endpoint's precision; there is no trajectory."""
        return Reference("published endpoint, tolerance 1e-14", None, Errors(1e-13, 1e-9, None))

    def attempts(self, amount: Extent) -> list[Attempt]:
        """Return the package's runs of the squeezer."""
        return squeezer_attempts(self.steps, self.tolerances)

    def errors(
        self, run: TimedRun, reference: Reference, horizon: float
    ) -> tuple[Errors, float | None]:
        """Return the errors at the endpoint."""
        if run.trajectory is None:
            return Errors(None, None, None), None
        return squeezer_errors(run.trajectory), None


@cache
def _model(scene: Scene) -> CompiledModel:
    return compile_model(scene)
