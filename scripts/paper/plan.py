"""Collects the runs that a study needs, equal ones once, so that they go through one batch."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

__all__ = ["Plan"]

Row = Mapping[str, Any]
Task = dict[str, Any]


@dataclass
class Plan:
    """Tasks of `tasks.observe`, and their rows when they have been run."""

    tasks: list[Task] = field(default_factory=list)
    _numbers: dict[str, int] = field(default_factory=dict)
    _rows: Sequence[Row] = ()

    def add(self, task: Task) -> int:
        """Return a task's number: the one of a task on the same scene, if there is one.

        Its result is saved where the first of them that asked for it wants it.
        """
        key = json.dumps(task["scene"], sort_keys=True)
        number = self._numbers.setdefault(key, len(self.tasks))
        if number == len(self.tasks):
            self.tasks.append(task)
        self.tasks[number] = task | self.tasks[number]
        return number

    def run(self, run_all: Callable[[Sequence[Task]], Sequence[Row]]) -> None:
        """Run everything."""
        self._rows = run_all(self.tasks)

    def __getitem__(self, number: int) -> Row:
        """Return a task's row."""
        return self._rows[number]
