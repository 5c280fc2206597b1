"""Numbers of others, in files beside their tests; a file's first lines say whose they are."""

from pathlib import Path

import numpy as np


def columns_of(name):
    """Return the columns of a CSV file by name; those of words as arrays of text."""
    lines = (Path(__file__).parent / name).read_text("utf-8").splitlines()
    head, *rows = [line.split(",") for line in lines if not line.startswith("#")]
    columns = zip(*rows, strict=True)
    return {key: numbers(column) for key, column in zip(head, columns, strict=True)}


def numbers(column):
    try:
        return np.array(column, float)
    except ValueError:
        return np.array(column)
