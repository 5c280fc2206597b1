"""How much of a case is run."""

from dataclasses import dataclass

__all__ = ["FULL", "QUICK", "Amount"]


@dataclass(frozen=True)
class Amount:
    """How much of the cases is run.

    Attributes:
        repeats: of every run; the median is reported.
        revolutions: a rigid scene is not run longer.
        flexible_revolutions: a flexible scene is not run longer.
        finest_step: smaller fixed steps are left out, s.
        finest_tolerance: smaller tolerances are left out.
        finest_peer: smaller tolerances of the peers are left out.
        loosen: factor on the tolerances of the references.
        reference_step: smallest fixed step of a reference, s.
        starts: of a reference, beside its own, where neighbouring motions part.
        stated: tolerances whose stated errors are held against the true ones.
    """

    repeats: int
    revolutions: float
    flexible_revolutions: float
    finest_step: float
    finest_tolerance: float
    finest_peer: float
    loosen: float
    reference_step: float
    starts: int
    stated: tuple[float, ...]


FULL = Amount(3, 2.0, 0.2, 1e-6, 1e-6, 1e-10, 1.0, 1e-6, 6, (1e-2, 3e-3, 1e-3, 3e-4))
QUICK = Amount(1, 0.2, 0.02, 1e-4, 1e-4, 1e-5, 30.0, 1e-5, 1, (1e-2,))
