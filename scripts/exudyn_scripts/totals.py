"""Lines and totals of the rows of `exudyn_examples.py`."""

from collections import Counter

import numpy as np

__all__ = ["OVER", "line", "totals"]

OVER = "over the limit"

LONG = 0.5
"""Processor time of a single run from which on elapsed times are compared, s."""

NOTHING = 1e-9
"""Relative error below which rounding decides."""


def ratio(row):
    """Return the processor time over that of the smallest sufficient number of steps."""
    return row["seconds"] / row["single"]


def elapsed(row):
    """Return the same of elapsed times on two cores that nobody else uses.

    Of levels that run beside each other the longest counts; what is beyond all levels' time is
    taken as elapsed.
    """
    hidden = sum(sum(seconds) - max(seconds) for seconds in row["beside"])
    return (row["seconds"] - hidden) / row["single"]


def line(row, tolerance):
    """Return a line of a script."""
    text = f"{row['name'][:44]:44s} {row['status']:14s}"
    for name, label in (("own", "own"), ("missed", "error"), ("stated", "stated")):
        if name in row:
            text += f" {label} {row[name] / tolerance:8.2g}"
    if "single" in row and row["status"] == "completed":
        text += f" steps {row['steps']} of {row['sufficient']} cost {ratio(row):5.2g}"
    return f"{text} {row.get('reference', '')} {row.get('reason', '')[:200]}".rstrip()


def totals(rows, tolerance):
    """Return lines of totals."""
    apart = {"no dynamic solution", "crashed", "refused", "failed", OVER}
    counts = Counter(row["status"] for row in rows)
    lines = [f"{len(rows)} scripts: " + ", ".join(f"{n} {name}" for name, n in counts.items())]
    ran = [row for row in rows if row["status"] not in apart]
    known = [row for row in ran if row.get("own", np.inf) <= tolerance / 3.0]
    lines.append(
        f"{len(ran)} refined within the limits; the truth is known of {len(known)}, whose levels "
        "at 8 and 16 times the steps agree to a third of the tolerance"
    )
    if not known:
        return lines
    completed = [row for row in known if row["status"] == "completed"]
    right = [row for row in completed if row["missed"] <= tolerance]
    lines.append(f"completed {share(completed, known)}; within one tolerance {share(right, known)}")
    silent = [
        row
        for row in ran
        if row["status"] == "completed"
        and row.get("missed", 0.0)
        > 3.0 * max(tolerance, row.get("stated", 0.0), row.get("own", 0.0))
    ]
    names = ", ".join(row["name"] for row in silent)
    lines.append(f"wrong in silence {share(silent, ran)} {names}")
    for name in ("pairs", "peaks"):
        pairs = [np.array(row[name]) for row in completed if row.get(name)]
        if pairs:
            true, stated, own = np.concatenate(pairs).T
            counted = true > np.maximum(3.0 * own, NOTHING)
            covered = np.sum(true[counted] <= stated[counted])
            lines.append(
                f"stated errors of {'quantities' if name == 'pairs' else 'peaks'} true: "
                f"{covered} of {counted.sum()}"
            )
    far = [row for row in completed if row["missed"] > NOTHING]
    whole = [row["missed"] <= row["stated"] + row["own"] for row in far]
    lines.append(f"largest stated error of a script true: {sum(whole)} of {len(whole)}")
    measured = [row for row in right if "single" in row]
    long = [row for row in measured if row["single"] >= LONG]
    for label, chosen, measure in (
        ("processor time over the smallest sufficient run's", measured, ratio),
        (f"the same where that takes {LONG:g} s or more", long, ratio),
        (f"elapsed on two free cores where that takes {LONG:g} s or more", long, elapsed),
    ):
        if chosen:
            median, most = np.percentile([measure(row) for row in chosen], [50, 95])
            lines.append(f"{label} ({len(chosen)}): median {median:.2g}, 95 % {most:.2g}")
    return lines


def share(some, of):
    """Return how many of how many these are."""
    return f"{len(some)} of {len(of)} ({100.0 * len(some) / max(len(of), 1):.1f} %)"
