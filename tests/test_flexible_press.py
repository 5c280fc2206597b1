"""The press with flexible crank shaft and linkage."""

import numpy as np
import pytest
from coarse_parts import COARSE

from exu_press import Scene, simulate
from exu_press.scene import flexible_press

SHORT = {"revolutions": 0.04}
MESH = 0.1
VARIANTS = [("ideal", "ideal"), ("ideal", "dry"), ("dry", "dry"), ("lubricated", "dry")]


@pytest.fixture(scope="module")
def linkage_as_solid():
    """Mass properties of the solid linkage, for a rigid twin of the flexible body."""
    from fe_models import Reduction, reduced_part, shipped_part

    part = reduced_part(shipped_part("linkage", MESH), Reduction(modes=0))
    offset = float(part.centre_of_mass[0])
    inertia = float(part.inertia[2, 2]) - part.mass * offset**2
    return {"linkage_mass_offset": offset, "linkage_inertia": inertia, "linkage_mass": part.mass}


@pytest.mark.parametrize(
    ("crank_pin", "balls"),
    [*VARIANTS[::3], *(pytest.param(*v, marks=pytest.mark.long) for v in VARIANTS[1:3])],
)
def test_without_modes_it_is_the_rigid_press(crank_pin, balls, linkage_as_solid):
    """Fixed steps, so that both take the same ones; masses to the mesh's 1e-3."""
    scene = Scene(
        joints={"crank_pin": crank_pin, "balls": balls}, revolutions=0.02, solver={"step": 1e-5}
    )
    twin = {k: v for k, v in linkage_as_solid.items() if k != "linkage_mass"}
    rigid = simulate(scene.replace({f"press.{key}": value for key, value in twin.items()}))
    flexible = simulate(scene.replace({"bodies": flexible_press(modes=0, mesh_size=MESH)}))
    assert np.abs(rigid["slider_position"] - flexible["slider_position"]).max() < 1e-8
    assert flexible.completed


def test_the_balance_knows_that_the_frame_of_a_bending_crank_tilts():
    """In the plane alone it misses 3e-4 of what the drive puts in, however fine the steps."""
    scene = Scene(
        bodies=COARSE,
        joints={"crank_pin": "lubricated", "balls": "dry"},
        revolutions=0.1,
    )
    result = simulate(scene)
    assert result.quantity("energy.residual").value < 3e-5
    assert 1e-7 < np.abs(result["crank_pin_deflection"]).max() < 1e-3
    assert np.abs(result["linkage_elongation"]).max() > 1e-8
    assert 1e5 < result.summary()["stress"]["linkage"]["von_mises"] < 1e9


@pytest.fixture(scope="module")
def oiled_run():
    joints = {"crank_pin": "lubricated", "balls": "dry"}
    result = simulate(Scene(bodies=COARSE, joints=joints, revolutions=0.02))
    assert result.completed
    return result


def rigid_motion(points, displacement):
    """Return displacement and rotation (3,) that fit best to displacements of points, (n, 3)."""
    rows = [
        np.hstack([np.eye(3), np.cross(np.eye(3), point).T])  # rotation x point
        for point in points
    ]
    fit = np.linalg.lstsq(np.vstack(rows), displacement.ravel(), rcond=None)[0]
    return fit[:3], fit[3:]


def test_a_bearing_sees_the_slope_of_its_shaft(oiled_run):
    """By a fit to the surface of both main journals, whose middles stay where they are."""
    surface, fits = oiled_run.surfaces["crank"], []
    displacement = surface.displacement(oiled_run["crank_modes"][-1])
    for middle in (-0.3295, 0.3295):
        near = np.abs(surface.nodes[:, 2] - middle) < 0.05
        points = surface.nodes[near] - [*surface.nodes[near][:, :2].mean(axis=0), middle]
        fits.append(rigid_motion(points, displacement[near]))
    (at_a, rotation_a), (at_b, rotation_b) = fits
    frame = (at_b - at_a)[:2] / 0.659
    angle = oiled_run["body_position"][-1, oiled_run.bodies.index("crank"), 2]
    c, s = np.cos(angle), np.sin(angle)
    slopes = [
        np.array([[c, -s], [s, c]]) @ (np.array([rotation[1], -rotation[0]]) - frame)
        for rotation in (rotation_a, rotation_b)
    ]
    recorded = oiled_run["shaft_slope"][-1]
    apart = min(np.linalg.norm(recorded - slope) for slope in slopes)
    assert apart < 0.1 * np.linalg.norm(recorded)
    largest = np.hypot(*oiled_run["shaft_slope"].T).max()
    assert oiled_run.quantity("joints.shaft.peak_slope").value == pytest.approx(largest)
    assert largest > 1e-6
