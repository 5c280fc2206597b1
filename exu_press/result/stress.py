"""The most stressed point of a flexible body, and the stress there over time."""

import numpy as np
from numpy.typing import NDArray

from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel, Declaration, Declarations
from exu_press.result.flexible import modal
from exu_press.result.info import Stress
from exu_press.result.recording import Record, Recording

__all__ = ["CHANNELS", "record"]

CHANNELS = Declarations(
    Declaration(
        "{body}_stress",
        "Pa",
        "{body}: von Mises stress where it is largest, with the sign of the mean stress",
        always=False,
    )
)

DEVIATOR = np.zeros((6, 6))  # of xx yy zz yz xz xy: its square is that of von Mises
DEVIATOR[:3, :3] = np.sqrt(0.5) * np.array([[1.0, -1.0, 0.0], [0.0, 1.0, -1.0], [-1.0, 0.0, 1.0]])
DEVIATOR[3:, 3:] = np.sqrt(3.0) * np.eye(3)

INSTANTS, NODES = 200, 3
"""Instants at which all nodes are evaluated, and largest ones of each that are at all instants."""

CHUNK = 500
"""Instants at once: 25 MB."""


def record(run: Recording) -> Record:
    """Return the stress at the most stressed point of each flexible body over time, and the point.

    The channel BODY_stress, Pa, is the von Mises stress with the sign of the mean normal stress.
    """
    model, time = run.model, run.time
    channels: dict[str, Channel] = {}
    worst: dict[str, Stress] = {}
    for name, placed in model.parts.items():
        reduced = placed.reduced
        if not (reduced.mode_count and len(reduced.stress)):
            continue
        q, _ = modal(model, name, reduced, len(time))
        by_node = reduced.stress.reshape(-1, 6, reduced.mode_count)
        node, instant = _worst(by_node, q)
        components = q @ by_node[node].T
        size = np.linalg.norm(components @ DEVIATOR.T, axis=1)
        point = reduced.nodes[node]
        signed = np.copysign(size, components[:, :3].sum(axis=1))
        channels |= CHANNELS.record(name, stress=signed)
        worst[name] = {
            "von_mises": float(size[instant]),
            "time": float(time[instant]),
            "place": [*placed.to_body(point), float(point[2])],
        }
    return Record(channels, info={"stress": worst})


def _worst(by_node: Array, q: Array) -> tuple[int, int]:
    """Return node and instant of the largest von Mises stress.

    Args:
        by_node: (s, 6, modes) stress components.
        q: (n, modes) modal coordinates.
    """
    deviator = np.einsum("ij,sjm->sim", DEVIATOR, by_node)
    some = np.linspace(0, len(q) - 1, min(INSTANTS, len(q))).astype(int)
    extremes = np.concatenate([q.argmax(axis=0), q.argmin(axis=0)])
    nodes = _largest(deviator, q[np.unique(np.concatenate([some, extremes]))])
    while True:
        instants = [
            _squares(deviator[nodes], q[begin : begin + CHUNK]).max(axis=0)
            for begin in range(0, len(q), CHUNK)
        ]
        instant = int(np.concatenate(instants).argmax())
        node = int(_squares(deviator, q[instant : instant + 1]).argmax())
        if node in nodes:
            return node, instant
        nodes = np.append(nodes, node)  # one more that is worst where those are


def _largest(deviator: Array, q: Array) -> NDArray[np.int64]:
    """Return the nodes of the largest stresses at some instants."""
    nodes = []
    for begin in range(0, len(q), 20):
        squares = _squares(deviator, q[begin : begin + 20])
        count = min(NODES, len(squares))
        nodes.append(np.argpartition(squares, -count, axis=0)[-count:])
    return np.unique(np.concatenate(nodes, axis=None))


def _squares(deviator: Array, q: Array) -> Array:
    """Return the squares of von Mises stresses (s, n) of nodes at instants."""
    return np.asarray(((deviator @ q.T) ** 2).sum(axis=1))
