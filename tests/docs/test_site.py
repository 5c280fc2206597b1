"""The site is built without a warning, and examples in docstrings give what they show."""

import ast
import doctest
import importlib
import subprocess
import sys
from pathlib import Path

import pytest

import exu_press
import fe_models
import paper
import precision
import stability

ROOT = Path(__file__).parents[2]


def test_scripts_of_the_gallery_need_no_file_beside_them(monkeypatch, tmp_path):
    """Sphinx-Gallery runs copies of them."""
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    from sphinx_parts import scripts

    monkeypatch.setattr(scripts, "SOURCES", tmp_path / "gallery")
    monkeypatch.setattr(scripts, "NUMBERS", tmp_path / "numbers.png")
    beside = {path.stem for path in (ROOT / "scripts").iterdir()}
    for script in scripts.gallery_sources().glob("*.py"):
        nodes = list(ast.walk(ast.parse(script.read_text(encoding="utf-8"))))
        imported = {node.module for node in nodes if isinstance(node, ast.ImportFrom)}
        imported |= {n.name for node in nodes if isinstance(node, ast.Import) for n in node.names}
        assert not beside & {str(name).partition(".")[0] for name in imported}, script.name


@pytest.mark.long
def test_builds_without_a_warning(tmp_path):
    pytest.importorskip("sphinx_gallery")
    done = subprocess.run(
        [sys.executable, "-m", "sphinx", "-W", "-q", str(ROOT / "docs"), str(tmp_path / "site")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "site" / "gallery" / "01_ideal_press.html").exists()
    live = (tmp_path / "site" / "live" / "press.html").read_text(encoding="utf-8")
    assert 'id="viewer"' in live
    seen = (tmp_path / "site" / "howto" / "see.html").read_text(encoding="utf-8")
    assert 'src="../live/press.html"' in seen
    keys = (tmp_path / "site" / "reference" / "scene.html").read_text(encoding="utf-8")
    section = keys.partition('<section id="keys-of-every-table">')[2]
    assert 'id="keys-at-the-top"' in section
    assert "Without it, run" not in keys


MODULES = [
    ".".join((package.__name__, *file.relative_to(folder).with_suffix("").parts)).removesuffix(
        ".__init__"
    )
    for package in (exu_press, fe_models, paper, precision, stability)
    for folder in [Path(package.__path__[0])]
    for file in sorted(folder.rglob("*.py"))
    if ">>>" in file.read_text(encoding="utf-8")
]


@pytest.mark.parametrize("name", MODULES)
def test_examples(name):
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as error:  # an extra that is not installed
        pytest.skip(str(error))
    found = doctest.testmod(module)
    assert found.attempted > 0 and found.failed == 0
