"""Solids, their faces and patches, parts, meshes and their pictures."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread
from netgen.occ import Axis as Line
from netgen.occ import Box, Cylinder, Pnt, Vec, Z
from numpy.testing import assert_allclose

from fe_models import (
    CRANK_STEEL,
    Interface,
    Material,
    StepFile,
    draw_mode_shapes,
    shipped_part,
)
from fe_models.dimensions import Patch, Sides
from fe_models.elasticity import generate_mesh
from fe_models.errors import InputError
from fe_models.part import shipped_names
from fe_models.patches import name_patches
from fe_models.solid_view import facing

MASSES = {"crank": 217.6, "linkage": 184.5}


@pytest.mark.parametrize("name", shipped_names())
def test_masses_are_the_papers(name):
    part = shipped_part(name)
    mass = part.geometry.build().mass * part.material.density
    assert mass == pytest.approx(MASSES[name.split("_")[0]], abs=1e-3)


def test_the_cranks_volume_in_closed_form():
    shape = shipped_part("crank").geometry
    assert shape.volume() == pytest.approx(shape.build().mass, rel=1e-9)
    web = shape.web_radius_for(217.6 / CRANK_STEEL.density)
    assert replace(shape, web_radius=web).volume() * 7850.0 == pytest.approx(217.6)


def test_step_file_in_mm_with_boxes(tmp_path: Path):
    solid = Box(Pnt(0, 0, 0), Pnt(100, 20, 20))
    file = tmp_path / "rod.step"
    solid.WriteStep(str(file))
    boxes = {"left": ((0, 0, 0), (0, 0.02, 0.02)), "right": ((0.1, 0, 0), (0.1, 0.02, 0.02))}
    shape = StepFile(file, scale=1e-3, faces=boxes).build()
    assert shape.mass == pytest.approx(4e-5)
    names = [face.name for face in shape.faces]
    assert names.count("left") == names.count("right") == 1
    with pytest.raises(InputError, match="no face lies wholly inside the box of 'top'"):
        StepFile(file, scale=1e-3, faces={"top": ((1, 1, 1), (2, 2, 2))}).build()


CRANK, ROD = (shipped_part(name).geometry for name in ("crank", "linkage"))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: replace(CRANK, web_radius=0.05), "web_radius"),
        (lambda: replace(ROD, big_outer_radius=0.06), "big_outer_radius"),
        (lambda: replace(ROD, shank_width=-1.0), "must be positive"),
        (lambda: replace(ROD, pocket_depth=0.5 * ROD.shank_width, rim=0.02), "pocket_depth"),
        (lambda: shipped_part("slide"), "shipped are crank"),
        (lambda: shipped_part("crank", mesh_size=0.0), "mesh_size"),
        (lambda: shipped_part("crank").replace(interfaces=(Interface("pin"),) * 2), "at most once"),
        (lambda: Interface("pin", ("x", "x")), "motions"),
        (lambda: Material(0.0, 0.3, 1.0), r"material\."),
        (lambda: Material(1.0, 0.3, math.nan), r"material\."),
    ],
)
def test_impossible_values_are_refused(make, message):
    with pytest.raises(InputError, match=message):
        make()


def stepped():
    """Return a block of 8 x 6 x 3 with a step on its right side and a bore, in m."""
    solid = Box(Pnt(-4, -3, -1), Pnt(4, 3, 2)) - Box(Pnt(3, -3, -1), Pnt(4, 0, 2))
    return solid - Cylinder(Pnt(0, 0, -2), Z, r=1, h=5)


def named(solid, patches, held=()):
    name_patches(solid, patches, held, "part")
    return {name: [f for f in solid.faces if f.name == name] for name in patches}


def places(faces):
    """Return x of the faces' middles."""
    return sorted(round(0.5 * sum(end[0] for end in face.bounding_box), 3) for face in faces)


