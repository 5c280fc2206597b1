"""Quantities of runs as a table, for a terminal or a report, and their differences."""

import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any

from exu_press.quantities.catalogue import CATALOGUE
from exu_press.quantities.kind import LOAD
from exu_press.quantities.quantity import Owner, Quantity
from exu_press.quantities.reading import Reading
from exu_press.quantities.uncertain import uncertain
from exu_press.quantities.value import Value, values_of
from exu_press.result import Result
from exu_press.result.info import Error
from exu_press.scene import mechanism_of
from exu_press.terminal.columns import columns

__all__ = ["comparison_cells", "comparison_lines", "difference_lines", "run_lines", "shown_value"]

MOST_OWNERS = 3
"""Joints, guides or bodies that a line names: those with the largest loads."""

ALIKE = 1e-2
"""Members of a group that differ by less, relatively, are shown as one."""

HORIZON = "predictability horizon, ms"

Row = tuple[str, list[str]]

WIDTH = 100


def shown_value(quantity: Quantity, value: Value) -> str:
    """Return a value in the unit that tables show, with its error where that is known."""
    stated: Any = None if value.error is None else value.to_dict()
    return uncertain(value.value, stated, quantity.scale, quantity.digits)


def comparison_cells(results: Mapping[str, Result]) -> list[list[str]]:
    """Return the lines of a table as texts: the head, then a quantity a line, one column a run."""
    readings = {label: Reading(result) for label, result in results.items()}
    runs = {label: values_of(result, readings[label]) for label, result in results.items()}
    cells = [
        ["", *results],
        ["status", *(str(result.info["status"]) for result in results.values())],
        ["read from revolutions", *map(_span, readings.values())],
        [HORIZON, *(uncertain(r.info.get("horizon"), None, 1e3) for r in results.values())],
    ]
    unit = ""
    for declared in CATALOGUE:
        if declared.title:
            quantity = declared.in_scaled_unit(_sizes(declared, runs.values()))
            cell = _cell_of_run if quantity.owner is Owner.RUN else _cell_of_owners
            texts = [cell(quantity, results[label], values) for label, values in runs.items()]
            cells.append([_head(quantity, unit), *texts])
            unit = quantity.display_unit
    return [line for line in cells if set(line[1:]) != {"-"}]


def _sizes(quantity: Quantity, runs: Iterable[Mapping[str, Value]]) -> Iterator[float]:
    """Yield the magnitudes of a quantity with its error, of all owners in all runs, SI."""
    for values in runs:
        owners = [""] if quantity.owner is Owner.RUN else _owner_names(values, quantity.owner)
        declared = (values.get(quantity.full_name(owner)) for owner in owners)
        yield from (abs(v.value) + (v.error or 0.0) for v in declared if v and v.value is not None)


def comparison_lines(results: Mapping[str, Result]) -> list[str]:
    """Return a table, one column a run."""
    return columns(comparison_cells(results))


def run_lines(result: Result) -> list[str]:
    """Return one run's quantities, a line each."""
    return comparison_lines({"": result})[1:]


def _span(run: Reading) -> str:
    begin, end = run.span
    start = "" if begin > 1e-3 else ", with the start"
    return f"{begin:.3g} to {end:.3g}{start}"


def _head(quantity: Quantity, unit: str) -> str:
    """Return the head of a line; a detail has its unit where the line above has another."""
    own = quantity.display_unit
    text = quantity.title + f", {own}" * bool(own and not (quantity.is_detail and own == unit))
    return f"  {text}" if quantity.is_detail else text


def _cell_of_run(quantity: Quantity, _: Result, values: Mapping[str, Value]) -> str:
    value = values.get(quantity.name)
    return "-" if value is None else shown_value(quantity, value)


def _cell_of_owners(quantity: Quantity, result: Result, values: Mapping[str, Value]) -> str:
    """Return a quantity of its owners; alike members of a group as one, the most loaded only."""
    owners = _owner_names(values, quantity.owner)
    value_of = {
        owner: values[name] for owner in owners if (name := quantity.full_name(owner)) in values
    }
    value_of = {owner: value for owner, value in value_of.items() if value.value is not None}
    labels = {owner: owner.replace("_", " ") for owner in value_of}
    groups = mechanism_of(result.scene).groups if quantity.owner is Owner.JOINT else {}
    for group, members in groups.items():
        if value_of.keys() >= set(members) and _are_alike([value_of[member] for member in members]):
            largest = max(members, key=lambda member: abs(value_of[member].value or 0.0))
            labels[largest] = group.replace("_", " ")
            for member in set(members) - {largest}:
                labels.pop(member, None)
    listed, most = list(labels), MOST_OWNERS
    if quantity.owner is Owner.JOINT:  # those with clearance, or the most loaded ideal one
        listed = [owner for owner in listed if owner in result.clearance_joints] or listed
        most = MOST_OWNERS if result.clearance_joints else 1
    loaded = sorted(listed, key=lambda owner: -_load(values, quantity.owner, owner))[:most]
    texts = [
        f"{labels[owner]} {shown_value(quantity, value_of[owner])}"
        for owner in listed
        if owner in loaded
    ]
    rest = len(listed) - len(texts)
    return ", ".join([*texts, *[f"{rest} more"] * (rest > 0)]) or "-"


def _owner_names(values: Mapping[str, Value], kind: Owner) -> list[str]:
    begin = f"{kind.value}."
    names = (name.removeprefix(begin) for name in values if name.startswith(begin))
    return list(dict.fromkeys(name.split(".")[0] for name in names))


def _load(values: Mapping[str, Value], kind: Owner, owner: str) -> float:
    names = (q.full_name(owner) for q in CATALOGUE if q.owner is kind and q.kind is LOAD)
    loads = (values[name].value for name in names if name in values)
    return next((abs(load) for load in loads if load is not None), 0.0)


def _are_alike(values: Sequence[Value]) -> bool:
    """Return whether values are the same to a hundredth."""
    numbers = [value.value or 0.0 for value in values]
    return max(numbers) - min(numbers) <= ALIKE * max(map(abs, numbers), default=0.0)


def difference_lines(results: Mapping[str, Result]) -> list[str]:
    """Return in which quantities two runs may be the same, pair by pair, where errors are known."""
    lines = []
    for (name, first), (second_name, second) in combinations(results.items(), 2):
        stated = [run.info.get("errors", {}) for run in (first, second)]
        unknown = [
            label for label, errors in zip((name, second_name), stated, strict=True) if not errors
        ]
        if len(unknown) == 2:
            continue
        if unknown:
            statement = f"{unknown[0]} has no errors, so that no difference is sure"
        elif all(error == stated[1].get(label, error) for label, error in stated[0].items()):
            statement = "no figure differs"
        else:
            unsure = list(_unsure(*stated))
            statement = "all differences exceed their errors"
            statement += f", except in {', '.join(unsure)}" * bool(unsure)
        lines += textwrap.wrap(f"{name}, {second_name}: {statement}", WIDTH, subsequent_indent="  ")
    return lines


def _unsure(first: Mapping[str, Error], second: Mapping[str, Error]) -> Iterator[str]:
    """Yield the quantities whose bounds overlap, but are not exactly the same."""
    for name, a in first.items():
        b = second.get(name)
        if b is None or a == b:
            continue
        if a["low"] <= b["high"] and b["low"] <= a["high"]:
            yield name
