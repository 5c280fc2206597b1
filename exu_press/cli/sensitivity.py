"""Find out which tolerances decide: Sobol indices, a tornado, and the spread of presses."""

from exu_press.cli.study import study_command

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE, add_arguments, execute = study_command(
    "sensitivity",
    "Sensitivity",
    "sensitivity.sensitivity_figures",
    ("sensitivity.json", "samples.csv"),
    example="exu-press sensitivity tolerances.toml --out out/tolerances",
)
