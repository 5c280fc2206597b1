"""What the owner of a release fills in stands in every file that repeats it."""

import tomllib
from pathlib import Path

import pytest

import write_release

ROOT = Path(__file__).parents[1]

if not (ROOT / "CITATION.cff").exists():
    pytest.skip("not run from the sources", allow_module_level=True)


@pytest.mark.parametrize("file", write_release.BLOCKS)
def test_files_repeat_the_table_of_the_release(file):
    text = (ROOT / file).read_text(encoding="utf-8")
    assert text == write_release.release_text(file, write_release.read_release()), (
        "run: python scripts/write_release.py"
    )


OWNER = {
    "authors": [
        {
            "given-names": "Ada",
            "family-names": 'Müller "Curt"',
            "orcid": "0000-0000-0000-0001",
            "affiliation": "University of Somewhere",
            "email": "ada@example.org",
        },
        {"given-names": "Bo", "family-names": "Li"},
    ],
    "repository": "https://example.org/exu_press",
    "issues": "https://example.org/exu_press/issues",
    "documentation": "https://example.org/docs",
    "security": "https://example.org/private",
    "doi": "10.1234/example",
}


def test_what_is_filled_in_stands_in_every_file():
    metadata = tomllib.loads(write_release.release_text("pyproject.toml", OWNER))["project"]
    assert metadata["authors"] == [
        {"name": 'Ada Müller "Curt"', "email": "ada@example.org"},
        {"name": "Bo Li"},
    ]
    assert metadata["urls"]["Repository"] == OWNER["repository"]
    citation = write_release.release_text("CITATION.cff", OWNER)
    assert 'orcid: "https://orcid.org/0000-0000-0000-0001"' in citation
    assert f'doi: "{OWNER["doi"]}"' in citation
    paper = write_release.release_text("docs/joss/paper.md", OWNER)
    assert 'name: "University of Somewhere"' in paper
    assert OWNER["repository"] in write_release.release_text("CONTRIBUTING.md", OWNER)
    for file in ("SECURITY.md", ".github/ISSUE_TEMPLATE/config.yml"):
        assert OWNER["security"] in write_release.release_text(file, OWNER)


def test_a_file_without_the_lines_between_which_it_repeats_is_refused(monkeypatch):
    monkeypatch.setitem(write_release.BLOCKS, "LICENSE", [write_release.citation])
    with pytest.raises(ValueError, match="release: begin"):
        write_release.release_text("LICENSE", OWNER)


@pytest.mark.parametrize(
    "file", [".github/ISSUE_TEMPLATE/fault.yml", ".github/ISSUE_TEMPLATE/question.yml"]
)
def test_issue_templates_ask_for_scene_and_installation(file):
    text = (ROOT / file).read_text(encoding="utf-8")
    assert "id: scene" in text and "exu-press doctor" in text
