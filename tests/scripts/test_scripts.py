"""The scripts that print the tables of README and docs run, reduced, and end in numbers."""

import runpy
import sys

import pytest
from running import SCRIPTS, run


@pytest.mark.parametrize("script", sorted(SCRIPTS.glob("*.py")), ids=lambda path: path.stem)
def test_help_is_all_that_help_does(script, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", [script.name, "--help"])
    monkeypatch.setattr(sys, "path", [*sys.path])
    with pytest.raises(SystemExit) as ended:
        runpy.run_path(str(script), run_name="__main__")
    assert ended.value.code == 0
    assert capsys.readouterr().out.startswith(f"usage: {script.name}")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("script", "options", "expected"),
    [
        pytest.param("benchmark_modes.py", [], "ratio", marks=pytest.mark.long),
        pytest.param(
            "flexible_convergence.py",
            ["--out", "convergence"],
            "error 0.01",
            marks=pytest.mark.long,
        ),
        pytest.param(
            "flexible_parts.py", ["--out", "parts"], "second shapes", marks=pytest.mark.long
        ),
    ],
)
def test_script(script, options, expected, tmp_path):
    assert expected in run(script, tmp_path, *options)


@pytest.mark.long
def test_contact_restitution(tmp_path):
    assert "(Table 2)" in run("contact_restitution.py", tmp_path, quick=False)
