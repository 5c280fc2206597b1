"""exu-press draw: text and picture, also of drawings that do not move."""

import subprocess
import sys

import pytest

from exu_press.cli.main import main
from exu_press.mechanism import SliderCrank, mechanism_lines, slider_crank


@pytest.fixture
def drawn(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("\n".join(mechanism_lines(slider_crank(SliderCrank()))), encoding="utf-8")
    return path


def test_a_picture_is_written(drawn, capsys):
    target, width = drawn.with_suffix(".pdf"), ["--width", "84mm"]
    assert main(["draw", str(drawn), "--save", str(target), *width]) == 0
    assert target.read_bytes().startswith(b"%PDF")
    assert main(["draw", str(drawn), *width]) == 2
    assert "--width 84mm: allowed with --save" in capsys.readouterr().err


def test_single_keys_are_changed(drawn, tmp_path, capsys):
    scene = tmp_path / "scene.toml"
    scene.write_text('mechanism = "slider_crank"\n')
    own = tmp_path / "own.toml"
    own.write_text(f'mechanism = "{drawn.name}"\nspeed_rpm = 60\n')
    for words, part in (
        (["slider_crank", "--set", "slider_crank.crank_radius=0.05"], "100.000 mm"),
        ([str(scene), "--set", "slider_crank.crank_radius=0.05"], "100.000 mm"),
        ([str(scene), "--set", "speed_rpm=60"], "m/s"),
        (["press", "--set", "mechanism=slider_crank"], "wrist_pin"),
        ([str(drawn), "--set", "joints.crank_pin.at=[0.0, 0.05]"], "100.000 mm"),
        ([str(own), "--set", "joints.crank_pin.at=[0.0, 0.05]"], "100.000 mm"),
        (["four_bar", "--set", "name=mine"], "mine"),
        ([str(drawn)], "wrist_pin: 85.51 deg at 90.0 deg"),
    ):
        assert main(["draw", *words]) == 0
        assert part in capsys.readouterr().out
    lengths = ["--set", "slider_crank.crank_radius=30", "--set", "slider_crank.rod_length=150"]
    assert main(["draw", "slider_crank", *lengths]) == 0
    assert "is the drawing in mm?" in " ".join(capsys.readouterr().err.split())


@pytest.mark.parametrize(
    ("name", "change", "parts"),
    [
        (
            "press",
            "film.viscosity=0.1",
            ("press with --set: film.viscosity", "not drawn", "speed_rpm"),
        ),
        ("four_bar", "joints.crank_pn.at=[0, 1]", ("joints.crank_pn", "crank_pin")),
        ("press", "speed_rpm", ("key=value",)),
    ],
)
def test_keys_that_change_no_drawing_are_told(name, change, parts, capsys):
    assert main(["draw", name, "--set", change]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    for part in parts:
        assert part in err


def test_a_drawing_that_is_refused_is_drawn_and_told(drawn, capsys):
    text = drawn.read_text().replace("[guides.slider]\ndirection = [0.0, 1.0]\n", "")
    drawn.write_text(text)
    scene = drawn.with_name("scene.toml")
    scene.write_text(f'mechanism = "{drawn.name}"\n')
    target = drawn.with_suffix(".png")
    assert main(["draw", str(scene), "--save", str(target)]) == 2
    err = capsys.readouterr().err
    assert "rod" in err
    assert "slider" in err
    assert target.stat().st_size > 10000


@pytest.mark.parametrize(
    ("save", "loaded"),
    [(False, ""), pytest.param(True, "matplotlib", marks=pytest.mark.long)],
)
def test_neither_exudyn_nor_matplotlib_is_loaded_for_the_text(tmp_path, save, loaded):
    code = (
        "import sys\nfrom exu_press.cli import main\n"
        "assert main(sys.argv[1:]) == 0\n"
        "print(*(n for n in ('exudyn', 'matplotlib') if n in sys.modules), sep=',')"
    )

    words = [sys.executable, "-c", code, "draw", "press", "--quiet"]
    words += ["--save", str(tmp_path / "press.png")] * save
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == loaded
