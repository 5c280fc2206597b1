"""The report of a fit: measured beside computed, and how well its keys are determined."""

from pathlib import Path
from typing import Any

import numpy as np

from exu_press.page import Live
from exu_press.page.lines import Line, Panel, lines_viewer
from exu_press.plots.words import ONE_LINE, describe
from exu_press.report.html import paragraph, table
from exu_press.report.study import reading, study_page
from exu_press.scene import Scene
from exu_press.scene.file import scene_tables
from exu_press.studies.fit.lines import inexact
from exu_press.studies.fit.profile import between
from exu_press.studies.sweep.units import shown_unit, unit_of, with_unit

__all__ = ["fit_report"]


def fit_report(file: Path) -> str:
    """Return the page of a fit, from fit.json and fitted.toml beside it."""
    with reading(file, "a fit of exu_press") as told:
        keys = [_key(name, one) for name, one in told["keys"].items()]
        numbers = [_number(one) for one in told["measured"]]
        live = _live(told)
        inexact_runs = inexact(told["largest_error_over_uncertainty"])
        chi_square = f"{told['chi_square']:.4g} with {told['degrees_of_freedom']:g}"
    # complete: nothing is asked
    scene = Scene.from_dict(scene_tables(file.parent / "fitted.toml"), resolve=False)
    return study_page(
        file,
        f"Fit: {describe([scene], ONE_LINE)}",
        f"chi-square {chi_square} degrees of freedom",
        [
            ("Keys", table(("key", "unit", "value", "low", "high"), keys)),
            ("Measured and computed", live),
            (
                "Numbers",
                table(("number", "measured", "uncertainty", "computed"), numbers)
                if numbers
                else paragraph("None was measured; there are curves."),
            ),
            *(("Errors of the runs", paragraph(text)) for text in inexact_runs),
        ],
        "The fit as it was drawn.",
        scene=scene,
    )


def _key(name: str, one: dict[str, Any]) -> list[str]:
    ends = [
        f"{one[end]:.6g}" + (f" ({remark})" if (remark := one[f"{end}_remark"]) else "")
        for end in ("low", "high")
    ]
    return [name, unit_of(name), f"{one['value']:.6g}", *ends]


def _number(one: dict[str, Any]) -> list[str]:
    values = [one[part] for part in ("value", "uncertainty", "computed")]
    name = str(one["name"])
    unit, scale = shown_unit(name.partition(", ")[0], values[:1])
    texts = ("-" if value is None else f"{scale * value:.6g}" for value in values)
    return [with_unit(name, unit), *texts]


def _live(told: dict[str, Any]) -> Live | None:
    """Return the curves, the numbers in uncertainties, and chi-square over each key."""
    panels = [
        Panel(
            f"Curve {name}",
            curve["across"],
            f"{curve['channel']}, {curve['unit']}",
            [
                Line("measured", curve["at"], curve["measured"], points=True),
                Line("computed, through the sensor", curve["at"], curve["computed"]),
            ],
        )
        for name, curve in told["curves"].items()
    ]
    measured = [one for one in told["measured"] if one["uncertainty"]]
    if measured:
        far = [(one["computed"] - one["value"]) / one["uncertainty"] for one in measured]
        errors = [one["error_over_uncertainty"] or 0.0 for one in measured]
        low = [f - e for f, e in zip(far, errors, strict=True)]
        high = [f + e for f, e in zip(far, errors, strict=True)]
        line = Line("(computed - measured) / uncertainty", range(len(far)), far, True, low, high)
        panels.append(Panel("Numbers", "place in the table below", "in uncertainties", [line]))
    for name, profile in told["profiles"].items():
        if not profile:
            continue
        best = told["keys"][name]["value"]
        values, rises = between(np.array(profile), best, max(rise for _, rise in profile) or 1.0)
        line = Line("chi-square above its least", values.tolist(), rises.tolist())
        at, risen = zip(*profile, strict=True)
        fits = Line("other keys fitted again", at, risen, points=True)
        panels.append(
            Panel(f"How well {name} is determined", with_unit(name), "chi-square", [line, fits])
        )
    return lines_viewer(panels)
