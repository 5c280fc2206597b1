import pytest

from fe_models import Interface, shipped_part
from fe_models.errors import InputError


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
