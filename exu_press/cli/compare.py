"""Compare the variants of one scene: ideal, dry and lubricated joints, side by side."""

import argparse
import sys

from exu_press.cli.options import add_scene_arguments, directory_of, scene_of, show_warnings
from exu_press.observe.table import comparison_lines
from exu_press.output import output_directory, remove_pictures, write_json
from exu_press.simulation import simulate
from exu_press.studies.compare import variants

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press compare press --set joints.crank_pin.clearance=5e-5 --out out/compare"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    add_scene_arguments(parser)


def execute(options: argparse.Namespace) -> int:
    """Run every variant; return 0, or 3 if one of them stopped early."""
    scenes = variants(scene_of(options))
    directory = output_directory(directory_of(options))
    results, summaries = {}, {}
    for label, scene in scenes.items():
        if not options.quiet:
            print(f"{label} ...", file=sys.stderr)
        results[label] = result = simulate(scene, quiet=options.quiet)
        summaries[label] = summary = result.summary()
        place = output_directory(directory / label.replace(" ", "_"))
        remove_pictures(place, "run")
        result.save(place / "run.nc")
        write_json(place / "summary.json", summary)
    remove_pictures(directory, "compare")
    write_json(directory / "comparison.json", summaries)
    if not options.no_pictures:
        from exu_press.plots import save_comparison

        save_comparison(results, directory)
    if not options.quiet:
        print("\n".join(comparison_lines(summaries)))
        show_warnings(f"{label}: {w}" for label, s in summaries.items() for w in s["warnings"])
        print(f"written to {directory}")
    stopped = {label: s["reason"] for label, s in summaries.items() if s["reason"]}
    for label, reason in stopped.items():
        how = "" if results[label].completed else "stopped early: "
        print(f"exu-press: {label}: {how}{reason}", file=sys.stderr)
    return 3 if stopped else 0
