"""What is said in two files is the same in both."""

import tomllib
from pathlib import Path

import pytest

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
