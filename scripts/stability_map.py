"""The map of the stability study, from its report or from a sample of one axis.

python scripts/stability_map.py out/stability/stability.json [--out DIR]
python scripts/stability_map.py --axis "bearing length" [--out DIR]
"""

import argparse
import json
from pathlib import Path

from exu_press.output import output_directory
from exu_press.plots.stability import save_stability
from exu_press.studies.stability import Report, quick_cases, stability


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("report", nargs="?", help="stability.json of exu-press stability")
    parser.add_argument("--axis", default="bearing length", help="run this axis's sample instead")
    parser.add_argument("--out", default="out/stability_map", help="where to write")
    options = parser.parse_args()
    directory = output_directory(options.out)
    if options.report:
        data = json.loads(Path(options.report).read_text(encoding="utf-8"))
        report = Report(data["quick"], tuple(data["cases"]))
    else:
        chosen = [case for case in quick_cases() if case.axis == options.axis]
        report = stability(chosen, directory, quick=True, workers=1)
    for line in report.lines():
        print(line)
    print("written:", save_stability(report, directory))


if __name__ == "__main__":
    main()
