"""A dry shaft over three revolutions, whose impacts part motions."""

import pytest

from exu_press import Scene, simulate

SCENE = Scene.from_dict(
    {
        "mechanism": "eccentric_press",
        "speed_rpm": 327.1655547459466,
        "revolutions": 3.0,
        "start_angle_deg": 270.74765147729784,
        "joints": {"shaft": {"kind": "dry", "clearance": 8.736209995142197e-05}},
        "contact": {"restitution": 0.9398828529733374},
        "friction": {"law": "none"},
    }
)
"""One of the random ones (seed [4, 104] of the calibration)."""


@pytest.mark.long
def test_figures_that_finer_runs_scatter_are_not_determined():
    """The run ends 0.24 clearances from one at half the tolerance, 0.44 and 0.67 from those at a
    tenth and a thirtieth. Their figures are here, the coarser one's first.
    """
    result = simulate(SCENE, errors=True, beside=False)
    assert result.info["horizon"] is not None
    for name in ("drive.mean_power", "energy.input"):
        assert not result.quantity(name).determined
    finer = {
        "drive.mean_power": (-2.63318, -9.09821),
        "peak_velocity": (1.05789, 1.05681),
        "peak_acceleration.differentiated_1khz": (63.3721, 63.3770),
    }
    for name, values in finer.items():
        found = result.quantity(name)
        assert all(found.low <= value <= found.high for value in values), name
