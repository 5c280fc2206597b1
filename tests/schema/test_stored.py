from typing import Any, NotRequired, TypedDict

import pytest

from exu_press import InputError
from exu_press.schema.stored import from_json


class Wheel(TypedDict):
    name: str
    teeth: int
    mass: NotRequired[float]


@pytest.mark.parametrize(
    ("kind", "text", "message"),
    [
        (str, "5", "it = 5: allowed is a text"),
        (int, "1.5", "it = 1.5: allowed is a whole number"),
        (int, "true", "it = True: allowed is a whole number"),
        (int, "1" + "0" * 400, "it = 100000000000000000...0000000000000000000: allowed is a whole"),
        (float, "NaN", "it = nan: allowed is a number"),
        (float, "1e200", r"it = 1e\+200: allowed is a number"),
        (tuple[str, ...], '"ab"', "it = 'ab': allowed is a list"),
        (tuple[str, ...], "[1]", "it = 1: allowed is a text"),
        (tuple[float, float | None], "[1]", r"it = \[1\]: allowed are 2 values"),
        (list[float], "false", "it = False: allowed is a list"),
        (dict[str, str], "[1]", r"it = \[1\]: allowed is a table"),
        (dict[str, str], '{"a b": 1}', r"it\['a b'\] = 1: allowed is a text"),
        (Wheel, '{"name": "w"}', "it: has no teeth"),
        (Wheel, '{"name": "w", "teeth": "x"}', "it.teeth = 'x': allowed is a whole number"),
        (Wheel, '{"name": "w", "teeth": 3, "colour": 1}', "it.colour: unknown key; allowed are na"),
        (str, r'"\ud800"', "allowed is a text in UTF-8"),
        (Any, r'{"\ud800": 1}', "allowed is a text in UTF-8"),
        (Any, '{"a": [1e400]}', "it.a = inf: allowed is a number"),
        (Any, "[" * 100_000, "allowed is JSON"),
        (Any, "[" * 800 + "]" * 800, "allowed is JSON"),
        (Any, "{", "allowed is JSON"),
        (Any, b"\xff", "allowed is JSON"),
    ],
)
def test_what_is_not_is_refused_in_one_line(kind, text, message):
    with pytest.raises(InputError, match=message) as caught:
        from_json(kind, text, "it")
    assert len(str(caught.value)) < 200
    assert str(caught.value).isprintable()
