"""The live part of a study's page: its runs as points, as lines over all keys, and in its table."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from exu_press.page.blocks import Blocks
from exu_press.page.document import Live, cached_figures, data_element, has_library, scripts, styles
from exu_press.plots.typesetting import typeset
from exu_press.studies.base.report import Column, Points

__all__ = ["study_viewer"]

MOST_PARALLEL = 4
"""Axes for quantities beside those for the keys."""


def study_viewer(points: Points) -> Live | None:
    """Return the live part of a study's page; nothing without the extra `page`."""
    if not has_library():
        return None
    blocks = Blocks()
    keys, quantities = points.keys, points.quantities
    columns = [*keys, *quantities]
    across = points.across or columns[0].name
    data = {
        "columns": [_column(column, blocks) for column in columns],
        "keys": [key.name for key in keys],
        "side": [column.name for column in (*keys, *quantities[:MOST_PARALLEL])],
        "across": across,
        "up": points.up or (quantities or keys)[0].name,
        "colour": points.colour or next((key.name for key in keys if key.name != across), ""),
        "told": list(points.labels),
        **cached_figures("points_and_lines"),
    }
    body = "\n".join([LAYOUT, blocks.html(), data_element("page-data", data)])
    return Live(body, scripts("data", "theme", "study"), styles())


def _column(column: Column, blocks: Blocks) -> dict[str, Any]:
    """Return a column as the script has it: numbers, or texts by their number in a list."""
    texts = sorted({str(value) for value in column.values if isinstance(value, (str, bool))})
    if texts:
        numbers = [
            texts.index(str(value)) if value is not None else None for value in column.values
        ]
    else:
        numbers = list(column.values)
    entry: dict[str, Any] = {
        "name": column.name,
        "head": typeset(f"{column.name}, {column.unit}" if column.unit else column.name),
        "texts": texts,
        "values": blocks.add(_numbers(numbers), "f8"),
    }
    if column.low is not None and column.high is not None:
        entry["low"] = blocks.add(_numbers(column.low), "f8")
        entry["high"] = blocks.add(_numbers(column.high), "f8")
    return entry


def _numbers(values: Sequence[float | None]) -> Any:
    return np.array([np.nan if value is None else value for value in values], dtype=float)


LAYOUT = """
<div id="viewer" class="live" hidden>
<div class="bar" role="toolbar" aria-label="what is shown">
<label>across <select id="across"></select></label>
<label><input type="checkbox" id="log-x"> log</label>
<label>up <select id="up"></select></label>
<label><input type="checkbox" id="log-y"> log</label>
<label>colour <select id="colour"></select></label>
<label>drag <select id="drag"><option value="zoom">zooms</option>
<option value="pan">moves</option></select></label>
<button type="button" id="whole">everything</button>
</div>
<div class="stage studies">
<div class="curves"><div class="plot" id="points"></div>
<div id="legend"></div>
<p id="near" class="told" role="status"></p></div>
<div class="curves" id="keys-beside"><div class="plot" id="parallel"></div>
<div class="bar"><button type="button" id="clear">all runs</button>
<span class="told">Drag along an axis: the runs in that range stay.</span></div></div>
</div>
<div id="chosen" role="region" aria-live="polite" aria-label="the run that was opened"></div>
</div>
<p id="failed" class="warnings" role="alert" hidden></p>
"""
