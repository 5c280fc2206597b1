"""Rows are used again only where all files that a run reads are as they were."""

import json

import pytest

from exu_press import InputError, Scene
from exu_press.cli import main
from exu_press.studies.base import arguments_of, scene_from

LAW = """
from dataclasses import dataclass
from exu_press.joints.interface import DryInterface
from exu_press.laws.contact import hertz, hysteretic
from exu_press.scene import CustomJoint, key
from stiffness_of_mine import STIFFNESS

@dataclass(frozen=True)
class MyPin(CustomJoint):
    radius: float = key(0.01, "of the journal", "m", above=0)

    def interfaces(self):
        contact = hysteretic(hertz(STIFFNESS), 0.9, lambda e: 1.5 * (1.0 - e) / e)
        return [DryInterface(contact, lambda v: (0.0, 0.0), self.radius, self.clearance)]
"""

STUDY = """
[scene]
mechanism = "slider_crank"
revolutions = 0.01
[scene.joints.wrist_pin]
kind = "law_of_mine:MyPin"
clearance = 1e-4
[keys]
speed_rpm = [100.0, 200.0]
"""


def rows(directory):
    """Return the keys of the rows of a study."""
    return [json.loads(line)["key"] for line in (directory / "runs.jsonl").open()]


def test_an_edited_law_is_computed_anew(tmp_path, monkeypatch, processes, capfd):
    """In real workers, which import what is there now; what is unchanged is used again."""
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "law_of_mine.py").write_text(LAW)
    (tmp_path / "stiffness_of_mine.py").write_text("STIFFNESS = 1e10\n")
    (tmp_path / "study.toml").write_text(STUDY)
    command = ["sweep", str(tmp_path / "study.toml"), "--allow-code", "--workers", "1"]
    command += ["--no-pictures", "--quiet", "--out", str(tmp_path / "o")]
    for count in (2, 2):
        assert main(command) == 0, capfd.readouterr().err
        assert len(rows(tmp_path / "o")) == count
    (tmp_path / "stiffness_of_mine.py").write_text("STIFFNESS = 2e10\n")
    assert main(command) == 0
    assert len(set(rows(tmp_path / "o"))) == len(rows(tmp_path / "o")) == 4


@pytest.fixture
def scene(tmp_path):
    """A scene whose linkage is a STEP file; nothing of it is meshed."""
    path = tmp_path / "rod.step"
    path.write_text("ISO-10303-21;")
    return Scene(mechanism="slider_crank", bodies={"rod": {"flexible": str(path)}})


def test_the_content_of_a_step_file_tells_runs_apart(scene, tmp_path):
    first = arguments_of(scene)
    assert arguments_of(scene) == first
    assert scene_from(first) == scene
    (tmp_path / "rod.step").write_text("ISO-10303-22;")  # as long as before
    assert arguments_of(scene) != first
    with pytest.raises(InputError, match=r"rod\.step: has been changed while the study goes on"):
        scene_from(first)
    (tmp_path / "rod.step").unlink()
    with pytest.raises(InputError, match=r"rod\.step: is no file that can be read"):
        scene_from(first)
