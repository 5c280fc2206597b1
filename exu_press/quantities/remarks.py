"""Text around the table of runs: their window, what it does not show, what surely differs."""

import itertools
import textwrap
from collections.abc import Mapping

import numpy as np

from exu_press.quantities.dead_centre import ideal_angles
from exu_press.quantities.quantity import Owner
from exu_press.quantities.reading import Reading
from exu_press.quantities.table import (
    in_words,
    lines_by_heading,
    narrow_cell,
    quantity_cells,
    titled_quantities,
    with_headings,
)
from exu_press.quantities.uncertain import bracket_legend
from exu_press.quantities.value import values_of
from exu_press.result import Result
from exu_press.result.windows import NEARLY
from exu_press.terminal.columns import columns

__all__ = ["WIDTH", "difference_lines", "remarks", "run_lines", "span_text"]

NEAR_CENTRE = 2e-3
"""Revolutions within which a dead centre of the ideal slider is known."""

CENTRES = {
    "stroke": (2, "both dead centres"),
    "swing": (2, "both dead centres"),
    "bottom_dead_centre": (1, "the dead centre itself"),
    "least_angle": (1, "the dead centre itself"),
}
"""Of a quantity, the number of dead centres that it needs, the bottom one first, and their name."""

WIDTH = 100
"""Letters of a line."""


def remarks(results: Mapping[str, Result]) -> list[str]:
    """Return what the table of runs by label does not show: strokes of parts, and what none has."""
    values = {label: values_of(result) for label, result in results.items()}
    texts = []
    for name, (centres, without) in CENTRES.items():
        parts = [
            label
            for label, result in results.items()
            if name in values[label]
            and "crank_angle" in result
            and _is_part(Reading(result), centres)
        ]
        if parts:
            runs = f" ({', '.join(parts)})" if len(results) > 1 else ""
            title = name.replace("_", " ")
            texts.append(f"{title}: of the part that was run, without {without}{runs}.")
    declared = {name for of_run in values.values() for name in of_run}
    read = {name for v in values.values() for name in v if v[name].value is not None}
    missing = []
    for titled in titled_quantities(results).values():
        of_run = [quantity for quantity in titled if quantity.owner is Owner.RUN]
        missing += [
            words
            for quantity, words in zip(of_run, in_words(of_run), strict=True)
            if quantity.name in declared - read
        ]
    if missing and len(results) > 1:
        why = "too short, or without what they are read from"
        texts.append(f"In no run ({why}): {'; '.join(missing)}.")
    return texts


def _is_part(run: Reading, centres: int) -> bool:
    """Return whether a run misses the output's bottom dead centre or, of two centres, any."""
    first, last = run["crank_angle"][[0, -1]] / (2.0 * np.pi)
    return any(
        np.ceil(first - about - NEAR_CENTRE) > last - about + NEAR_CENTRE
        for about in np.array(ideal_angles(run.mechanism)[:centres]) / (2.0 * np.pi)
    )


def run_lines(result: Result) -> list[str]:
    """Return one run's quantities, a line each, below its status and its window."""
    head = f"{result.info['status']}; read from revolutions {span_text(Reading(result))}"
    rows = quantity_cells({"": result}, narrow_cell)
    legend = bracket_legend(itertools.chain(*rows.values()))
    table = with_headings(rows)
    texts = [legend, *remarks({"": result})]
    return [head, *columns(table), *(x for text in texts for x in textwrap.wrap(text, WIDTH))]


def span_text(run: Reading) -> str:
    """Return the revolutions from which quantities are read."""
    begin, end = (f"{round(turn, 4):g}" for turn in run.span)
    return f"{begin} to {end}{'' if run.span[0] > NEARLY else ', with the start'}"


def difference_lines(results: Mapping[str, Result]) -> list[str]:
    """Return in which quantities two runs may be the same, pair by pair, where errors are known."""
    bounds_of_rows = [
        (
            words if line.quantity.owner is Owner.RUN else f"{heading.partition(' (')[0]}: {words}",
            [
                None if v is None or v.low is None or v.high is None else (v.low, v.high)
                for v in line.values
            ],
        )
        for heading, rows in lines_by_heading(results).items()
        for line, words in zip(rows, in_words(line.quantity for line in rows), strict=True)
    ]
    lines = []
    for (i, first), (j, second) in itertools.combinations(enumerate(results), 2):
        unknown = [label for label in (first, second) if not results[label].info.get("errors")]
        if len(unknown) == 2:
            continue
        different = [
            (words, a, b)
            for words, bounds in bounds_of_rows
            if (a := bounds[i]) is not None and (b := bounds[j]) is not None and a != b
        ]
        unsure = [words for words, a, b in different if a[0] <= b[1] and b[0] <= a[1]]
        statement = "all differences exceed their errors"
        statement += f", except in {'; '.join(unsure)}" * bool(unsure)
        if unknown:
            statement = f"{unknown[0]} has no errors, so that no difference is sure"
        elif not different:
            statement = "no figure differs"
        lines += textwrap.wrap(f"{first}, {second}: {statement}", WIDTH, subsequent_indent="  ")
    return lines
