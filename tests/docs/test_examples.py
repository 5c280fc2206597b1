"""Every example in a docstring gives what it shows; they stand in the reference too."""

import doctest
import importlib
import pkgutil

import pytest

import exu_press
import fe_models
import paper
import precision
import stability

MODULES = [
    module.name
    for package in (exu_press, fe_models, paper, precision, stability)
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
]


@pytest.mark.parametrize("name", MODULES)
def test_examples(name):
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as error:  # an extra that is not installed
        pytest.skip(str(error))
    assert doctest.testmod(module).failed == 0
