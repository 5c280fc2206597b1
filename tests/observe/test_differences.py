"""A difference is real where the errors of the two figures do not explain it."""

from exu_press.observe.differences import difference_lines


def told(low, high):
    return {"error": (high - low) / 2.0, "determined": True, "low": low, "high": high}


def test_only_what_errors_leave_open_is_named():
    dry = {"errors": {"stroke": told(1.0, 1.1), "peak_velocity": told(2.0, 2.5)}}
    oil = {"errors": {"stroke": told(1.2, 1.3), "peak_velocity": told(2.4, 2.6)}}
    lines = difference_lines({"dry": dry, "oil": oil})
    assert lines == ["dry, oil: all differences exceed their errors, except in peak_velocity"]


def test_rounding_is_no_difference():
    """A slider in guides without play does not tilt."""
    one, other = (
        {"errors": {"slider_tilt": told(0.0, 2e-17)}},
        {"errors": {"slider_tilt": told(0.0, 1e-17)}},
    )
    assert difference_lines({"dry": one, "oil": other}) == [
        "dry, oil: all differences exceed their errors"
    ]
    one["scene"] = {"guide": {}}
    assert difference_lines({"dry": one, "oil": other})[0].endswith("slider_tilt")


def test_nothing_is_said_without_errors():
    assert difference_lines({"dry": {}, "oil": {}}) == []


def test_a_run_without_errors_is_named():
    lines = difference_lines({"dry": {"errors": {"stroke": told(1.0, 1.1)}}, "old": {}})
    assert lines == ["dry, old: nobody knows which differences are real, as old has no errors"]


def test_many_names_are_wrapped():
    names = [f"joints.knuckle_{n}.peak_force" for n in range(20)]
    one = {"errors": {name: told(1.0, 2.0) for name in names}}
    other = {"errors": {name: told(1.5, 2.5) for name in names}}
    lines = difference_lines({"dry": one, "oil": other})
    assert max(map(len, lines)) <= 100
    assert " ".join(line.strip() for line in lines).count("knuckle") == 20
