"""Forces of a joint, and its Jacobian against their differences."""

import numpy as np

from exu_press.joints.joint import GROUND


def forces(joint, q, q_t):
    """Return the generalised forces of a joint between two planar bodies, (6,)."""
    out = [0.0] * 9
    joint.add_force([*q, *GROUND], [*q_t, *GROUND], out)
    return np.array(out[:6])


def assert_partials(given, forces, state, factors, allowed):
    """Check -(by_q dQ/dq + by_q_t dQ/dq_t), row by row, against differences.

    Args:
        given: the joint's Jacobian, (n, n).
        forces: function of no argument that returns the forces in `state`.
        state: (q, q_t), lists that are changed for the differences.
        factors: by_q, by_q_t.
        allowed: error over the size of row and column.
    """
    expected, size = np.zeros_like(given), np.zeros_like(given)
    for target, factor, width in zip(state, factors, (1e-9, 1e-7), strict=True):
        for i, kept in enumerate(target):
            target[i] = kept + width
            high = forces()
            target[i] = kept - width
            low = forces()
            target[i] = kept
            column = factor * (high - low) / (2 * width)
            expected[:, i] -= column
            size[:, i] += np.abs(column)
    scale = np.sqrt(size.max(axis=1, keepdims=True) * size.max(axis=0, keepdims=True))
    assert np.all(np.abs(given - expected) < allowed * scale), (given - expected) / scale
