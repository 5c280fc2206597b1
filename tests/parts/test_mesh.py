"""Meshes and their pictures."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread
from numpy.testing import assert_allclose

from fe_models import Interface, draw_mode_shapes
from fe_models.elasticity import generate_mesh
from fe_models.errors import InputError
from fe_models.solid_view import facing


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
