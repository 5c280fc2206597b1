"""Build wheel and sources as for a release; use each in fresh environments, without the checkout.

Wheels are compiled, the sources are installed in Python, and each runs `exu-press doctor` and a
scene: with the oldest and the newest Python at hand, of those that the metadata allows.

Run with: python scripts/check_distribution.py [--python COMMAND ...] [--out DIR]
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]

SCENE = ("run", "slider_crank", "--set", "revolutions=0.2", "--no-pictures", "--out", "run")


def allowed_versions() -> list[str]:
    """Return the versions of Python that the metadata names, oldest first."""
    metadata = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    prefix = "Programming Language :: Python :: 3."
    return [f"3.{c.removeprefix(prefix)}" for c in metadata["classifiers"] if c.startswith(prefix)]


def pythons_at_hand() -> list[str]:
    """Return commands of the oldest and the newest allowed Python, on the path or pyenv's."""
    folders = [Path(folder) for folder in os.environ.get("PATH", "").split(os.pathsep)]
    if shutil.which("pyenv"):
        root = subprocess.run(["pyenv", "root"], capture_output=True, text=True, check=True).stdout
        folders += sorted(Path(root.strip(), "versions").glob("3.*/bin"))
    commands = []
    for version in allowed_versions():
        candidates = [str(folder / f"python{version}") for folder in folders]
        runnable = [command for command in candidates if shutil.which(command)]
        commands += [command for command in runnable if has_version(command, version)][:1]
    return [commands[0], commands[-1]] if len(commands) > 1 else commands or [sys.executable]


def has_version(command: str, version: str) -> bool:
    """Return whether a command starts a Python of this version; a stand-in may not."""
    done = subprocess.run(
        [command, "-c", "import sys, venv; print('%d.%d' % sys.version_info[:2])"],
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout.strip() == version


def run(words: list[str | Path], folder: Path, **environment: str) -> str:
    """Run a command in a folder; return what it prints.

    Raises:
        SystemExit: it fails.
    """
    done = subprocess.run(
        [str(word) for word in words],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        sys.exit(f"{words}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def use(distribution: Path, python: str, folder: Path, joints: str) -> None:
    """Install a distribution into a fresh environment, and run what its users run first."""
    run([python, "-m", "venv", folder / "env"], folder.parent)
    programs = folder / "env" / ("Scripts" if os.name == "nt" else "bin")
    install = [programs / "python", "-m", "pip", "install", "--quiet", "--no-compile", distribution]
    run(install, folder.parent, EXU_PRESS_COMPILE="0")
    print(run([programs / "python", "--version"], folder).strip(), distribution.name, flush=True)
    printed = run([programs / "exu-press", "doctor"], folder)
    if f"joints: {joints}" not in printed:
        sys.exit(f"joints are not {joints}:\n{printed}")
    run([programs / "exu-press", *SCENE], folder)
    if not (folder / "run" / "run.nc").exists():
        sys.exit("the scene has left no run.nc")
    shutil.rmtree(folder)


def main() -> None:
    """Build, install, use."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--python", nargs="+", help="the oldest and the newest at hand unless given"
    )
    parser.add_argument("--out", type=Path, help="of the built files; they are removed without it")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        built = options.out or folder / "built"
        python = Path(sys.executable)
        build = [python, "-m", "build", "--sdist", "--outdir", built, ROOT]
        run(build, folder, EXU_PRESS_COMPILE="0")
        (sources,) = built.glob("*.tar.gz")
        for number, command in enumerate(options.python or pythons_at_hand()):
            wheels = built / str(number)
            # of the sources, so that what they lack is noticed
            make = [command, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", wheels]
            run([*make, sources], folder, EXU_PRESS_COMPILE="1")
            (wheel,) = wheels.glob("*.whl")
            for distribution, joints in ((wheel, "compiled"), (sources, "in Python")):
                place = folder / f"{number}{distribution.suffix}"
                place.mkdir()
                use(distribution, command, place, joints)


if __name__ == "__main__":
    main()
