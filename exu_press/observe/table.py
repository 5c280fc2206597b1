"""Summaries as a table: what a person reads in a terminal or a report."""

from collections.abc import Callable, Mapping
from typing import Any

from exu_press.columns import columns
from exu_press.observe.uncertain import uncertain

__all__ = ["comparison_cells", "comparison_lines", "run_lines"]

Summary = Mapping[str, Any]

MOST_JOINTS = 3
"""Joints that a line names, those with the largest forces."""

ALIKE = 1e-2
"""Two sides that differ by less, relatively, are shown as one."""


def _figure(name: str, scale: float = 1.0, digits: int = 4) -> Callable[[Summary], str]:
    """Return what reads a figure by its dotted name, with its error where that is known."""

    def text(summary: Summary) -> str:
        value: Any = summary
        for key in name.split("."):
            value = None if value is None else value.get(key)
        return uncertain(value, summary.get("errors", {}).get(name), scale, digits)

    return text


def _joints(entry: str, scale: float) -> Callable[[Summary], str]:
    """Return what reads one entry of every clearance joint, both balls as one."""

    def text(summary: Summary) -> str:
        loose = {
            name: joint
            for name, joint in summary["joints"].items()
            if joint["clearance"] and joint[entry] is not None
        }
        shown = {}
        for name, joint in loose.items():
            both = name.removesuffix("_left").removesuffix("_right")
            left, right = loose.get(f"{both}_left", {}), loose.get(f"{both}_right", {})
            alike = _alike(left.get(entry), right.get(entry))
            if not (alike and name.endswith("_right")):
                words = name.removesuffix("_left") if alike else name
                shown[name] = words.replace("_", " "), joint["peak_force"]
        busiest = sorted(shown, key=lambda name: -shown[name][1])[:MOST_JOINTS]
        texts = [
            f"{shown[name][0]} {_figure(f'joints.{name}.{entry}', scale)(summary)}"
            for name in shown
            if name in busiest
        ]
        rest = [f"{len(shown) - MOST_JOINTS} more"] * (len(shown) > MOST_JOINTS)
        return ", ".join([*texts, *rest]) or "-"

    return text


def _alike(one: float | None, other: float | None) -> bool:
    """Return whether a figure is the same on both sides of a press, to a hundredth."""
    if one is None or other is None:
        return False
    return abs(one - other) <= ALIKE * max(abs(one), abs(other))


def _tilt(summary: Summary) -> str:
    """Return the slider's largest tilt, where its guide lets it."""
    return _figure("slider_tilt", 1e6)(summary) if "guide" in summary["scene"] else "-"


def _loads(entry: str, scale: float) -> Callable[[Summary], str]:
    """Return what reads one entry of every load."""

    def text(summary: Summary) -> str:
        shown = [
            f"{name.replace('_', ' ')} {_figure(f'loads.{name}.{entry}', scale)(summary)}"
            for name in summary["loads"]
        ]
        return ", ".join(shown) or "-"

    return text


def _rubbing(summary: Summary) -> str:
    """Return what all guides would take with a coefficient of friction of 0.1, W."""
    guide = summary["scene"].get("guide", {})
    if guide.get("clearance") and guide["friction"] != "none":
        return "-"
    powers = {name: guide["sliding_power"] for name, guide in summary["guides"].items()}
    if not powers or None in powers.values():
        return "-"
    told = [summary.get("errors", {}).get(f"guides.{name}.sliding_power") for name in powers]
    error = None
    if None not in told:
        error = {key: sum(each[key] for each in told) for key in ("error", "low", "high")}
        error["determined"] = all(each["determined"] for each in told)
    return uncertain(sum(powers.values()), error, 0.1)


ROWS: tuple[tuple[str, Callable[[Summary], str]], ...] = (
    ("status", lambda s: str(s["status"])),
    ("errors exceed figures from, ms", lambda s: uncertain(s.get("errors_from"), None, 1e3)),
    ("stroke, mm", _figure("stroke", 1e3, 5)),
    ("bottom dead centre, mm", _figure("bottom_dead_centre", 1e3, 6)),
    ("peak velocity, m/s", _figure("peak_velocity")),
    ("peak acceleration, m/s^2", _figure("peak_acceleration.resolved")),
    ("  mean over 1 ms", _figure("peak_acceleration.mean_1ms")),
    ("  differentiated, 1 kHz", _figure("peak_acceleration.differentiated_1khz")),
    ("eccentricity ratio, max", _joints("max_eccentricity_ratio", 1.0)),
    ("joint force, max, kN", _joints("peak_force", 1e-3)),
    ("penetration, max, um", _joints("peak_penetration", 1e6)),
    ("film thickness, min, um", _joints("min_film", 1e6)),
    ("impacts", _joints("impacts", 1.0)),
    ("share in contact", _joints("share_contact", 1.0)),
    ("dead centres differ by, um", _figure("strokes.range", 1e6)),
    ("slider tilt, max, urad", _tilt),
    ("drive torque, max, kN m", _figure("drive.peak_torque", 1e-3)),
    ("drive power, mean, W", _figure("drive.mean_power", 1.0)),
    ("  guides of mu 0.1 would add, W", _rubbing),
    ("crank speed, mean, rpm", _figure("drive.mean_speed_rpm")),
    ("  coefficient of fluctuation", _figure("drive.fluctuation")),
    ("shaking force up, max, kN", _figure("shaking.vertical", 1e-3)),
    ("  mean over 1 ms", _figure("shaking.vertical_mean_1ms", 1e-3)),
    ("  without counterweight", _figure("shaking.without_counterweight.vertical_mean_1ms", 1e-3)),
    ("load, max, kN", _loads("peak_force", 1e-3)),
    ("  work that it put in, J", _loads("work", 1.0)),
    ("energy put in, J", _figure("energy.input")),
    ("energy dissipated, J", _figure("energy.dissipated")),
    ("energy residual", lambda s: uncertain(s["energy"]["residual"], None, 1.0, 2)),
    ("steps", lambda s: f"{s['steps']} ({s['rejected_steps']} rejected)"),
    ("wall time, s", lambda s: uncertain(s["wall_time"], None, 1.0, 3)),
)


def comparison_cells(summaries: Mapping[str, Summary]) -> list[list[str]]:
    """Return the lines of a table as texts: the head, then a quantity a line, one column a run."""
    cells = [["", *summaries]]
    cells += [[name, *(row(s) for s in summaries.values())] for name, row in ROWS]
    return [line for line in cells if set(line[1:]) != {"-"}]


def comparison_lines(summaries: Mapping[str, Summary]) -> list[str]:
    """Return a table, one column a run."""
    return columns(comparison_cells(summaries))


def run_lines(summary: Summary) -> list[str]:
    """Return one run's summary, a line a quantity."""
    return comparison_lines({"": summary})[1:]
