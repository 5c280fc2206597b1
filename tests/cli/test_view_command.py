import re

import pytest

from exu_press import Scene, simulate
from exu_press.cli import main


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    path = tmp_path_factory.mktemp("run") / "run.nc"
    simulate(Scene(mechanism="slider_crank", revolutions=0.05)).save(path)
    return path


def test_an_animation_and_a_picture_from_the_file_alone(run, tmp_path, capsys):
    animation, picture = tmp_path / "animation.gif", tmp_path / "picture.svg"
    style = tmp_path / "journal.mplstyle"
    style.write_text("font.size: 19\n")
    assert main(["view", str(run), "--save", str(animation), "--frames", "3"]) == 0
    directory = str(run.parent)  # as good as the file in it
    words = ["--save", str(picture), "--at", "0.005", "--style", str(style), "--quiet"]
    assert main(["view", directory, *words]) == 0
    assert animation.stat().st_size > 10_000
    text = picture.read_text(encoding="utf-8")
    assert re.search(r"\b22px[^>]*>t =    5.00 ms", text), "twice the size"
    assert capsys.readouterr().out == f"written: {animation}\n"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--slow", "5"], "--slow 5.0: allowed with --save"),
        (["--save", "x%d.svg"], "--save x%d.svg: allowed is a name ending in .mp4"),
        (["--save", "x.avi"], "--save x.avi: allowed is a name ending in .mp4"),
        (["--save", "x.gif", "--from", "7"], "--from 7: the record goes from 0"),
        (["--save", "x.gif", "--at", "0.01"], "--at 0.01: allowed with --save of one picture"),
        (["--save", "x.png", "--slow", "3"], "--slow 3: allowed for animations"),
        (["--save", "x.gif", "--colour", "stress"], "--colour stress: allowed for runs with flex"),
        (["--save", "x.gif", "--exaggerate", "9"], "--exaggerate 9.0: allowed for runs with flex"),
    ],
)
def test_wrong_options_are_status_2_in_one_line(
    run, tmp_path, monkeypatch, capsys, arguments, message
):
    monkeypatch.chdir(tmp_path)
    assert main(["view", str(run), *arguments]) == 2
    told = capsys.readouterr().err
    assert message in told and told.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_without_save_the_page_opens_in_the_browser(run, monkeypatch, capsys):
    opened = []
    monkeypatch.setattr("webbrowser.open", lambda address: opened.append(address) or True)
    monkeypatch.setattr("exu_press.report.pictures.save_pictures", lambda *_: [])
    assert main(["view", str(run)]) == 0
    page = run.parent / "report.html"
    assert opened == [page.resolve().as_uri()]
    assert page.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    assert f"written: {page}" in capsys.readouterr().out


def test_without_a_browser_the_page_is_named(run, monkeypatch, capsys):
    monkeypatch.setattr("webbrowser.open", lambda address: False)
    monkeypatch.setattr("exu_press.cli.view.report_of", lambda *_: "a page")
    assert main(["view", str(run), "--quiet"]) == 2
    assert f"no browser can be opened here; open {run.parent}" in capsys.readouterr().err
