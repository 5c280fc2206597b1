"""Run tests with the oldest packages that the metadata allows, in an environment of its own.

Run with: python scripts/check_oldest.py [--env DIR] [TEST ...]
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]

TESTS = (
    *("tests/laws", "tests/joints", "tests/integrate", "tests/result", "tests/scene"),
    *("tests/plots", "tests/parallel", "tests/parts", "tests/installation"),
)
"""Of what each of the packages is used for."""


def lower_bounds() -> list[str]:
    """Return a requirement of exactly its lower bound for each package that is always needed."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    exact = []
    for line in tomllib.loads(text)["project"]["dependencies"]:
        requirement, _, marker = line.partition(";")
        bound = re.match(r"([\w-]+)>=([\w.]+)", requirement)
        if bound is None:
            sys.exit(f"{requirement}: has no lower bound")
        exact.append(f"{bound[1]}=={bound[2]}{f'; {marker.strip()}' if marker else ''}")
    return exact


def main() -> None:
    """Install and test."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--env", type=Path, metavar="DIR", help="environment, kept; made if missing"
    )
    parser.add_argument("tests", nargs="*", metavar="TEST", help="files or folders of tests")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.env or Path(temporary) / "env"
        python = folder / ("Scripts" if os.name == "nt" else "bin") / "python"
        bounds = Path(temporary) / "bounds.txt"
        bounds.write_text("\n".join(lower_bounds()) + "\n", encoding="utf-8")
        if not python.exists():
            subprocess.run([sys.executable, "-m", "venv", folder], check=True)
            install = [python, "-m", "pip", "install", "--quiet", "--constraint", bounds]
            subprocess.run([*install, "--editable", f"{ROOT}[test]"], check=True)
        subprocess.run([python, "-m", "exu_press", "doctor"], check=True)
        tests = options.tests or TESTS
        done = subprocess.run([python, "-m", "pytest", "-q", *tests], cwd=ROOT, check=False)
    sys.exit(done.returncode)


if __name__ == "__main__":
    main()
