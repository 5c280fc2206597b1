"""exu-press new: a file to start from, never in place of another; what it hides is right."""

from pathlib import Path

import pytest

import exu_press
from exu_press import Scene
from exu_press.cli import main
from exu_press.cli.new import template
from exu_press.mechanism import SHIPPED


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
        (["none/mine.toml"], "there is no directory none; allowed is one that exists"),
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


@pytest.mark.parametrize("mechanism", ["press", "slider_crank", *SHIPPED])
def test_it_is_the_mechanisms_own_scene(mechanism, tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(template(mechanism))
    assert Scene.load(path) == Scene(mechanism=mechanism)


def put_to_use(mechanism, table, directory):
    """Return the scene of a mechanism's template in which a table is no comment any more."""
    lines, inside = [], False
    for line in template(mechanism).splitlines():
        inside = line.startswith(f"# [{table}]") or (inside and line.startswith("# "))
        given = line.partition("  #")[0].partition("=")[2].strip() or line.startswith("# [")
        lines.append(line.removeprefix("# ") if inside and given else line)
    (directory / "scene.toml").write_text("\n".join(lines))
    return Scene.load(directory / "scene.toml")


@pytest.mark.parametrize(
    ("table", "value"),
    [
        ("guide", {"lateral_stiffness": 1e9}),
        (
            "load.forming",
            {"kind": "table", "crank_angle_deg": [120, 175, 180], "force": [0, 1e4, 0]},
        ),
    ],
)
def test_a_table_that_is_not_in_use_is_right_when_it_is_put_to_use(table, value, tmp_path):
    """Its defaults; a key without one is left out."""
    assert put_to_use("press", table, tmp_path) == Scene().replace({table: value})


@pytest.mark.parametrize(("mechanism", "body"), [("press", "linkage"), ("six_bar", "rod")])
def test_the_example_of_a_flexible_body_is_right(mechanism, body, tmp_path):
    assert list(put_to_use(mechanism, f"bodies.{body}", tmp_path).bodies) == [body]
