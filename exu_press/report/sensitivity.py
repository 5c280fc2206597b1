"""The report of a sensitivity study: every press of the sample, spreads, and shares by key."""

from pathlib import Path
from typing import Any

from exu_press.page import Live
from exu_press.page.study import study_viewer
from exu_press.plots.words import ONE_LINE, describe
from exu_press.report.html import table
from exu_press.report.study import command_of, reading, shown_column, study_page
from exu_press.scene import Scene
from exu_press.schema.csv_table import Value, read_csv
from exu_press.schema.stored import from_json
from exu_press.studies.sweep.units import shown_unit, with_unit

__all__ = ["sensitivity_report"]

SPREADS = ("quantity", "5 %", "50 %", "95 %", "standard deviation", "half width", "error of a run")
SHARES = ("key", "alone", "with others", "at its 5 %", "at its 95 %")


def sensitivity_report(file: Path) -> str:
    """Return the page of a sensitivity study, from sensitivity.json and samples.csv beside it."""
    with reading(file, "a sensitivity study of exu_press") as told:
        study = from_json(dict[str, Any], file.with_name("study.json").read_bytes(), "study.json")
        scene, keys = Scene.from_dict(study["scene"], resolve=False), list(study["keys"])
        samples = read_csv(file.with_name("samples.csv"))
        quantities = told["quantities"]
        spreads = [_spread(name, one) for name, one in quantities.items()]
        shares = [
            (f"Shares: {name}", table(SHARES, _shares(name, one)))
            for name, one in quantities.items()
            if one["moves"]
        ]
        live = _live(samples, keys, quantities)
        runs = str(told["runs"][0])
    return study_page(
        file,
        f"Sensitivity: {describe([scene], ONE_LINE)}",
        runs,
        [("Presses of the sample", live), ("Spreads", table(SPREADS, spreads)), *shares],
        "Spreads, changes by one key, shares of the variance.",
        scene=scene,
    )


def _spread(name: str, one: dict[str, Any]) -> list[str]:
    """Return a quantity as a line of the table, in the unit that is shown."""
    unit, scale = shown_unit(name, filter(None, [one["percentiles"]["50"]]))
    ends = [one["percentiles"][part] for part in ("5", "50", "95")]
    numbers = [*ends, one["deviation"], one["half_width"], one["error_of_a_run"]]
    digits = (8, 8, 8, 3, 3, 2)
    cells = [
        "" if value is None else f"{value * scale:.{n}g}"
        for value, n in zip(numbers, digits, strict=True)
    ]
    return [with_unit(name, unit), *cells]


def _shares(name: str, one: dict[str, Any]) -> list[list[str]]:
    """Return each key's indices, the largest first, and the quantity at the key's two ends."""
    _, scale = shown_unit(name, filter(None, [one["percentiles"]["50"]]))
    found = sorted(one["keys"].items(), key=lambda pair: -pair[1]["total_order"]["value"])
    rows = []
    for key, entry in found:
        indices = [
            f"{part['value']:.2f} ({part['low']:.2f} to {part['high']:.2f})"
            for part in (entry["first_order"], entry["total_order"])
        ]
        ends = ["failed" if end is None else f"{end * scale:.8g}" for end in entry["alone"]]
        rows.append([key, *indices, *ends])
    return rows


def _live(
    samples: dict[str, tuple[Value, ...]], keys: list[str], quantities: dict[str, Any]
) -> Live | None:
    """Return the presses of the sample as points, a quantity over the key that decides it."""
    first, entry = next(iter(quantities.items()))
    most = keys[0]
    if entry["moves"]:
        most = max(keys, key=lambda key: float(entry["keys"][key]["total_order"]["value"]))
    rows = zip(*(samples[key] for key in keys), strict=True)
    opens = [command_of(dict(zip(keys, row, strict=True))) for row in rows]
    varied, found = ([shown_column(n, samples[n]) for n in each] for each in (keys, quantities))
    return study_viewer(varied, found, opens, (most, first))
