"""Spectra of a run's channels: over frequency, over orders of the crank, over the crank angle."""

import argparse
from pathlib import Path

from exu_press.cli.options import add_picture_arguments
from exu_press.report.find import find_run
from exu_press.result import Result

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press spectrum out/press/run.nc slider_acceleration crank_pin_force.x"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("path", metavar="RUN", help="a run.nc, or the directory that run wrote to")
    parser.add_argument(
        "channels",
        metavar="CHANNEL",
        nargs="*",
        help="of the run; NAME.x is a column (default: slider_acceleration)",
    )
    parser.add_argument(
        "--window",
        metavar="NAME",
        help="of the spectrum over Hz: flattop (amplitudes within 0.1%%), hann (narrower) or "
        "boxcar (none); default: none over whole revolutions at constant speed, else flattop",
    )
    parser.add_argument("--out", metavar="DIR", help="where to write (default: beside the run)")
    add_picture_arguments(parser)
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")


def execute(options: argparse.Namespace) -> int:
    """Print and draw the spectra; return 0."""
    from exu_press.files.output_directory import output_directory
    from exu_press.studies.spectrum import DEFAULT, marks_of, spectra

    file = find_run(options.path)
    run = Result.load(file)
    spectra_list = spectra(
        run, [*dict.fromkeys(options.channels)] or [DEFAULT], window=options.window
    )
    marks = marks_of(run)
    written: list[Path] = []
    directory = output_directory(options.out or file.parent)
    if not options.no_pictures:
        from exu_press.studies.spectrum_figure import save_spectra

        written = save_spectra(spectra_list, run, marks, directory)
    if not options.quiet:
        lines = [line for spectra_entry in spectra_list for line in spectra_entry.lines()]
        lines += [f"natural frequency: {mark.name}, {mark.frequency:.4g} Hz" for mark in marks]
        print("\n".join(lines))
        if written:
            print("written:", ", ".join(path.name for path in written), f"in {directory}")
    return 0
