"""The report of one run."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from exu_press.page import Live
from exu_press.page.viewer import viewer
from exu_press.plots.words import ONE_LINE, describe, joint_in_words
from exu_press.quantities import Quantity, value_of
from exu_press.quantities.catalogue import CATALOGUE
from exu_press.quantities.cost import COSTS
from exu_press.quantities.energy import BALANCE, has_balance
from exu_press.quantities.kind import LOAD
from exu_press.quantities.quantity import Owner
from exu_press.quantities.reading import Reading
from exu_press.quantities.remarks import remarks, span_text
from exu_press.quantities.table import quantity_cells, shown_value, with_headings
from exu_press.quantities.value import values_of
from exu_press.report.html import details, page, paragraph, stills, table, warnings
from exu_press.report.page_file import ALL, Span
from exu_press.result import Result
from exu_press.result.windows import interval
from exu_press.scene import Scene
from exu_press.scene.assumptions import engineering_values, keys_of, used_assumptions
from exu_press.scene.provenance import Provenance, rows_of

__all__ = [
    "changed_keys",
    "joint_table",
    "live_part",
    "provenance_section",
    "run_page",
    "scene_parts",
    "warnings_of",
]


FEW = 3
"""Joints with clearance that need no table of their own."""


def joint_table(result: Result) -> str:
    """Return a table of all joints, those with the largest forces first; nothing where few are."""
    if len(result.clearance_joints) <= FEW:
        return ""
    values, joints = values_of(result), result.scene.joints
    quantities = [q for q in CATALOGUE if q.owner is Owner.JOINT and q.title]
    forces = next(q for q in quantities if q.kind is LOAD)
    names = [name for name in joints if values[forces.full_name(name)].value is not None]
    rows = []
    for name in sorted(names, key=lambda name: -(values[forces.full_name(name)].value or 0.0)):
        joint = joints[name]
        clearance = f"{joint.clearance * 1e6:g}" if joint.clearance else "-"
        texts = [
            shown_value(quantity, values[quantity.full_name(name)])
            if quantity.full_name(name) in values
            else "-"
            for quantity in quantities
        ]
        rows.append([joint_in_words(name), joint.kind, clearance, *texts])
    return table(
        ("joint", "kind", "clearance, um", *(q.head for q in quantities)), rows, "All joints"
    )


HEAD = ("key", "value", "unit", "meaning")

MOST_NUMBERS = 4
"""Numbers of a list that are shown one by one."""


def run_page(result: Result, source: str, span: Span, pictures: Callable[[], str]) -> str:
    """Return the page of a run; its pictures are asked for when all else is there."""
    summary = result.summary()
    numbers = with_headings(quantity_cells({"": result}))
    results = table(("quantity", "value"), numbers) + joint_table(result)
    window = f"Read from revolutions {span_text(Reading(result))}."
    texts = [window, *remarks({"": result})]
    live = live_part({"": result}, span)
    return page(
        describe([result.scene], ONE_LINE),
        f"{source}: {summary['status']} at t = {summary['end_time']:.6g} s, "
        f"crank angle {np.degrees(result['crank_angle'][-1]):.1f}°",
        [
            ("In motion", live),
            ("Warnings", warnings(warnings_of(summary))),
            ("Results", "".join(map(paragraph, texts)) + results),
            ("Pictures", stills(pictures(), live)),
            ("Energy and solver", _energy_and_solver(result)),
            ("Provenance", provenance_section({"": result.info.get("provenance")})),
            *scene_parts(result.scene),
        ],
    )


def live_part(results: Mapping[str, Result], span: Span = ALL) -> Live | None:
    """Return the live part of the page of runs; nothing without the extra `page`."""
    ends = {label: interval(result, *span) for label, result in results.items()}
    return viewer(results, ends if span != ALL else None)


def changed_keys(scene: Scene) -> str:
    """Return a table of the keys that a scene gives."""
    keys = keys_of(scene).values()
    changed = [_row(key.name, key.value, key.unit, key.meaning) for key in keys if key.is_changed]
    if not changed:
        return paragraph("Every key is at its default.")
    return table(HEAD, changed, "Keys that differ from their defaults")


def scene_parts(scene: Scene) -> list[tuple[str, str]]:
    """Return the sections about the scene: changed keys, assumptions, every key."""
    keys = keys_of(scene).values()
    everything = [
        _row(key.name, key.value, key.unit, key.meaning, "assumed" if key.is_assumed else "given")
        for key in keys
    ]
    assumed = [
        [f"A-{assumption.number}", assumption.text, ", ".join(map(str, assumed_keys))]
        for assumption, assumed_keys in used_assumptions(scene).items()
    ]
    assumed += [[key.source, key.meaning, str(key)] for key in engineering_values(scene)]
    every = details("every key", table((*HEAD, "default?"), everything))
    return [
        ("Scene", changed_keys(scene) + every),
        (
            "Assumptions",
            paragraph(
                "Assumptions of this scene: engineering values with their source, "
                "and numbered gaps and misprints of the paper. "
                "Each key can be set in the scene."
            )
            + table(("source", "assumption", "default assumed"), assumed),
        ),
    ]


def warnings_of(summary: Mapping[str, Any]) -> list[str]:
    """Return how a run ended, unless it completed, and its warnings."""
    ended = [f"{summary['status']}: {summary['reason']}"] if summary["reason"] else []
    return [*ended, *summary["warnings"]]


def provenance_section(provenances: Mapping[str, Provenance | None]) -> str | None:
    """Return tables of provenance by label; None where files of older versions have none."""
    tables = [
        table(("", "value"), rows_of(provenance), label)
        for label, provenance in provenances.items()
        if provenance is not None
    ]
    return "\n".join(tables) or None


def _energy_and_solver(result: Result) -> str:
    energy = _quantity_table(result, BALANCE, "Energy") if has_balance(result) else ""
    versions = [[f"version of {name}", text] for name, text in result.info["versions"].items()]
    return energy + _quantity_table(result, COSTS, "Solver", versions)


def _quantity_table(
    result: Result, quantities: Iterable[Quantity], title: str, more: list[list[str]] | None = None
) -> str:
    """Return a table of quantities in words, those that the run does not have left out."""
    read = [(quantity, value_of(result, quantity.name)) for quantity in quantities]
    values = [(quantity.in_scaled_unit([value.value or 0.0]), value) for quantity, value in read]
    rows = [
        [quantity.meaning, f"{shown_value(quantity, value)} {quantity.display_unit}"]
        for quantity, value in values
        if value.value is not None
    ]
    return table(("", "value"), [*rows, *(more or [])], title)


def _row(name: str, value: Any, *rest: str) -> list[str]:
    text = str(value).lower() if isinstance(value, bool) else str(value)
    if isinstance(value, tuple) and len(value) > MOST_NUMBERS:
        text = f"{len(value)} numbers from {min(value):g} to {max(value):g}"
    return [name, f"{value:.10g}" if isinstance(value, float) else text, *rest]
