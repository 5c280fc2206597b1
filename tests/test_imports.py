"""Rooms know what lies below them alone: nothing imports backwards, lazily or for types."""

import ast
import functools
from collections import defaultdict
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import exu_press
import fe_models

PACKAGES = [Path(package.__file__).parent for package in (exu_press, fe_models)]
FILES = sorted(path for package in PACKAGES for path in package.rglob("*.py"))


def name_of(path):
    """Return the dotted name of a module; a package's face has its folder's."""
    package = next(package for package in PACKAGES if path.is_relative_to(package))
    parts = [*path.relative_to(package.parent).with_suffix("").parts]
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {name_of(path) for path in FILES}
PARTS = {name for name in MODULES if name.split(".")[0] == "fe_models"}


@functools.cache
def imported(path):
    """Return the modules of the package that a file imports anywhere in its text."""
    return [*found_in(path)]


def found_in(path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in MODULES)
        elif isinstance(node, ast.ImportFrom) and node.module in MODULES:
            inner = [f"{node.module}.{alias.name}" for alias in node.names]
            yield from (name if name in MODULES else node.module for name in inner)


def room(module):
    """Return the folder or file of its package that a module lies in."""
    return ".".join(module.split(".")[:2])


def test_the_finite_elements_know_no_press():
    used = {other for path in FILES if name_of(path) in PARTS for other in imported(path)}
    assert used <= PARTS


@pytest.mark.parametrize("unit", [room, str], ids=["rooms", "files"])
def test_imports_run_one_way(unit):
    arrows = defaultdict(set)
    for path in FILES:
        name = name_of(path)
        if name in ("exu_press", "fe_models") or (unit is str and path.name == "__init__.py"):
            continue  # faces hand names on
        for other in imported(path):
            if unit(other) != unit(name):
                arrows[unit(name)].add(unit(other))
    assert len(arrows) > 20
    try:
        TopologicalSorter(arrows).prepare()
    except CycleError as error:
        pytest.fail(f"a circle of imports: {' -> '.join(error.args[1])}")


def test_only_methods_for_users_ask_the_face_of_the_package():
    """`Scene.build`, `Result.summary` and notebook cells are the work of modules above them."""
    asking = {name_of(path) for path in FILES if "exu_press" in imported(path)}
    assert asking == {
        "exu_press.cli.main",
        "exu_press.installation.check",
        "exu_press.mechanism.mechanism",
        "exu_press.result.result",
        "exu_press.scene.scene",
        "exu_press.studies.comparison",
    }


def test_no_name_of_a_package_is_that_of_its_module():
    """Whoever imports the module would hide the name behind it."""
    for path in FILES:
        if path.name == "__init__.py" and "lazy_names(" in path.read_text(encoding="utf-8"):
            package = name_of(path)
            hidden = {name for name in names_handed_on(path) if f"{package}.{name}" in MODULES}
            assert not hidden, package


def names_handed_on(path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            yield from (alias.name for alias in node.names)
