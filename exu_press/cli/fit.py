"""Find keys of a scene from a measurement: best values, intervals, keys left undetermined."""

from exu_press.cli.study import study_command

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE, add_arguments, execute = study_command(
    "fit",
    "Fit",
    "fit.fit_figures",
    ("fit.json", "fitted.toml"),
    example="exu-press fit measured.toml --out out/measured",
    warned=lambda study, report: [report.scene],
)
