import numpy as np
import pytest

from fe_models import Interface
from fe_models.elasticity import generate_mesh
from fe_models.errors import InputError


def points(part):
    mesh = generate_mesh(part)  # kept: its points are views into it
    return np.array([list(p) for p in mesh.ngmesh.Points()])


def test_same_part_same_mesh(linkage):
    assert np.array_equal(points(linkage), points(linkage))


def test_missing_face_is_named_with_those_there_are(linkage):
    part = linkage.replace(interfaces=(Interface("middle"),))
    with pytest.raises(InputError, match=r"no face named 'middle'.*'big bore'"):
        generate_mesh(part)


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


def test_the_lines_that_netgen_prints_of_a_mesh_that_fails_are_dropped(linkage, capfd):
    part = linkage.replace(geometry=Thin(), interfaces=(Interface("end"),), mesh_size=0.05)
    with pytest.raises(InputError, match=r"meshing failed at mesh_size.*try a smaller") as refused:
        generate_mesh(part)
    print("afterwards")
    assert capfd.readouterr().out == "afterwards\n"
    assert "\n" not in str(refused.value)


def test_a_mesh_that_fails_says_what_to_do(linkage):
    part = linkage.replace(geometry=Hollow(), interfaces=(Interface("end"),))
    with pytest.raises(InputError, match=r"meshing failed at mesh_size.*try a smaller"):
        generate_mesh(part)
