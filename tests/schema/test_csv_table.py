"""Tables as CSV files, and as instruments and spreadsheets write them."""

import pytest

from exu_press.schema.csv_table import read_csv, write_csv
from exu_press.schema.two_columns import read_two_columns


def test_what_was_written_is_read_again(tmp_path):
    columns = {
        "speed_rpm": (1.0 / 3.0, 1e-300, None),
        "kind": ("dry", 'a "quoted", text', "x1e400"),
        "warms": (True, False, None),
    }
    write_csv(tmp_path / "table.csv", columns)
    assert read_csv(tmp_path / "table.csv") == columns


def test_columns_without_rows(tmp_path):
    write_csv(tmp_path / "table.csv", {"a": [], "b": []})
    assert read_csv(tmp_path / "table.csv") == {"a": (), "b": ()}


@pytest.mark.parametrize("text", ["", "a,b\n1\n", "a\n1,2\n", "a\n1e400\n", "a\nnan\n"])
def test_what_is_no_table_is_refused(tmp_path, text):
    (tmp_path / "table.csv").write_text(text)
    with pytest.raises(ValueError):
        read_csv(tmp_path / "table.csv")


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
