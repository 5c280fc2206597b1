"""The key of a run: function, arguments, versions and sources."""

import math

import batch_functions
import pytest

from exu_press.parallel import task
from exu_press.parallel.task import name_of, source_digest, task_of, versions
from fe_models.lazy import named_object


def test_the_key_is_of_function_arguments_and_versions(monkeypatch):
    name = name_of(batch_functions.digits)
    key = task_of(name, {"a": 1.0, "b": {"c": 2}}).key
    assert len(key) == 64
    assert key == task_of(name, {"b": {"c": 2}, "a": 1.0}).key  # order is nothing
    others = [
        task_of(name, {"a": 1.0 + 2e-16, "b": {"c": 2}}),
        task_of(name_of(batch_functions.raises), {"a": 1.0, "b": {"c": 2}}),
    ]
    monkeypatch.setattr(
        "exu_press.parallel.task.versions", lambda function: {**versions(function), "exudyn": "0"}
    )
    others.append(task_of(name, {"a": 1.0, "b": {"c": 2}}))
    assert len({key, *(changed.key for changed in others)}) == 4


def test_a_name_leads_back_to_its_function():
    assert named_object(name_of(batch_functions.digits)) is batch_functions.digits


def test_what_a_worker_cannot_import_is_refused():
    def inner(arguments):
        return arguments

    for function in (inner, lambda arguments: arguments):
        with pytest.raises(ValueError, match="top level"):
            name_of(function)


@pytest.mark.parametrize("value", [math.nan, math.inf, object()])
def test_arguments_that_are_no_json_are_refused(value):
    with pytest.raises((ValueError, TypeError)):
        task_of("module:name", {"value": value})


@pytest.fixture
def digest(tmp_path, monkeypatch):
    """Return what makes a file of a user and returns the digest of a module then."""
    monkeypatch.syspath_prepend(tmp_path)

    def with_file(name, text, module="some_package"):
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return source_digest(module)

    return with_file


def test_what_a_row_comes_from_and_what_only_shows_it(digest):
    first = digest("some_package/__init__.py", "")
    assert digest("some_package/law.py", "x = 1") != first
    second = digest("some_package/law.py", "x = 2")
    assert digest("some_package/law.py", "x = 1") != second != first
    assert digest("some_package/law.py", "x = 2") == second
    shown = digest("some_package/plots/law.py", "x = 1")
    assert shown == digest("some_package/__pycache__/law.pyc", "x") == second


@pytest.mark.parametrize(
    "law",
    [
        "import helper",
        "from helper import stiffness",
        "def force():\n    import helper.inner as inside",
        "import middle",
        "TABLE = 'helper.csv'",
        "from pathlib import Path\nTABLE = Path(__file__).with_name('helper.csv')",
    ],
)
def test_what_a_law_of_the_users_imports_or_names_counts_too(digest, law):
    digest("middle.py", "from helper import stiffness as middle")
    digest("helper.csv", "1,2")
    digest("helper.py", "stiffness = 1.0")
    first = digest("law.py", law, "law")
    changed = digest("helper.csv" if "csv" in law else "helper.py", "stiffness = 2.0", "law")
    assert changed != first
    assert digest("unused.py", "x = 1", "law") == changed


def test_a_source_that_is_none_is_digested_all_the_same(digest):
    assert digest("law.py", "def", "law") != digest("law.py", "def def", "law")


def test_what_is_installed_counts_by_its_version_alone(digest):
    assert set(task._users_files(["law"])) == set()
    digest("law.py", "import numpy, scipy.stats, exu_press, json, no_such_module", "law")
    assert set(task._users_files(["law"])) == {"law"}


def test_our_own_are_always_among_them(monkeypatch):
    digests = {source_digest("exu_press"), source_digest("json")}
    monkeypatch.setattr(task, "OURS", ("exu_press",))
    assert source_digest("exu_press") not in digests
