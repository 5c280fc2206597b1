"""Solids, their faces and patches, and parts."""

import math
from dataclasses import replace
from pathlib import Path

import pytest
from netgen.occ import Axis as Line
from netgen.occ import Box, Cylinder, Pnt, Vec, Z

from fe_models import (
    CRANK_STEEL,
    LINKAGE_IRON,
    Interface,
    Material,
    OwnShape,
    StepFile,
    shipped_part,
)
from fe_models.dimensions import Patch, Sides
from fe_models.errors import InputError
from fe_models.part import shipped_names
from fe_models.patches import name_patches

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


@pytest.mark.parametrize("number", ["", "_2"])
def test_the_parts_fit_each_other_and_have_walls(number):
    crank = shipped_part("crank" + number).geometry
    rod = shipped_part("linkage" + number).geometry
    assert rod.big_width <= crank.pin_length - 0.004  # 2 mm of clearance at each side at least
    assert rod.big_bore_radius == crank.pin_radius == 0.07
    assert rod.big_outer_radius - rod.big_bore_radius > 0.03
    assert rod.small_outer_radius - rod.small_bore_radius > 0.03
    assert rod.shank_width <= min(rod.big_width, rod.small_width)
    assert rod.shank_half_height_big <= rod.big_outer_radius
    assert rod.shank_half_height_small <= rod.small_outer_radius


def test_two_builds_are_equal_but_not_the_same():
    geometry = shipped_part("linkage").geometry
    assert OwnShape(geometry.build()).key() == OwnShape(geometry.build()).key()
    assert geometry.build() is not geometry.build()


def test_own_shape_keeps_names_and_volume():
    rod = Cylinder(Pnt(0, 0, 0), Z, r=0.02, h=0.1)
    rod.faces.Max(Z).name = "end"
    own = OwnShape(rod)
    copy = own.build()
    assert copy.mass == pytest.approx(rod.mass)
    assert [face.name for face in copy.faces] == [face.name for face in rod.faces]
    other = Cylinder(Pnt(0, 0, 0), Z, r=0.02, h=0.11)
    assert OwnShape(other).key() != own.key()


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


def test_impossible_dimensions():
    crank, rod = shipped_part("crank").geometry, shipped_part("linkage").geometry
    with pytest.raises(InputError, match="web_radius"):
        replace(crank, web_radius=0.05)
    with pytest.raises(InputError, match="big_outer_radius"):
        replace(rod, big_outer_radius=0.06)
    with pytest.raises(InputError, match="must be positive"):
        replace(rod, shank_width=-1.0)
    with pytest.raises(InputError, match="pocket_depth"):
        replace(rod, pocket_depth=0.5 * rod.shank_width, rim=0.02)


def test_a_pocket_takes_volume_and_leaves_the_faces():
    rod = replace(shipped_part("linkage").geometry, pocket_depth=0.03, rim=0.03)
    names = {face.name for face in rod.build().faces}
    assert {"big bore", "small bore"} <= names
    assert rod.build().mass < shipped_part("linkage").geometry.build().mass


def test_bearings_are_the_faces_held_in_all_motions():
    assert shipped_part("crank").bearings == ("journal A", "pin", "journal B")


def test_unknown_part_motion_and_mesh_size():
    with pytest.raises(InputError, match="shipped are crank"):
        shipped_part("slide")
    with pytest.raises(InputError, match="motions"):
        Interface("pin", ("x", "x"))
    with pytest.raises(InputError, match="mesh_size"):
        shipped_part("crank", mesh_size=0.0)
    with pytest.raises(InputError, match="at most once"):
        part = shipped_part("crank")
        part.replace(interfaces=(Interface("pin"), Interface("pin")))


def test_the_papers_materials():
    assert (CRANK_STEEL.youngs_modulus, CRANK_STEEL.density) == (2.1e11, 7850.0)
    assert (LINKAGE_IRON.youngs_modulus, LINKAGE_IRON.poissons_ratio) == (1.69e11, 0.286)


@pytest.mark.parametrize("values", [(0.0, 0.3, 1.0), (1.0, 0.5, 1.0), (1.0, 0.3, float("nan"))])
def test_bad_values(values):
    with pytest.raises(InputError, match=r"material\."):
        Material(*values)


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


def test_what_a_joint_or_another_patch_holds_is_refused():
    left = (Patch(box=((-4, -3, -1), (-4, 3, 2))),)
    solid = stepped()
    next(face for face in solid.faces if places([face]) == [-4.0]).name = "pin"
    with pytest.raises(InputError, match="part: pin and it hold the same face"):
        named(solid, {"it": left}, held=("pin",))
    with pytest.raises(InputError, match="part: guide and it hold the same face"):
        named(stepped(), {"guide": Sides((1.0, 0.0)), "it": left})
