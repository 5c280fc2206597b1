"""Find the keys that make a press best: one objective, or several against each other."""

from exu_press.cli.study import study_command

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE, add_arguments, execute = study_command(
    "optimise",
    "Optimise",
    "front.front_figures",
    ("optimise.json", "trials.csv", "chosen.toml", "front/"),
    example="exu-press optimise clearances.toml --out out/clearances",
    warned=lambda study, report: [report.scenes[report.chosen]],
)
