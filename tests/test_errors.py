from exu_press.cli.main import main
from exu_press.errors import InputError


def test_a_message_shows_names_that_no_terminal_can():
    assert str(InputError("joints.t\x1f\u2028\n is µm")) == r"joints.t\x1f\u2028\n is µm"


def test_a_key_with_control_characters_is_named_in_one_line(tmp_path, capsys):
    scene = tmp_path / "scene.toml"
    scene.write_text('[joints]\n"pin\\u001b[31m" = {kind = "dry"}\n', encoding="utf-8")
    assert main(["run", str(scene)]) == 2
    told = capsys.readouterr().err
    assert told.strip().isprintable() and r"pin\x1b[31m" in told


def test_of_a_long_word_the_ends_are_shown():
    told = str(InputError(f"mechanism = '{'x' * 5000}y': allowed is one of a, b"))
    assert told.startswith("mechanism = 'xxx") and told.endswith("xy': allowed is one of a, b")
    assert len(told) < 500
