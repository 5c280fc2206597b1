"""[bodies.NAME]: which bodies are flexible, what is refused, and how a scene is changed."""

import pytest

from exu_press import InputError, Scene
from exu_press.scene import Face, Flexible, flexible_press
from exu_press.scene.template import template


def test_a_part_alone_or_with_its_keys():
    short, long = Scene(bodies={"linkage": "linkage"}), Scene(bodies=flexible_press(modes=4))
    assert short.bodies == {"linkage": Flexible("linkage")}
    assert {name: body.modes for name, body in long.bodies.items()} == {"crank": 4, "linkage": 4}
    assert Scene().bodies == {}


@pytest.mark.parametrize(
    ("bodies", "message"),
    [
        ("flexible", r"bodies = 'flexible': allowed is a table for each flexible body"),
        ({"linkige": "linkage"}, r"bodies\.linkige = 'linkage': press has no such body \(did you"),
        (
            {"linkage": {"flexible": "linkage", "faces": {"guide": "pin"}}},
            r"bodies\.linkage\.faces\.guide: linkage has no such joint.*allowed are crank_pin",
        ),
        ({"linkage": {"modes": 4}}, r"bodies\.linkage\.flexible: missing"),
        ({"linkage": 3}, r"bodies\.linkage = 3: allowed is a shipped part, a STEP file's path, or"),
        (flexible_press(modes=-1), r"bodies\.crank\.modes = -1: allowed is a whole number >= 0"),
        (flexible_press(modes=2.5), r"bodies\.crank\.modes = 2\.5"),
        (
            flexible_press(mode=2),
            r"bodies\.crank\.mode = 2: unknown key \(did you mean 'modes'\?\)",
        ),
        (flexible_press(poissons_ratio=-0.1), r"bodies\.crank\.poissons_ratio = -0\.1: allowed is"),
        (flexible_press(poissons_ratio=0.5), r"bodies\.crank\.poissons_ratio = 0\.5: allowed is a"),
        (flexible_press(youngs_modulus=0), r"bodies\.crank\.youngs_modulus = 0.*allowed is .* > 0"),
        (
            flexible_press(modes=4, flexibility_error=0.01),
            r"bodies\.crank\.modes and flexibility_error: allowed is one of the two",
        ),
        (flexible_press(flexibility_error=0.0), r"crank\.flexibility_error = 0\.0: allowed is a"),
        (
            flexible_press(origin=[1]),
            r"crank\.origin = \[1\]: allowed is a list of 2 numbers",
        ),
        (flexible_press(faces="pin"), r"bodies\.crank\.faces = 'pin': allowed is a table"),
        (flexible_press(faces={"pins": "pin"}), r"crank\.faces\.pins: crank has no such joint"),
        (
            flexible_press(faces={"crank_pin": 3}),
            r"crank\.faces\.crank_pin = 3: allowed is a face's",
        ),
        (
            flexible_press(faces={"drive": {"z": [0, 1]}}),
            r"drive = \{'z'.*allowed is a face's name",
        ),
        (flexible_press(faces={"drive": ["pin", "web"]}), r"faces\.drive = \['pin', 'web'\]: allo"),
        (flexible_press(faces={"crank_pin": {"r": 3}}), r"faces\.crank_pin\.r = 3: unknown key"),
        (
            flexible_press(faces={"crank_pin": {"radius": -1}}),
            r"pin\.radius = -1\.0: allowed",
        ),
        (
            flexible_press(faces={"crank_pin": {"z": [1, 0]}}),
            r"pin\.z = \[1\.0, 0\.0\]: allowed",
        ),
    ],
)
def test_what_is_refused_in_one_line(bodies, message):
    with pytest.raises(InputError, match=message) as refused:
        Scene(bodies=bodies)
    assert "\n" not in str(refused.value)


def test_the_table_of_before_is_named():
    with pytest.raises(InputError, match=r"flexible = .*: is bodies\.NAME now"):
        Scene.from_dict({"flexible": {"modes": 4}})
    with pytest.raises(InputError, match=r"flexible\.modes = 4: is bodies\.NAME now"):
        Scene().replace({"flexible.modes": 4})


def test_one_key_a_part_or_all_bodies_are_replaced():
    scene = Scene().replace({"bodies.linkage": "linkage"}).replace({"bodies.linkage.modes": 6})
    assert scene.bodies == {"linkage": Flexible("linkage", modes=6)}
    assert scene.replace({"bodies.linkage": "linkage_2"}).bodies["linkage"].modes == 20
    assert scene.replace({"bodies": {}}).bodies == {}
    assert scene.replace({"mechanism": "slider_crank"}).bodies == {}
    both = scene.replace({"bodies.linkage": "linkage_2", "bodies.linkage.modes": 3})
    assert both.bodies["linkage"] == Flexible("linkage_2", modes=3)


def test_a_flexibility_error_takes_the_place_of_the_modes_and_back():
    scene = Scene(bodies=flexible_press()).replace({"bodies.crank.flexibility_error": 0.01})
    assert (scene.bodies["crank"].modes, scene.bodies["linkage"].modes) == (None, 20)
    back = scene.replace({"bodies.crank.modes": 6}).bodies["crank"]
    assert (back.modes, back.flexibility_error) == (6, None)


def test_faces_are_a_name_a_table_or_several():
    faces = {"crank_pin": "pin", "shaft": ["a", {"radius": 0.1, "z": [0, 1]}]}
    body = Scene(bodies={"crank": {"flexible": "crank", "faces": faces}}).bodies["crank"]
    assert body.faces["crank_pin"] == (Face("pin"),)
    assert body.faces["shaft"] == (Face("a"), Face(radius=0.1, z=(0.0, 1.0)))


def test_a_file_lies_beside_its_scene(tmp_path):
    (tmp_path / "scenes").mkdir()
    path = tmp_path / "scenes" / "mine.toml"
    path.write_text('mechanism = "four_bar"\n[bodies]\ncoupler = "my.step"\n')
    scene = Scene.load(path)
    assert scene.bodies["coupler"].path == tmp_path / "scenes" / "my.step"
    scene.save(tmp_path / "other.toml")
    assert 'flexible = "scenes/my.step"' in (tmp_path / "other.toml").read_text()


@pytest.mark.parametrize(("mechanism", "body"), [("press", "linkage"), ("six_bar", "rod")])
def test_the_template_has_an_example_that_is_right(mechanism, body, tmp_path):
    lines, inside = [], False
    for line in template(mechanism).splitlines():
        inside = line.startswith(f"# [bodies.{body}]") or (inside and line.startswith("# "))
        given = line.partition("  #")[0].partition("=")[2].strip() or line.startswith("# [")
        lines.append(line.removeprefix("# ") if inside and given else line)
    (tmp_path / "scene.toml").write_text("\n".join(lines))
    assert list(Scene.load(tmp_path / "scene.toml").bodies) == [body]