def test_sides_are_the_outermost_planes_on_both_sides():
    assert places(named(stepped(), {"guide": Sides((1.0, 0.0))})["guide"]) == [-4.0, 4.0]
    turned = stepped().Rotate(Line(Pnt(0, 0, 0), Z), 30.0).Move(Vec(1, 2, 3))
    c, s = math.cos(math.radians(30.0)), math.sin(math.radians(30.0))
    assert len(named(turned, {"guide": Sides((c, s))})["guide"]) == 2


def test_a_patch_takes_several_boxes_and_names_together():
    solid = stepped()
    solid.faces.Max(Z).name = "top"
    inf = math.inf
    right = Patch(box=((2.9, -inf, -inf), (inf, inf, inf)))  # the step's face and the outer one
    found = named(solid, {"rail": (Patch("top"), right)})["rail"]
    assert places(found)[1:] == [3.0, 3.5, 4.0]
    assert len(found) == 4


@pytest.mark.parametrize(
    ("patch", "message"),
    [
        (Sides((0.6, 0.8)), "part: has no plane faces on both sides across the guide's direction"),
        ((Patch("rail"),), "part: has no face named 'rail' for it; its faces are named nothing"),
        (
            (Patch(box=((5.0, -math.inf, 0.0), (6.0, math.inf, 1.0))),),
            r"part: no face for it lies wholly within x = \[5, 6\], z = \[0, 1\]; the solid fills",
        ),
    ],
)
def test_a_patch_without_faces_is_refused(patch, message):
    with pytest.raises(InputError, match=message) as refused:
        named(stepped(), {"it": patch})
    assert "\n" not in str(refused.value)


class Hollow:
    """A geometry that is no solid: a face."""

    def key(self):
        return {}

    def build(self):
        from netgen.occ import Box, Pnt, X

        face = Box(Pnt(0, 0, 0), Pnt(1, 1, 1)).faces.Max(X)
        face.name = "end"
        return face


class Thin:
    """A pipe with a wall of 10 um: its two sides' triangles cut each other."""

    def key(self):
        return {}

    def build(self):
        from netgen.occ import Cylinder, Pnt, Z

        bore = Cylinder(Pnt(0, 0, -1), Z, r=0.05999, h=3)
        bore.faces.name = "end"
        return Cylinder(Pnt(0, 0, 0), Z, r=0.06, h=0.1) - bore


@pytest.mark.parametrize(("geometry", "size"), [(Hollow(), 0.06), (Thin(), 0.05)])
def test_a_mesh_that_fails_says_what_to_do_in_one_line(linkage, geometry, size, capfd):
    """What Netgen prints of it is dropped."""
    part = linkage.replace(geometry=geometry, interfaces=(Interface("end"),), mesh_size=size)
    with pytest.raises(InputError, match=r"meshing failed at mesh_size.*try a smaller") as refused:
        generate_mesh(part)
    print("afterwards")
    assert capfd.readouterr().out == "afterwards\n"
    assert "\n" not in str(refused.value)


def test_picture_is_drawn_and_coloured(bar, tmp_path: Path):
    file = tmp_path / "bar.png"
    draw_mode_shapes(bar, file, modes=(2, 5))
    picture = imread(file)[:, :, :3]
    assert picture.shape[1] > 1000
    coloured = (picture.max(axis=2) - picture.min(axis=2)) > 0.3
    assert coloured.mean() > 0.02


POINTS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
OUTWARDS = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def test_faces_behind_and_edge_on_are_left_out_and_near_ones_come_last():
    corners, seen, light = facing(POINTS, OUTWARDS)
    assert seen.tolist() == [[1, 2, 3]]
    assert_allclose(corners[0], [[1, 0], [0, 1], [0, 0]])
    assert 0.0 < light[0] <= 1.0
    both = np.vstack([POINTS + np.array([0, 0, 5]), POINTS])
    _, seen, _ = facing(both, np.vstack([OUTWARDS, OUTWARDS + 4]))
    assert seen.tolist() == [[5, 6, 7], [1, 2, 3]]
