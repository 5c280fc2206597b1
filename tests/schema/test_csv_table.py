"""Tables as CSV files, and as instruments and spreadsheets write them."""

import pytest

from exu_press.schema.csv_table import write_csv
from exu_press.schema.two_columns import read_two_columns


def test_numbers_are_written_with_all_digits_and_texts_quoted(tmp_path):
    columns = {
        "speed_rpm": (1.0 / 3.0, 1e-300, None),
        "kind": ("dry", 'a "quoted", text', "x1e400"),
        "warms": (True, False, None),
    }
    write_csv(tmp_path / "table.csv", columns)
    assert (tmp_path / "table.csv").read_text() == (
        "speed_rpm,kind,warms\n"
        "0.3333333333333333,dry,true\n"
        '1e-300,"a ""quoted"", text",false\n'
        ",x1e400,\n"
    )


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
