"""The crank pin's deflection counts from the main bearings and the driven flange."""

import numpy as np
import pytest

from exu_press import Scene

pytest.importorskip("ngsolve")


@pytest.mark.parametrize(("force", "from_mean_axes"), [((1e4, 0.0), 0.857), ((0.0, 1e4), 1.047)])
def test_static_deflection_of_a_crank_held_at_bearings_and_flange(force, from_mean_axes):
    """A force across and along the throw; the mean-axis frame moves with the modes."""
    from exu_press.placed_part import placed_parts
    from exu_press.result.flexible import deflection

    placed = placed_parts(Scene(bodies={"crank": "crank"}))["crank"]
    part = placed.reduced
    count = part.mode_count

    def motion(face):
        """Return an interface's displacement and rotation by modes and six rigid motions."""
        at = part.interface(face)
        x, y, z = at.centre
        lever = np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
        moved = np.hstack([at.translation, np.eye(3), lever])
        turned = np.hstack([at.rotation, np.zeros((3, 3)), np.eye(3)])
        return moved, turned

    held = [*motion("journal A")[0], *motion("journal B")[0][:2], motion("flange")[1][2]]
    size = count + 6
    matrix = np.zeros((size + 6, size + 6))
    matrix[:count, :count] = part.stiffness_matrix
    matrix[size:, :size] = held
    matrix[:size, size:] = np.array(held).T
    load = np.zeros(size + 6)
    pin = motion("pin")[0]
    load[:size] = pin[:2].T @ force
    solution = np.linalg.solve(matrix, load)
    moved = pin[:2] @ solution[:size]  # in the frame of the bearings, which are held
    modes = solution[:count]
    assert deflection(placed, "crank_pin", "shaft") @ modes == pytest.approx(
        moved, rel=1e-3, abs=1e-9
    )
    along = np.argmax(force)
    mean_axes = part.interface("pin").translation[along] @ modes
    assert mean_axes / moved[along] == pytest.approx(from_mean_axes, abs=0.01)
