"""A joint's state in a state of its two bodies."""

__all__ = ["state_in"]


def state_in(joint, q, q_t):
    """Return the state of a joint whose forces are asked for in a state of its coordinates."""
    joint.add_force(q, q_t, [0.0] * len(q))
    return joint.state
