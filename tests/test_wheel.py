"""The wheel installs into an empty environment and does the main job outside the checkout."""

import shutil
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = ("exu_press", "fe_models")
DATA = {".npz", ".toml", ".step", ".typed", ".json", ".html", ".css", ".js"}
"""Endings of what a package needs beside its modules."""

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel, built from a copy: a build leaves its traces beside the sources."""
    place = tmp_path_factory.mktemp("wheel")
    source = place / "source"
    nothing = shutil.ignore_patterns(".git", "out", "build", "dist", "*.egg-info", "__pycache__")
    shutil.copytree(ROOT, source, ignore=nothing)
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", str(source)]
    subprocess.run([*command, "--wheel-dir", str(place)], check=True)
    (built,) = place.glob("*.whl")
    return built


def test_the_package_data_is_in_it(wheel):
    with zipfile.ZipFile(wheel) as archive:
        inside = set(archive.namelist())
    needed = {
        str(path.relative_to(ROOT))
        for package in PACKAGES
        for path in (ROOT / package).rglob("*")
        if path.suffix in {*DATA, ".py"} and "__pycache__" not in path.parts
    }
    assert needed <= inside, sorted(needed - inside)
    assert {f"{package}/py.typed" for package in PACKAGES} <= inside
    assert not {name.split("/")[0] for name in inside if name.endswith(".py")} - set(PACKAGES)


def test_it_does_the_main_job_outside_the_checkout(wheel, tmp_path):
    venv.create(tmp_path / "env", with_pip=True)
    python = tmp_path / "env" / "bin" / "python"
    run(tmp_path, python, "-m", "pip", "install", "--quiet", str(wheel))
    command = tmp_path / "env" / "bin" / "exu-press"
    assert "this installation works" in run(tmp_path, command, "doctor")
    run(tmp_path, command, "compare", "press", "--set", "revolutions=0.1", "--out", "compared")
    assert (tmp_path / "compared" / "compare_slider.png").exists()
    assert (tmp_path / "compared" / "lubricated" / "run.nc").exists()
    flexible = ("--set", "bodies.crank=crank", "--set", "revolutions=0.01")
    run(tmp_path, command, "run", "press", *flexible, "--out", "flexible")
    assert (tmp_path / "flexible" / "run.nc").exists()
    home = run(tmp_path, python, "-c", "import exu_press; print(exu_press.__file__)")
    assert str(tmp_path / "env") in home


def run(place, *words):
    done = subprocess.run(
        list(map(str, words)), cwd=place, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, (words, done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout
