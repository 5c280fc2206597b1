"""The file of finished rows, what it makes of what a kill leaves, and the tasks of rows."""

import math

import batch_functions
import pytest

from exu_press import InputError
from exu_press.parallel.rows import RowFile
from exu_press.parallel.task import name_of, task_of, versions

ROW = {"status": "completed", "reason": "", "value": 0.1 + 0.2}


def write(path, *keys):
    with RowFile(path) as file:
        for key in keys:
            file.append(key, None, ROW)


@pytest.mark.parametrize("kept", [1, 20, -1])
def test_a_torn_last_line_is_cut_off(tmp_path, kept):
    path = tmp_path / "runs.jsonl"
    write(path, "a", "b")
    whole = path.read_bytes()
    first, second = whole.splitlines(keepends=True)
    path.write_bytes(first + second[:kept])
    with RowFile(path) as file:
        assert file.finished_row("a", None) == ROW
        assert file.finished_row("b", None) is None
        file.append("b", None, ROW)
    assert path.read_bytes() == whole


@pytest.mark.parametrize(
    "line",
    [
        "name,value",
        "[1, 2]",
        '{"key": "a"}',
        "",
        "[" * 100_000,
        '{"key": "a", "time_limit": null, "row": {"reason": ""}}',
        '{"key": "a", "time_limit": null, "row": {"status": 5, "reason": ""}}',
        '{"key": "a", "time_limit": "long", "row": {"status": "completed", "reason": ""}}',
        '{"key": ["a"], "time_limit": null, "row": {"status": "completed", "reason": ""}}',
        '{"key": "a", "time_limit": null, "row": {"status": "completed", "reason": "\\ud800"}}',
        '{"key": "a", "time_limit": null, "row": {"status": "a", "reason": "", "x": NaN}}',
    ],
)
def test_a_file_of_something_else_is_refused_and_left_alone(tmp_path, line):
    path = tmp_path / "runs.jsonl"
    path.write_text(f"{line}\nsomething")
    with pytest.raises(InputError, match="line 1: not a row"):
        RowFile(path)
    assert path.read_text() == f"{line}\nsomething"


def test_what_is_tried_again(tmp_path):
    with RowFile(tmp_path / "runs.jsonl") as file:
        for status in ("failed", "worker died", "time limit", "film broke down"):
            file.append(status, 10.0, {"status": status, "reason": "some"})
    with RowFile(tmp_path / "runs.jsonl") as file:
        assert file.finished_row("failed", 10.0) is None
        assert file.finished_row("worker died", 10.0) is None
        assert file.finished_row("film broke down", 10.0) is not None
        assert [file.finished_row("time limit", s) is None for s in (5.0, 10.0, 11.0, None)] == [
            False, False, True, True,
        ]  # fmt: skip


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
