"""exu-press new: a scene file to start from, never in place of somebody's."""

from pathlib import Path

import pytest

import exu_press
from exu_press import Scene
from exu_press.cli import main


def test_what_is_written_runs(tmp_path, capsys):
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), "--mechanism", "slider_crank"]) == 0
    assert f"exu-press run {path}" in capsys.readouterr().out
    assert Scene.load(path) == Scene(mechanism="slider_crank")
    arguments = ["--set", "revolutions=0.01", "--no-pictures", "--no-error"]
    assert main(["run", str(path), *arguments, "--out", str(tmp_path / "out")]) == 0


def test_a_mechanism_file_is_named_as_the_scenes_directory_has_it(tmp_path, monkeypatch):
    shipped = Path(exu_press.__file__).parent / "mechanism" / "files" / "four_bar.toml"
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "bar.toml").write_bytes(shipped.read_bytes())
    monkeypatch.chdir(tmp_path)
    assert main(["new", "mine/scene.toml", "--mechanism", "mine/bar.toml"]) == 0
    path = tmp_path / "mine" / "scene.toml"
    assert 'mechanism = "bar.toml"' in path.read_text()
    assert list(Scene.load(path).joints) == ["shaft", "crank_pin", "knuckle", "pivot"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["mine.toml"], "mine.toml: exists"),
        (["mine.txt"], "mine.txt: allowed is a name that ends in .toml"),
        (["none/mine.toml"], "cannot be written"),
        (["new.toml", "--mechanism", "pres"], "mechanism = 'pres': allowed"),
    ],
)
def test_wrong_input_is_refused_in_one_line(arguments, message, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text("# mine\n")
    assert main(["new", *arguments]) == 2
    error = capsys.readouterr().err
    assert message in error and error.count("\n") == 1
    assert (tmp_path / "mine.toml").read_text() == "# mine\n"
    assert [path.name for path in tmp_path.iterdir()] == ["mine.toml"]
