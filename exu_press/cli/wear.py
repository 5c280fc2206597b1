"""Wear a press over many strokes: clearances grow, their shapes follow, the runs are repeated."""

from exu_press.cli.study import study_command

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE, add_arguments, execute = study_command(
    "wear",
    "WearStudy",
    "wear.wear_figures",
    ("wear.json", "worn.toml"),
    example="exu-press wear million.toml --out out/million",
    stopped=lambda report: report.ended,
)
