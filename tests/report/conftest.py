"""What the commands leave behind, in short."""

from pathlib import Path

import pytest
from matplotlib.figure import Figure

from exu_press.cli import main
from exu_press.files.output_directory import PICTURES
from exu_press.plots.file import save_figures

STUDY = """
[scene]
mechanism = "slider_crank"
revolutions = 0.02
[keys]
"joints.crank_pin.clearance" = [5e-5, 1e-4, 2e-4]
joints.crank_pin = ["dry", "lubricated"]
"""


@pytest.fixture(scope="session")
def outputs(tmp_path_factory) -> dict[str, Path]:
    """Directories of `run`, `compare` and `sweep`, and an early stop."""
    folder = tmp_path_factory.mktemp("outputs")
    quiet = ["--no-pictures", "--quiet"]
    short, coarse = ["--set", "revolutions=0.05"], ["--set", "solver.tolerance=1e-2"]
    (folder / "study.toml").write_text(STUDY)
    (folder / "study").mkdir()
    assert main(["run", "press", *short, *coarse, *quiet, "--out", str(folder / "run")]) == 0
    quiet += ["--no-error"]
    assert main(["compare", "slider_crank", *short, *quiet, "--out", str(folder / "compare")]) == 0
    changes = ("joints.crank_pin=lubricated", "film.viscosity=1e-7", "solver.step=1e-4")
    stop = [word for change in changes for word in ("--set", change)]
    stopped = str(folder / "stopped")
    assert main(["run", "slider_crank", *short, *stop, *quiet, "--out", stopped]) == 3
    sweep = ["sweep", str(folder / "study.toml"), "--workers", "1", "--quiet"]
    assert main([*sweep, "--out", str(folder / "sweep")]) == 0
    return {name: folder / name for name in ("run", "compare", "stopped", "sweep")}


def blank(command):
    """Return what writes blank pictures of a command: tests/plots looks at real ones."""
    return lambda _, folder: save_figures(
        {name: Figure(figsize=(13.0, 6.0), dpi=150) for name in PICTURES[command]}, folder
    )


@pytest.fixture(scope="session")
def pages(outputs) -> dict[str, Path]:
    """Reports of them, written by the command; their pictures are blank."""
    for name, directory in outputs.items():
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("exu_press.report.pictures.save_pictures", blank("run"))
            patch.setattr("exu_press.report.comparison.save_comparison", blank("compare"))
            if name == "stopped":  # pictures and curves of a run are in the page of "run"
                patch.setattr("exu_press.report.pictures.save_pictures", lambda *_: [])
                patch.setattr("exu_press.page.document.find_spec", lambda _: None)
            assert main(["report", str(directory), "--quiet"]) == 0
    return {name: directory / "report.html" for name, directory in outputs.items()}
