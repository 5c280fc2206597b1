"""Forces and state of a joint, and its Jacobian against differences of its forces."""

import numpy as np

from exu_press.joints.joint import GROUND


def forces(joint, q, q_t):
    """Return the generalised forces of a joint whose bodies have the coordinates q."""
    out = [0.0] * (len(q) + 3)
    joint.add_force([*q, *GROUND], [*q_t, *GROUND], out)
    return np.array(out[: len(q)])


def state_in(joint, q, q_t):
    """Return the state of a joint whose forces are asked for in a state of its coordinates."""
    joint.add_force(q, q_t, [0.0] * len(q))
    return joint.state


def assert_jacobian(joint, q, q_t, factors, allowed, by_rows=True):
    """Check a joint's Jacobian of a state, where its forces are those of all of q."""
    force = forces(joint, q, q_t)
    state = [*q], [*q_t]
    given = np.reshape(joint.jacobian(*factors), (len(force), -1))
    assert_partials(given, lambda: forces(joint, *state), state, factors, allowed, by_rows)


def assert_partials(given, forces, state, factors, allowed, by_rows=True):
    """Check -(by_q dQ/dq + by_q_t dQ/dq_t) against differences.

    Args:
        given: the joint's Jacobian, (n, n).
        forces: function of no argument that returns the forces in `state`.
        state: (q, q_t), lists that are changed for the differences.
        factors: by_q, by_q_t.
        allowed: error over the size.
        by_rows: of row and column, else of the whole.
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
    if not by_rows:
        scale = scale.max()
    assert np.all(np.abs(given - expected) <= allowed * scale), (given - expected) / scale
