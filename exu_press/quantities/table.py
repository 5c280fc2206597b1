"""Quantities of runs beside each other: a line for each quantity and owner, a column a run."""

import itertools
import textwrap
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from exu_press.quantities.catalogue import CATALOGUE, GROUPS
from exu_press.quantities.dead_centre import ideal_angles
from exu_press.quantities.kind import LOAD
from exu_press.quantities.observed import with_observed
from exu_press.quantities.quantity import Owner, Quantity
from exu_press.quantities.reading import Reading
from exu_press.quantities.uncertain import bracket_legend, bracket_text, uncertain
from exu_press.quantities.value import Value, values_of
from exu_press.result import Result
from exu_press.result.info import Error
from exu_press.result.windows import NEARLY
from exu_press.scene import mechanism_of
from exu_press.terminal.columns import columns

__all__ = [
    "WIDTH",
    "QuantityLine",
    "difference_lines",
    "lines_by_heading",
    "narrow_cell",
    "quantity_cells",
    "remarks",
    "run_lines",
    "shown_value",
    "span_text",
    "with_headings",
]

ALIKE = 1e-2
"""Members of a group that differ by less, relatively, are shown as one, with the larger values."""

OWN, RUN_ITSELF = "further quantities", "the run itself"
"""Headings of quantities of the user's own, and of costs."""

SINGULAR = {
    Owner.JOINT: "joint",
    Owner.GUIDE: "guide of",
    Owner.GEAR: "gear",
    Owner.SPRING: "spring",
    Owner.LOAD: "load",
    Owner.BODY: "body",
}

NEAR_CENTRE = 2e-3
"""Revolutions within which a dead centre of the ideal slider is known."""

CENTRES = {
    "stroke": (2, "both dead centres"),
    "swing": (2, "both dead centres"),
    "bottom_dead_centre": (1, "the dead centre itself"),
    "least_angle": (1, "the dead centre itself"),
}
"""Of a quantity, the number of dead centres that it needs, the bottom one first, and their name."""

HORIZON = "predictability horizon, ms"

WIDTH = 100
"""Letters of a line."""

Cell = Callable[[Quantity, Value], str]


@dataclass(frozen=True)
class QuantityLine:
    """A quantity of one owner in every run.

    Attributes:
        quantity: in the unit that is shown.
        title: with its unit, unless the line above has the same.
        values: one a run, None where a run has no such quantity.
    """

    quantity: Quantity
    title: str
    values: tuple[Value | None, ...]

    def cells(self, cell: Cell) -> list[str]:
        """Return title and values as texts."""
        values = ("-" if value is None else cell(self.quantity, value) for value in self.values)
        return [self.title, *values]


def shown_value(quantity: Quantity, value: Value) -> str:
    """Return a value in the unit that tables show, with its error where that is known."""
    return uncertain(value.value, value.to_dict(), quantity.scale, quantity.digits)


def narrow_cell(quantity: Quantity, value: Value) -> str:
    """Return a value in the unit that tables show, with its error in brackets."""
    return bracket_text(value.value, value.to_dict(), quantity.scale, quantity.digits)


def lines_by_heading(results: Mapping[str, Result]) -> dict[str, list[QuantityLine]]:
    """Return the lines of runs by label under their headings: groups of quantities, then owners.

    A joint has lines where it has clearance in one of the runs; where none has, the most loaded one
    does. Members of a group whose values are alike have one heading and the larger values.
    """
    runs = [values_of(result) for result in results.values()]
    in_group = {quantity for quantities in GROUPS.values() for quantity in quantities}
    own = [quantity for quantity in CATALOGUE if quantity not in in_group]
    lines: dict[str, list[QuantityLine]] = {}
    for heading, quantities in {**GROUPS, OWN: own}.items():
        titled = [
            observed
            for quantity in quantities
            for observed in dict.fromkeys(
                o for run in results.values() for o in with_observed([quantity], run.scene)
            )
            if observed.title
        ]
        of_run = [quantity for quantity in titled if quantity.owner is Owner.RUN]
        lines[heading] = _lines(of_run, runs, [""])
        for kind in dict.fromkeys(q.owner for q in titled if q.owner is not Owner.RUN):
            of_kind = [quantity for quantity in titled if quantity.owner is kind]
            for name, owners in _shown_owners(kind, of_kind, results, runs).items():
                lines.setdefault(name, []).extend(_lines(of_kind, runs, owners))
    return {heading: rows for heading, rows in lines.items() if rows}


def quantity_cells(
    results: Mapping[str, Result], cell: Cell = shown_value
) -> dict[str, list[list[str]]]:
    """Return rows of texts by heading, the title first, then a cell for each run."""
    cells = {
        heading: [line.cells(cell) for line in lines]
        for heading, lines in lines_by_heading(results).items()
    }
    horizons = [uncertain(r.info.get("horizon"), None, 1e3) for r in results.values()]
    if set(horizons) != {"-"}:
        cells.setdefault(RUN_ITSELF, []).insert(0, [HORIZON, *horizons])
    return cells


