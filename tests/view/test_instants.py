import numpy as np
import pytest

from exu_press.errors import InputError
from exu_press.view import instants, moment


def test_a_revolution_takes_five_seconds(runs):
    shown = instants(runs["press"])
    assert len(shown) == 1 + round(0.3 * 5 * 25)
    assert shown.slow == pytest.approx(20.0, rel=1.0 / len(shown))  # a whole number of frames
    assert np.ptp(np.diff(shown.time)) < 1e-12


def test_every_step_is_seen_exactly_once(runs):
    """An impact between two frames is not lost."""
    time = runs["press"].time
    shown = instants(runs["press"], frames=7)
    steps = [s for f in range(len(shown)) for s in range(len(time))[shown.steps_since_last(f)]]
    assert steps == list(range(len(time)))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"start": -1.0}, "--from -1: the record goes from 0 to 0.075 s"),
        ({"start": 0.02, "stop": 0.01}, "--from 0.02 --to 0.01"),
        ({"fps": 0.0}, "--fps 0: allowed is 1 to 120"),
        ({"slow": -2.0}, "--slow -2: allowed is a number > 0"),
        ({"slow": 2.0, "frames": 3}, "allowed is one of the two"),
        ({"slow": 1e30}, "frames: allowed is 2 to"),
        ({"slow": float("nan")}, "--slow nan"),
        ({"start": float("nan")}, "--from nan"),
    ],
)
def test_wrong_options(runs, options, message):
    with pytest.raises(InputError, match=message):
        instants(runs["press"], **options)
    with pytest.raises(InputError, match=r"--at 3: allowed is 0 to 0\.075 s"):
        moment(runs["press"], 3.0)
