"""What is said in two files is the same in both, also for a release and for those who host it."""

import json
import tomllib
from pathlib import Path

import pytest

import check_names
import write_release

ROOT = Path(__file__).parents[1]

if not (ROOT / "CITATION.cff").exists():
    pytest.skip("not run from the sources", allow_module_level=True)


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


SCHEMAS = {
    "vendor.github-workflows": ".github/workflows/*.yml",
    "vendor.github-issue-forms": ".github/ISSUE_TEMPLATE/[!c]*.yml",
    "vendor.readthedocs": ".readthedocs.yaml",
    "vendor.citation-file-format": "CITATION.cff",
}
FILES = [(schema, path) for schema, names in SCHEMAS.items() for path in sorted(ROOT.glob(names))]


@pytest.mark.parametrize(("schema", "path"), FILES, ids=lambda value: Path(value).name)
def test_a_file_has_the_form_that_its_reader_expects(schema, path, capsys):
    program = pytest.importorskip("check_jsonschema", reason="of the extra dev")
    with pytest.raises(SystemExit) as end:
        program.main(["--builtin-schema", schema, "--output-format", "json", str(path)])
    report = json.loads(capsys.readouterr().out)
    assert end.value.code == 0, report
