"""The key of a run: function, arguments, versions and sources."""

import math

import batch_functions
import pytest

from exu_press.parallel.task import name_of, task_of, versions
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
