"""Linear elastic, isotropic materials, and the two of the paper's Table 1."""

from dataclasses import dataclass

from fe_models.errors import InputError

__all__ = ["CRANK_STEEL", "LINKAGE_IRON", "Material"]


@dataclass(frozen=True)
class Material:
    """Young's modulus [Pa], Poisson's ratio, density [kg/m^3]."""

    youngs_modulus: float
    poissons_ratio: float
    density: float

    def __post_init__(self) -> None:
        """Refuse constants that no stable elastic solid has."""
        for key in ("youngs_modulus", "density"):
            value = getattr(self, key)
            if not 0.0 < value < float("inf"):
                raise InputError(f"material.{key} = {value!r}: must be positive and finite")
        if not 0.0 <= self.poissons_ratio <= 0.495:
            raise InputError(
                f"material.poissons_ratio = {self.poissons_ratio!r}: must lie in 0 ... 0.495 "
                "(displacement elements lock near 0.5)"
            )


CRANK_STEEL = Material(youngs_modulus=2.1e11, poissons_ratio=0.3, density=7850.0)
LINKAGE_IRON = Material(youngs_modulus=1.69e11, poissons_ratio=0.286, density=7200.0)
