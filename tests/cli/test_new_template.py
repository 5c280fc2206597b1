"""A scene file to start from: what it says is the mechanism's own scene, what it hides is right."""

import pytest

from exu_press import Scene
from exu_press.cli.new import template
from exu_press.mechanism import SHIPPED


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
        ("drive", {"rated_torque": 400.0, "inertia": 50.0}),
        ("load.blanking", {"kind": "blanking", "force": 1e4}),
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
