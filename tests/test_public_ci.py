"""The files that a hosting service reads are as it expects them, and run what CI runs here."""

import json
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]

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


def test_workflows_run_what_ci_runs():
    if not FILES:
        pytest.skip("not run from the sources")
    runs = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    workflows = {
        path.stem: path.read_text(encoding="utf-8")
        for path in (ROOT / ".github" / "workflows").glob("*.yml")
    }
    assert "- run: .ci/run" in workflows["tests"]
    assert "scripts/check_distribution.py" in runs
    build_site = "sphinx-build -W --quiet docs"
    assert build_site in workflows["docs"] and build_site in runs
