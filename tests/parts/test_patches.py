"""Faces that a guide or a load holds together: sides, boxes, names, and what is refused."""

import math

import pytest
from netgen.occ import Axis as Line
from netgen.occ import Box, Cylinder, Pnt, Vec, Z

from exu_press import InputError
from fe_models.dimensions import Patch, Sides
from fe_models.patches import name_patches


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
