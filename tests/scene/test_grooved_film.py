"""[[film.grooves]] of a scene: read, written, refused by name, and run."""

import pytest

from exu_press import InputError, Scene, bearing_coefficients, simulate

AXIAL = [{"angle_deg": 90.0, "width_deg": 10.0}, {"angle_deg": -90.0, "width_deg": 10.0}]
RING = [{"width_deg": 360.0, "length": 0.005}]


def scene(grooves, **keys):
    film = {"law": "grooved", "length": 0.05, "viscosity": 0.05, "grooves": grooves}
    crank_pin = {"kind": "lubricated", "clearance": 1e-4, "radius": 0.05}
    return Scene(mechanism="slider_crank", joints={"crank_pin": crank_pin}, film=film, **keys)


def test_a_file_has_them_again(tmp_path):
    given = scene(AXIAL)
    given.save(tmp_path / "scene.toml", comments=True)
    assert Scene.load(tmp_path / "scene.toml") == given
    assert Scene.from_dict(given.to_dict()) == given
    assert given.to_dict()["film"]["grooves"] == AXIAL


@pytest.mark.parametrize(
    ("grooves", "words"),
    [
        (None, "film.grooves: missing; allowed is one"),
        ([], "film.grooves = .*allowed is a list of tables"),
        ([{}], "film.grooves.width_deg: missing"),
        ([{"width_deg": 1e-20}], "film.grooves.width_deg = 1e-20"),
        ([{"width_deg": 5.0, "angle_deg": 1e30}], "film.grooves.angle_deg = 1e"),
        ([AXIAL[0], AXIAL[0]], "film.grooves at 90 and 90 deg overlap"),
        ([{"width_deg": 359.9999}], "1 deg of bearing between them"),
        ([{"width_deg": 361.0}], "film.grooves.width_deg = 361.0"),
        ([{"width_deg": 10.0, "length": 0.051}], "film.grooves.0.length = 0.051"),
        ([AXIAL[0], {"angle_deg": 99.0, "width_deg": 9.0}], "at 90 and 99 deg overlap"),
        ([{"width_deg": 360.0}], "film.grooves: .*shorter than the bearing"),
        ([{"width_deg": 10.0, "angel": 1.0}], "film.grooves.0.angel = 1.0: unknown key"),
    ],
)
def test_what_is_no_groove_is_refused_by_name(grooves, words):
    with pytest.raises(InputError, match=words):
        scene(grooves)


@pytest.mark.long
def test_a_run_keeps_its_energy_and_the_film_its_heat():
    """A groove around: quick to tabulate. The residual of the balance, and oil that warms."""
    given = scene(RING, revolutions=1.0)
    result = simulate(given)
    assert result.summary()["status"] == "completed"
    assert result.quantity("energy.residual").value < 1e-4
    oil = {"viscosity_cst": [68.0, 8.7], "density": 870.0, "supply_celsius": 40.0}
    warm = given.replace({"film.oil": oil})
    bearing = bearing_coefficients(warm, "crank_pin", load=(0.0, -5e3), speed_rpm=300.0)
    carried = 1.8e6 * bearing.side_flow * (bearing.temperature - 40.0)
    assert bearing.power == pytest.approx(carried, rel=1e-5)
    assert simulate(warm).summary()["status"] == "completed"
