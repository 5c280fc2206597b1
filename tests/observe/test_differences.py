"""A difference is real where the errors of the two figures do not explain it."""

from exu_press.observe.differences import difference_lines


def told(low, high):
    return {"error": (high - low) / 2.0, "determined": True, "low": low, "high": high}


def test_only_what_errors_leave_open_is_named():
    dry = {"errors": {"stroke": told(1.0, 1.1), "peak_velocity": told(2.0, 2.5)}}
    oil = {"errors": {"stroke": told(1.2, 1.3), "peak_velocity": told(2.4, 2.6)}}
    lines = difference_lines({"dry": dry, "oil": oil})
    assert lines == ["dry, oil: differences are real but for peak_velocity"]


def test_nothing_is_said_without_errors():
    assert difference_lines({"dry": {}, "oil": {}}) == []
