"""Parts that several tests share: small shapes, coarse meshes."""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import pytest

from fe_models import Reduction, shipped_part
from fe_models.elasticity import FullModel, full_model
from fe_models.part import Part
from fe_models.reduced import ReducedPart
from fe_models.reduction import reduce_model

COARSE = 0.06


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
