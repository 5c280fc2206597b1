"""Print the tables of docs/validation.md: every comparison with others' numbers.

Run with: python scripts/validation.py [PYTEST'S ARGUMENT ...]
"""

import argparse
import contextlib
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from exu_press.quantities.uncertain import significant, uncertain

ROOT = Path(__file__).parents[1]


class Collection:
    """What the tests compare: a plugin of pytest."""

    def __init__(self):
        self.comparisons = []

    def pytest_runtest_logreport(self, report):
        test = report.nodeid.partition("[")[0]
        if report.when == "call":
            rows = [value for name, value in report.user_properties if name == "comparison"]
            self.comparisons += [{**row, "test": test} for row in rows]


def main(arguments: Sequence[str] | None = None) -> int:
    """Return pytest's exit status."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    _, chosen = parser.parse_known_args(arguments)
    collection = Collection()
    with contextlib.chdir(ROOT), contextlib.redirect_stdout(sys.stderr):
        status = pytest.main(["-m", "validation", "-n", "0", *chosen], [collection])
    rows = sorted(collection.comparisons, key=lambda row: row["test"])  # also of several workers
    print("\n".join(page_lines(rows)))
    return int(status)


def page_lines(comparisons):
    """Return tables in Markdown, one for each kind, each with the list of its sources."""
    from comparisons import KINDS

    lines, number = [], 0
    for kind, heading in KINDS.items():
        rows = [row for row in comparisons if row["kind"] == kind]
        if not rows:
            continue
        sources = []
        table = [("", "quantity", "theirs", "ours", "deviation", "at most")]
        origins = dict.fromkeys((row["subject"], row["source"]) for row in rows)
        for subject, source in origins:
            number += 1
            own = merged(
                row for row in rows if (row["subject"], row["source"]) == (subject, source)
            )
            names = [f"{subject} [{number}]"] + [""] * len(own)
            table += [(name, *cells(row)) for name, row in zip(names, own, strict=False)]
            sources += [f"- [{number}] {line}" for line in source_lines(own)]
        lines += [f"**{heading}**", "", *markdown(table), "", *sources, ""]
    return lines[:-1]


def merged(rows):
    """Return one row for each quantity: the one that deviates most, with the tests of all."""
    kept = {}
    for row in rows:
        row = {**row, "tests": {row["test"]: None}}
        if (last := kept.get(row["quantity"])) is not None:
            tests, count = last["tests"] | row["tests"], last["count"] + row["count"]
            worst = max(last, row, key=lambda row: abs(row["deviation"]) / row["allowed"])
            row = {**worst, "tests": tests, "count": count}
        kept[row["quantity"]] = row
    return list(kept.values())


def cells(row):
    """Return quantity, theirs, ours, deviation and what is allowed as text."""
    unit = f", {row['unit']}" if row["unit"] else ""
    count = f" ({row['count']} values)" if row["count"] > 1 else ""
    stated = None if row["error"] is None else {"error": row["error"], "determined": True}
    return (
        f"{row['quantity']}{unit}{count}",
        significant(row["theirs"] + 0.0, 5),  # no -0
        uncertain(row["ours"], stated, digits=5),
        difference(row["deviation"], row["is_relative"], "+"),
        difference(row["allowed"], row["is_relative"], ""),
    )


def difference(value, is_relative, sign):
    """Return a deviation with its unit, that of the row where it is not relative."""
    text = significant(100.0 * value if is_relative else value, 2)
    text = f"{sign}{text}" if value >= 0.0 else text
    return f"{text} %" if is_relative else text


def source_lines(rows):
    """Return one text per origin: the source, its licence, the tests, and a remark."""
    tests = ", ".join(
        f"`{test}`" for test in dict.fromkeys(test for row in rows for test in row["tests"])
    )
    remarks = " ".join(dict.fromkeys(row["remark"] for row in rows if row["remark"]))
    first = rows[0]
    yield f"{first['source']} ({first['licence']}): {tests}. {remarks}".rstrip()


def markdown(table):
    """Return a table's lines, columns under each other."""
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    table = [table[0], tuple("-" * width for width in widths), *table[1:]]
    return [
        f"| {' | '.join(c.ljust(w) for c, w in zip(row, widths, strict=True))} |" for row in table
    ]


if __name__ == "__main__":
    sys.exit(main())
