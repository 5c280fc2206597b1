"""The live part of the page of runs: their curves over each other, the mechanism in motion."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.page.blocks import Blocks
from exu_press.page.curves import Curve, curves_of, shown_unit
from exu_press.page.document import Live, cached_figures, data_element, has_library, scripts, styles
from exu_press.page.marks import dead_centres, impacts, peaks, values_on
from exu_press.page.scenery import scenery
from exu_press.page.surfaces import surfaces
from exu_press.page.thinning import Thinning, thinning
from exu_press.plots.busiest import busiest
from exu_press.plots.palette import colour_of
from exu_press.plots.typesetting import typeset
from exu_press.result import Result
from exu_press.result.channel import Channel
from exu_press.result.windows import window

__all__ = ["viewer"]

FIRST = ("slider_position", "slider_velocity", "slider_acceleration")
"""Curves that are shown at first, and the force in the busiest joint below them."""

SCRIPTS = ("data", "theme", "thin", "curves", "mechanism", "joint", "surface", "player")


def viewer(
    results: Mapping[str, Result], spans: Mapping[str, tuple[float, float]] | None = None
) -> Live | None:
    """Return the live part for one run, or for several by label; none without the extra `page`.

    Args:
        results: by label.
        spans: begin and end of each run's curves, s; None: all of them.
    """
    if not has_library():
        return None
    blocks = Blocks()
    windowed = {n: run if spans is None else window(run, *spans[n]) for n, run in results.items()}
    curves = {label: curves_of(result) for label, result in results.items()}
    thinned = thinning(
        [len(result.time) for result in windowed.values()],
        [sum(result[name][0].size for name in result) for result in windowed.values()],
    )
    runs = [
        {
            "label": label,
            "colour": colour_of(index),
            **_record_entry(windowed[label], curves[label], thinned[index], blocks),
            **_marks(result, curves[label], windowed[label]),
            "scenery": scenery(result),
            "surfaces": surfaces(windowed[label], blocks),
        }
        for index, (label, result) in enumerate(results.items())
    ]
    data = {
        "runs": runs,
        "groups": _groups(windowed, curves),
        "first": _first(results, curves),
        **cached_figures("curve_panels", tuple(run["colour"] for run in runs)),
    }
    body = "\n".join([LAYOUT, blocks.html(), data_element("page-data", data)])
    return Live(body, scripts(*SCRIPTS), styles())


def _record_entry(
    result: Result, curves: list[Curve], thinned: Thinning, blocks: Blocks
) -> dict[str, Any]:
    """Return the page's part of a run's record."""
    steps = thinned.steps
    stored = {
        channel: blocks.add(_columns(result.channels[channel], thinned))
        for channel in dict.fromkeys(curve.channel for curve in curves)
    }
    return {
        "count": thinned.count,
        "every": thinned.every,
        "time": blocks.add(result.time[steps], "f8"),
        "angle": blocks.add(np.degrees(result["crank_angle"][steps]), "f8"),
        "channels": stored,
        "curves": {curve.name: _recipe(result, curve, thinned) for curve in curves},
    }


def _marks(result: Result, curves: list[Curve], windowed: Result) -> dict[str, Any]:
    """Return the marks in the part of a run that is shown; read from all of it."""
    begin, end = float(windowed.time[0]), float(windowed.time[-1])
    impact_list, more = impacts(result)
    stated = peaks(result, curves)
    horizon, settled = result.info.get("horizon"), 60.0 / result.scene.speed_rpm
    settled *= result.scene.settle_revolutions
    return {
        "peaks": {name: mark for name, mark in stated.items() if begin <= mark["at"] <= end},
        "impacts": [mark for mark in impact_list if begin <= mark["peak"] <= end],
        "unmarked": more,
        "ends": [mark for mark in dead_centres(result) if begin <= mark["at"] <= end],
        "horizon": None if horizon is None or horizon > end else max(horizon, begin),
        "settled": settled if settled > begin else 0.0,
    }


def _columns(channel: Channel, thinned: Thinning) -> Array:
    """Return a channel as the page has it, (m, k).

    Of a thinned vector, its values at some instants come first, and its components' extremes after
    them: together at no instant, but with every peak.
    """
    flat = channel.values.reshape(len(channel.values), -1)
    if thinned.every == 1:
        return flat
    if channel.axis == "":
        return thinned.extremes(flat)
    together = flat[thinned.steps] if channel.axis == "pose" else thinned.vectors(flat)
    return np.concatenate([together, thinned.extremes(flat)], axis=1)


def _recipe(result: Result, curve: Curve, thinned: Thinning) -> dict[str, Any]:
    """Return how the script makes a curve of a stored channel."""
    channel = result.channels[curve.channel]
    first = 3 * (curve.body or 0)
    if thinned.every > 1 and channel.axis != "" and len(curve.columns) == 1:
        first += channel.values[0].size  # the component's own extremes
    return {
        "channel": curve.channel,
        "columns": [column + first for column in curve.columns],
        "offset": curve.offset,
        "factor": curve.factor,
    }


def _groups(
    results: Mapping[str, Result], curves: Mapping[str, list[Curve]]
) -> list[dict[str, Any]]:
    """Return the curves that any of the runs has, by their groups, with their units."""
    curve_entries: dict[str, dict[str, Any]] = {}
    for label, result in results.items():
        for curve in curves[label]:
            entry = {"name": curve.name, "group": curve.group, "label": curve.label}
            curve_entry = curve_entries.setdefault(
                curve.name, {**entry, "si": curve.unit, "largest": 0.0}
            )
            values = values_on(result, curve)
            curve_entry["largest"] = max(curve_entry["largest"], float(np.abs(values).max()))
    groups: dict[str, list[dict[str, Any]]] = {}
    for curve_entry in curve_entries.values():
        unit, factor = shown_unit(curve_entry.pop("si"), curve_entry.pop("largest"))
        curve_entry |= {
            "unit": typeset(unit),
            "factor": factor,
            "label": typeset(curve_entry["label"]),
        }
        groups.setdefault(curve_entry.pop("group"), []).append(curve_entry)
    return [{"label": group, "curves": members} for group, members in groups.items()]


def _first(results: Mapping[str, Result], curves: Mapping[str, list[Curve]]) -> list[str]:
    richest = max(results.values(), key=lambda result: len(result.clearance_joints))
    names = richest.clearance_joints or tuple(richest.joints)
    drawn, _ = busiest([richest], sorted(names), "force", 1)
    available = {curve.name for curve_list in curves.values() for curve in curve_list}
    preferred = [*FIRST, *(f"{name}_force" for name in drawn)]
    return [name for name in preferred if name in available] or sorted(available)[:1]


LAYOUT = """
<div id="viewer" class="live" hidden>
<div class="bar playback" role="toolbar" aria-label="playback">
<button type="button" id="play" aria-keyshortcuts="Space">Play</button>
<label>shown range in <select id="speed">
<option value="2.5">2.5 s</option><option value="5">5 s</option>
<option value="10" selected>10 s</option><option value="30">30 s</option>
<option value="120">2 min</option></select></label>
<input type="range" id="slider" min="0" max="1000" step="any" aria-label="time">
<output id="clock" for="slider"></output>
</div>
<div class="bar" role="toolbar" aria-label="what is shown">
<button type="button" id="previous" aria-keyshortcuts="p">&#9664; impact</button>
<button type="button" id="next" aria-keyshortcuts="n">next impact &#9654;</button>
<button type="button" id="in" aria-label="zoom in" aria-keyshortcuts="+">+</button>
<button type="button" id="out" aria-label="zoom out" aria-keyshortcuts="-">&minus;</button>
<button type="button" id="left" aria-label="earlier">&#8592;</button>
<button type="button" id="right" aria-label="later">&#8594;</button>
<button type="button" id="whole" aria-keyshortcuts="0">whole run</button>
<label>axis <select id="axis"><option value="time">time, ms</option>
<option value="angle">crank angle, deg</option></select></label>
<label>drag <select id="drag"><option value="zoom">zooms</option>
<option value="pan">moves</option></select></label>
<label id="run-choice">mechanism of <select id="run"></select></label>
<label><input type="checkbox" id="forces" checked> forces</label>
</div>
<p id="mark" class="told" role="status" aria-live="polite"></p>
<div class="stage">
<div class="moving">
<svg id="mechanism" role="img" aria-label="the mechanism at the pointer's instant"></svg>
<div id="joints"></div>
<div id="surfaces" hidden></div>
</div>
<div class="curves">
<div id="legend"></div>
<div id="panels"></div>
<div class="panel" id="strip"></div>
<p id="thinned" class="told"></p>
<div class="bar"><button type="button" id="more">more curves</button>
<button type="button" id="less">fewer</button>
<span class="told">Drag across a curve, or turn the wheel with the control key, to zoom; a double
click shows the whole run.</span></div>
</div>
</div>
<details><summary>Keys</summary><p>Space plays and pauses. The arrow keys go from step to step,
page up and page down by ten. n and p go to the next and the previous impact, + and &minus; zoom,
0 shows the whole run.</p></details>
</div>
<p id="failed" class="warnings" role="alert" hidden></p>
"""
