"""Summaries as a person reads them in a terminal."""

from collections.abc import Callable, Mapping
from typing import Any

__all__ = ["comparison_lines", "run_lines"]

Summary = Mapping[str, Any]


def _number(value: float | None, scale: float = 1.0, digits: int = 4) -> str:
    """Return a value in a multiple of its SI unit, or a dash where there is none."""
    return "-" if value is None else f"{value * scale:.{digits}g}"


def _joints(entry: str, scale: float) -> Callable[[Summary], str]:
    """Return what reads one entry of every clearance joint, both balls as one."""

    def text(summary: Summary) -> str:
        values = {
            name.removesuffix("_left").replace("_", " "): joint[entry]
            for name, joint in summary["joints"].items()
            if not name.endswith("_right") and joint[entry] is not None
        }
        return ", ".join(f"{name} {_number(v, scale)}" for name, v in values.items()) or "-"

    return text


ROWS: tuple[tuple[str, Callable[[Summary], str]], ...] = (
    ("status", lambda s: str(s["status"])),
    ("stroke, mm", lambda s: _number(s["stroke"], 1e3, 5)),
    ("lowest position, mm", lambda s: _number(s["ldp"], 1e3, 6)),
    ("peak velocity, m/s", lambda s: _number(s["peak_velocity"])),
    ("peak acceleration, m/s^2", lambda s: _number(s["peak_acceleration"]["resolved"])),
    ("  mean over 1 ms", lambda s: _number(s["peak_acceleration"]["mean_1ms"])),
    ("  differentiated, 1 kHz", lambda s: _number(s["peak_acceleration"]["differentiated_1khz"])),
    ("eccentricity ratio, max", _joints("max_eccentricity_ratio", 1.0)),
    ("joint force, max, kN", _joints("peak_force", 1e-3)),
    ("penetration, max, um", _joints("peak_penetration", 1e6)),
    ("film thickness, min, um", _joints("min_film", 1e6)),
    ("impacts", _joints("impacts", 1.0)),
    ("share in contact", _joints("share_contact", 1.0)),
    ("energy put in, J", lambda s: _number(s["energy"]["input"])),
    ("energy dissipated, J", lambda s: _number(s["energy"]["dissipated"])),
    ("energy residual", lambda s: _number(s["energy"]["residual"], 1.0, 2)),
    ("steps", lambda s: f"{s['steps']} ({s['rejected_steps']} rejected)"),
    ("wall time, s", lambda s: _number(s["wall_time"], 1.0, 3)),
)


def comparison_lines(summaries: Mapping[str, Summary]) -> list[str]:
    """Return a table, one column a run."""
    cells = [["", *summaries]]
    cells += [[name, *(row(s) for s in summaries.values())] for name, row in ROWS]
    cells = [line for line in cells if set(line[1:]) != {"-"}]
    widths = [max(len(line[i]) for line in cells) for i in range(len(cells[0]))]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in cells
    ]


def run_lines(summary: Summary) -> list[str]:
    """Return one run's summary, a line a quantity."""
    return comparison_lines({"": summary})[1:]
