"""Runs beside each other as one table, of 100 columns for up to five of them."""

import itertools
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from exu_press.errors import InputError
from exu_press.plots.words import SEPARATOR, describe
from exu_press.quantities.reading import Reading
from exu_press.quantities.remarks import WIDTH, difference_lines, remarks, span_text
from exu_press.quantities.table import narrow_cell, quantity_cells, shown_value, with_headings
from exu_press.quantities.uncertain import CELL, bracket_legend
from exu_press.quantities.value import Value, values_of
from exu_press.result import Result
from exu_press.result.windows import NEARLY
from exu_press.schema.csv_table import Value as CsvValue
from exu_press.studies.compare import different_keys
from exu_press.studies.equal_windows import with_equal_windows
from exu_press.terminal.columns import Notes, columns

__all__ = ["Comparison", "compare_results"]

TITLE = 36
"""Letters of the first column."""

READ_FROM = "read from revolutions"


@dataclass(frozen=True)
class Comparison:
    """Runs beside each other, read from the same revolutions."""

    results: Mapping[str, Result]

    @cached_property
    def common_window(self) -> tuple[Mapping[str, Result], str]:
        """Return the runs with equal windows, and what was done for that, or nothing."""
        return with_equal_windows(self.results)

    @property
    def differences(self) -> list[list[str]]:
        """Return the keys in which the scenes differ, and the windows where they do: rows."""
        rows = different_keys({label: run.scene for label, run in self.results.items()})[1:]
        spans = [span_text(Reading(run)) for run in self.common_window[0].values()]
        if not self._have_one_window:
            rows.append([READ_FROM, *(span.partition(",")[0] for span in spans)])
        states = [str(run.info["status"]) for run in self.results.values()]
        return rows if len(set(states)) == 1 else [*rows, ["status", *states]]

    @property
    def common_facts(self) -> str:
        """Return what all runs have in common, in words."""
        runs = list(self.results.values())
        words = describe([run.scene for run in runs]).replace("\n", SEPARATOR).split(SEPARATOR)
        tolerances = {run.scene.solver.tolerance for run in runs} - {None}
        words += [f"tolerance {tolerances.pop():g}"] if len(tolerances) == 1 else []
        states = {str(run.info["status"]) for run in runs}
        words += states if len(states) == 1 else []
        if self._have_one_window:
            first = next(iter(self.common_window[0].values()))
            words.append(f"{READ_FROM} {span_text(Reading(first))}")
        return "; ".join(words).replace("²", "^2")

    @property
    def _have_one_window(self) -> bool:
        """Return whether all are read from the same revolutions; a flexible crank is twisted."""
        spans = np.array([Reading(run).span for run in self.common_window[0].values()])
        return bool(np.ptp(spans, axis=0).max() < NEARLY)

    def cells(self, *, wide: bool = True) -> dict[str, list[list[str]]]:
        """Return rows of quantities by heading, a cell for each run."""
        return quantity_cells(self.common_window[0], shown_value if wide else narrow_cell)

    def lines(self, *, wide: bool = False) -> list[str]:
        """Return the table, of at most 100 columns for up to five runs unless it is wide."""
        cells, rows = self.cells(wide=wide), self.differences
        table = with_headings({"differences": rows, **cells} if rows else cells)
        labels, notes = list(self.results), Notes()
        if wide:
            body, legend = columns([["", *labels], *table]), []
        else:
            headers = [("", ""), *(notes.header(label, CELL) for label in labels)]
            head = [list(line) for line in zip(*headers, strict=True)]
            widths, heading = [TITLE, *[CELL] * len(labels)], [WIDTH] * len(table[0])
            fitted = [
                list(map(notes.cell, row, widths if any(row[1:]) else heading)) for row in table
            ]
            head = head if any(head[0]) else head[1:]
            body = columns([*head, *fitted], right=True, gap=1)
            legend = [bracket_legend(itertools.chain(*cells.values()))]
        above = self._wrap([self.common_facts, self.common_window[1], *notes.lines])
        pairs = difference_lines(self.common_window[0]) if wide or len(labels) == 2 else []
        below = self._wrap([*legend, *remarks(self.common_window[0])])
        return [*above, "", *body, "", *below, *pairs]

    @staticmethod
    def _wrap(texts: Sequence[str]) -> list[str]:
        return [line for text in texts for line in textwrap.wrap(text, WIDTH)]

    def columns(self) -> dict[str, list[CsvValue]]:
        """Return every quantity, SI, with its error and bounds in each run, as columns of a CSV."""
        runs = {label: values_of(run) for label, run in self.common_window[0].items()}
        names = list(dict.fromkeys(name for values in runs.values() for name in values))
        known: list[list[Value | None]] = [[v.get(name) for name in names] for v in runs.values()]
        units = [next(v[name].unit for v in runs.values() if name in v) for name in names]
        table: dict[str, list[CsvValue]] = {"quantity": [*names], "unit": [*units]}
        for label, values in zip(runs, known, strict=True):
            for entry in ("value", "error", "low", "high", "determined"):
                column = label if entry == "value" else f"{label}, {entry}"
                table[column] = [getattr(value, entry, None) for value in values]
        return table

    def view(self) -> object:
        """Return the page with their curves over each other; a notebook shows it."""
        from exu_press import page_of

        return page_of(self)

    def __str__(self) -> str:
        return "\n".join(self.lines())

    __repr__ = __str__

    def _repr_html_(self) -> str:
        """Return the differences of the scenes, and the quantities."""
        from exu_press import cell

        return cell(self)


def compare_results(results: Sequence[Result], labels: Sequence[str]) -> Comparison:
    """Return runs beside each other, labelled by their kinds of bodies and joints unless told.

    Raises:
        InputError: a run is none, or labels are not as many as runs, or two are the same.
    """
    for result in results:
        if not isinstance(result, Result):
            raise InputError(
                f"compare: {result!r:.200} is no run; allowed are results, as simulate or "
                "Result.load returns them"
            )
    names = list(labels)
    if not names:
        kinds = [_kind(result) for result in results]
        names = [
            kind if kinds.count(kind) == 1 else f"{kind} {kinds[: k + 1].count(kind)}"
            for k, kind in enumerate(kinds)
        ]
    if len(set(names)) != len(results) or len(names) != len(results):
        raise InputError(
            f"labels = {names!r}: allowed are as many different ones as runs, {len(results)}"
        )
    return Comparison(dict(zip(names, results, strict=True)))


def _kind(result: Result) -> str:
    """Return the kinds of a run's bodies and of its joints in words."""
    kinds = {joint.kind for joint in result.scene.joints.values()}
    joints = next((kind for kind in ("lubricated", "dry") if kind in kinds), "ideal")
    return f"{'flexible' if result.scene.bodies else 'rigid'} {joints}"
