"""The long run over a key of the scene, up and down, or over two: periods, exponents."""

from exu_press.cli.study import study_command

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE, add_arguments, execute = study_command(
    "bifurcation",
    "Bifurcation",
    "bifurcation.bifurcation_figures",
    ("bifurcation.json",),
    example="exu-press bifurcation clearance.toml --out out/clearance",
)
