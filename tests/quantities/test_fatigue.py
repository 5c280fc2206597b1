"""Rainflow cycles and Miner's sum, against a count by hand and a figure in closed form."""

import dataclasses

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.quantities.fatigue import damage
from exu_press.scene import Flexible

pytest.importorskip("rainflow")

LINE = Flexible("linkage", sn_stress=1e8, sn_cycles=2e6, sn_slope=5.0)


def test_the_example_of_the_standard():
    """ASTM E1049-85, Fig. 6: ranges 3, 4, 4, 6, 8, 8, 9 counted half or once."""
    import rainflow

    cycles = rainflow.count_cycles([-2, 1, -3, 5, -1, 3, -4, 4, -2])
    assert cycles == [(3, 0.5), (4, 1.5), (6, 0.5), (8, 1.0), (9, 0.5)]
    by_hand = sum(n * (0.5 * r) ** 5 for r, n in cycles) / 1e8**5 / 2e6
    assert damage([(0.5 * r, n) for r, n in cycles], LINE) == pytest.approx(by_hand)


def test_one_cycle_a_revolution():
    """A sine of known amplitude at the most stressed place, over two whole revolutions."""
    scene = Scene(mechanism="slider_crank", joints={}, revolutions=2.0)
    result = simulate(scene)
    time = result.time
    angle = result["crank_angle"]
    amplitude = 5e7
    changed = dataclasses.replace(
        result,
        scene=scene.replace({"bodies": {"rod": dataclasses.replace(LINE)}}),
        channels=dict(result.channels)
        | {
            "rod_stress": dataclasses.replace(
                result.channels["time"], values=amplitude * np.sin(angle)
            )
        },
    )
    assert len(time) > 100

    def read(name):
        return changed.quantity(f"bodies.rod.fatigue.{name}").value

    assert read("largest_amplitude") == pytest.approx(amplitude, rel=1e-3)
    assert read("cycles") == pytest.approx(1.0, rel=1e-3)
    assert read("life") == pytest.approx(2e6 * 2.0**5, rel=1e-3)
    spike = np.where(np.arange(len(time)) == 3 * len(time) // 4, amplitude, -amplitude)
    changed = changed.with_values({"rod_stress": spike})
    assert read("cycles") == pytest.approx(1.0)  # a whole one, as its largest value comes again
