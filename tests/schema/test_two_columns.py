"""One table as instruments and spreadsheets write it."""

import pytest

from exu_press.schema.two_columns import read_two_columns


@pytest.mark.parametrize(
    "text",
    [
        "time (s),x (kN m)\n1,0.5\n2,-1e3\n",
        "\ufeff# from the press\ntime (s), x (kN m)\r\n1, 0.5\r\n\r\n2, -1000\r\n",
        "time (s);x (kN m)\n1;0.5\n2;-1e3\n",
        "time (s);x (kN m)\n1;0,5\n2;-1,0e3\n",
        "time (s)\tx (kN m)\n1\t0,5\n2\t-1000\n",
        '"time (s)","x (kN m)"\n"1","0.5"\n"2","-1000"\n',
        '"time (s)";"x (kN m)"\n"1,0";"0,5"\n"2,0";"-1000"\n',
    ],
)
def test_the_same_table(text, tmp_path):
    path = tmp_path / "table.csv"
    path.write_text(text, encoding="utf-8")
    read = read_two_columns(path)
    assert read.head == ["time (s)", "x (kN m)"]
    assert (read.places, read.values) == ([1.0, 2.0], [0.5, -1000.0])
