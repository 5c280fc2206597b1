"""Quantities of runs beside each other: a line for each quantity and owner, a column a run."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from exu_press.quantities.catalogue import CATALOGUE, GROUPS
from exu_press.quantities.kind import LOAD
from exu_press.quantities.observed import with_observed
from exu_press.quantities.quantity import Owner, Quantity
from exu_press.quantities.uncertain import bracket_text, uncertain
from exu_press.quantities.value import Value, values_of
from exu_press.result import Result
from exu_press.scene import mechanism_of

__all__ = [
    "QuantityLine",
    "in_words",
    "lines_by_heading",
    "narrow_cell",
    "quantity_cells",
    "shown_value",
    "titled_quantities",
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

HORIZON = "predictability horizon, ms"

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
    lines: dict[str, list[QuantityLine]] = {}
    for heading, titled in titled_quantities(results).items():
        of_run = [quantity for quantity in titled if quantity.owner is Owner.RUN]
        lines[heading] = _lines(of_run, runs, [""])
        for kind in dict.fromkeys(q.owner for q in titled if q.owner is not Owner.RUN):
            of_kind = [quantity for quantity in titled if quantity.owner is kind]
            for name, owners in _shown_owners(kind, of_kind, results, runs).items():
                lines.setdefault(name, []).extend(_lines(of_kind, runs, owners))
    return {heading: rows for heading, rows in lines.items() if rows}


def titled_quantities(results: Mapping[str, Result]) -> dict[str, list[Quantity]]:
    """Return the quantities that have lines, by the heading of their group."""
    in_group = {quantity for quantities in GROUPS.values() for quantity in quantities}
    own = [quantity for quantity in CATALOGUE if quantity not in in_group]
    return {
        heading: [
            observed
            for quantity in quantities
            for observed in dict.fromkeys(
                o for run in results.values() for o in with_observed([quantity], run.scene)
            )
            if observed.title
        ]
        for heading, quantities in {**GROUPS, OWN: own}.items()
    }


def in_words(quantities: Iterable[Quantity]) -> Iterator[str]:
    """Yield the titles of quantities in their order, a detail's behind that of its quantity."""
    main = ""
    for quantity in quantities:
        main = main if quantity.is_detail else quantity.title
        yield f"{main}, {quantity.title}" if quantity.is_detail else main


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