def with_headings(cells: Mapping[str, Sequence[Sequence[str]]]) -> list[list[str]]:
    """Return rows in one table, below their headings."""
    table: list[list[str]] = []
    for heading, rows in cells.items():
        table.append([heading, *[""] * (len(rows[0]) - 1)])
        table += [[f"  {row[0]}", *row[1:]] for row in rows]
    return table


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
    titled = {
        quantity.name
        for result in results.values()
        for quantity in with_observed(CATALOGUE, result.scene)
        if quantity.owner is Owner.RUN and quantity.title
    }
    read = {name for v in values.values() for name in v if v[name].value is not None}
    declared = dict.fromkeys(name for of_run in values.values() for name in of_run)
    missing = [name for name in declared if name in titled - read]
    if missing and len(results) > 1:
        why = "too short, or without what they are read from"
        texts.append(f"No run has {', '.join(missing)} ({why}).")
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


def _lines(
    quantities: Iterable[Quantity], runs: Sequence[Mapping[str, Value]], owners: Sequence[str]
) -> list[QuantityLine]:
    """Return the lines of quantities that some runs have, of the owner with the larger values."""
    lines: list[QuantityLine] = []
    unit = ""
    for declared in quantities:
        values = tuple(_largest(declared, run, owners) for run in runs)
        known = [v for v in values if v is not None and v.value is not None]
        if known:
            sizes = (abs(v.value or 0.0) + (v.error or 0.0) for v in known)
            quantity = declared.in_scaled_unit(sizes)
            own = quantity.display_unit
            says_unit = own and not (quantity.is_detail and own == unit)
            title = f"{'  ' * quantity.is_detail}{quantity.title}{f', {own}' * bool(says_unit)}"
            lines.append(QuantityLine(quantity, title, values))
            unit = own
    return lines


def _largest(quantity: Quantity, run: Mapping[str, Value], owners: Sequence[str]) -> Value | None:
    values = [run[name] for owner in owners if (name := quantity.full_name(owner)) in run]
    return max(values, key=lambda value: abs(value.value or 0.0), default=None)


def _shown_owners(
    kind: Owner,
    quantities: Sequence[Quantity],
    results: Mapping[str, Result],
    runs: Sequence[Mapping[str, Value]],
) -> dict[str, tuple[str, ...]]:
    """Return owners by their heading; members of a group that are alike under one."""
    begin = f"{kind.value}."
    names = (name.removeprefix(begin) for run in runs for name in run if name.startswith(begin))
    owners = list(dict.fromkeys(name.split(".")[0] for name in names))
    owners_of: dict[str, tuple[str, ...]] = {owner: (owner,) for owner in owners}
    if kind is Owner.JOINT:
        loose = {name for result in results.values() for name in result.clearance_joints}
        loaded = sorted(owners, key=lambda owner: max(_loads(runs, owner), default=0.0))
        owners_of = {owner: (owner,) for owner in owners if owner in (loose or loaded[-1:])}
        for mechanism in (mechanism_of(result.scene) for result in results.values()):
            for group, members in mechanism.groups.items():
                if set(members) <= owners_of.keys() and _are_alike(members, quantities, runs):
                    first = {members[0]: (f"{group} (alike to 1 %)", members)}
                    owners_of = dict(
                        first.get(owner, (owner, names))
                        for owner, names in owners_of.items()
                        if owner not in members[1:]
                    )
    return {
        f"{SINGULAR[kind]} {name.replace('_', ' ')}": names for name, names in owners_of.items()
    }


def _loads(runs: Iterable[Mapping[str, Value]], joint: str) -> Iterator[float]:
    forces = [q.full_name(joint) for q in CATALOGUE if q.owner is Owner.JOINT and q.kind is LOAD]
    for run in runs:
        loads = (run[name].value for name in forces if name in run)
        yield next((abs(load) for load in loads if load is not None), 0.0)


def _are_alike(
    members: Sequence[str], quantities: Iterable[Quantity], runs: Iterable[Mapping[str, Value]]
) -> bool:
    """Return whether the members of a group have the same values in all runs, to ALIKE."""
    names = [[quantity.full_name(member) for member in members] for quantity in quantities]
    for run in runs:
        for of_members in names:
            values = [run[name].value or 0.0 for name in of_members if name in run]
            sizes = [abs(value) for value in values]
            if values and max(values) - min(values) > ALIKE * max(sizes):
                return False
    return True


def difference_lines(results: Mapping[str, Result]) -> list[str]:
    """Return in which quantities two runs may be the same, pair by pair, where errors are known."""
    lines = []
    for (name, first), (second_name, second) in itertools.combinations(results.items(), 2):
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
