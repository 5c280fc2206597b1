"""A table as a CSV file: what was written is read again."""

import pytest

from exu_press.schema.csv_table import read_csv, write_csv


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
