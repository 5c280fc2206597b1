"""Every example in a docstring gives what it shows; they stand in the reference too."""

import doctest
import importlib
from pathlib import Path

import pytest

import exu_press
import fe_models
import paper
import precision
import stability

MODULES = [
    ".".join((package.__name__, *file.relative_to(folder).with_suffix("").parts)).removesuffix(
        ".__init__"
    )
    for package in (exu_press, fe_models, paper, precision, stability)
    for folder in [Path(package.__path__[0])]
    for file in sorted(folder.rglob("*.py"))
    if ">>>" in file.read_text(encoding="utf-8")
]


@pytest.mark.parametrize("name", MODULES)
def test_examples(name):
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as error:  # an extra that is not installed
        pytest.skip(str(error))
    found = doctest.testmod(module)
    assert found.attempted > 0 and found.failed == 0
