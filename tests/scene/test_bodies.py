"""[bodies.NAME]: which bodies are flexible, what is refused, and how a scene is changed."""

from exu_press import Scene
from exu_press.scene import Face, Flexible, flexible_press


def test_a_part_alone_or_with_its_keys():
    short, long = Scene(bodies={"linkage": "linkage"}), Scene(bodies=flexible_press(modes=4))
    assert short.bodies == {"linkage": Flexible("linkage")}
    assert {name: body.modes for name, body in long.bodies.items()} == {"crank": 4, "linkage": 4}
    assert Scene().bodies == {}


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
