"""What is said in two files is the same in both."""

import tomllib
from pathlib import Path

import pytest

import check_names

ROOT = Path(__file__).parents[1]


@pytest.fixture
def project():
    if not (ROOT / "CITATION.cff").exists():
        pytest.skip("not run from the sources")
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_the_version_stands_in_the_tag_alone(project):
    assert "version" in project["dynamic"]
    assert "version" not in project
    assert "\nversion:" not in (ROOT / "CITATION.cff").read_text(encoding="utf-8")


def test_the_licence_is_the_one_that_is_named(project):
    assert project["license"] == "BSD-3-Clause"
    (file,) = project["license-files"]
    text = (ROOT / file).read_text(encoding="utf-8")
    assert text.startswith("BSD 3-Clause License")
    assert "the exu_press developers" in text


def test_names_say_what_they_hold():
    assert not [
        line for folder in ("exu_press", "fe_models") for line in check_names.refused_names(folder)
    ]


def test_idle_names_and_bare_participles_are_refused(tmp_path, monkeypatch):
    (tmp_path / "law.py").write_text(
        """
class Beginnings:
    given: int
    def __eq__(self, other): ...
    def filtered(self, force): self._kept = force
    def mix(self, other, part_of_film): ...
    def speed(self):
        for place in range(3): ...
""",
        encoding="utf-8",
    )
    monkeypatch.setattr(check_names, "ROOT", tmp_path)
    lines = check_names.refused_names(".")
    refused = [line.split("`")[1] for line in lines]
    assert sorted(refused) == ["_kept", "filtered", "given", "other", "place"]
