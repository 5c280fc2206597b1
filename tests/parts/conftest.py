"""Parts that several tests share: small shapes, coarse meshes."""

import pytest

from fe_models import Interface, Material, OwnShape, Reduction, shipped_part
from fe_models.elasticity import FullModel, full_model
from fe_models.part import Part
from fe_models.reduced import ReducedPart
from fe_models.reduction import reduce_model

COARSE = 0.06


@pytest.fixture(scope="session")
def bar() -> Part:
    """A bar with an interface at either end: a hundredth of the unknowns of a shipped part."""
    from netgen.occ import Box, Pnt, X

    shape = Box(Pnt(0, 0, 0), Pnt(0.3, 0.05, 0.03))
    shape.faces.Min(X).name, shape.faces.Max(X).name = "left", "right"
    steel = Material(2.1e11, 0.3, 7850.0)
    return Part("bar", OwnShape(shape), steel, (Interface("left"), Interface("right")), 0.05)


@pytest.fixture(scope="session")
def bar_model(bar: Part) -> FullModel:
    return full_model(bar)


@pytest.fixture(scope="session")
def reduced_bar(bar: Part, bar_model: FullModel) -> ReducedPart:
    return reduce_model(bar, bar_model, Reduction())


@pytest.fixture(scope="session")
def crank() -> Part:
    return shipped_part("crank", COARSE)


@pytest.fixture(scope="session")
def linkage() -> Part:
    return shipped_part("linkage", COARSE)


@pytest.fixture(scope="session")
def crank_model(crank: Part) -> FullModel:
    return full_model(crank)


@pytest.fixture(scope="session")
def linkage_model(linkage: Part) -> FullModel:
    return full_model(linkage)


@pytest.fixture(scope="session")
def reduced_crank(crank: Part, crank_model: FullModel) -> ReducedPart:
    return reduce_model(crank, crank_model, Reduction())


@pytest.fixture(scope="session")
def reduced_linkage(linkage: Part, linkage_model: FullModel) -> ReducedPart:
    return reduce_model(linkage, linkage_model, Reduction())
