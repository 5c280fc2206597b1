"""The result of a bifurcation study, as a file and as a dataset."""

import dataclasses
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from exu_press.errors import required_package
from exu_press.studies.base import Row
from exu_press.studies.bifurcation.study import Bifurcation
from exu_press.studies.sweep.units import meaning_of, unit_of

__all__ = ["Branch", "Report"]


@dataclasses.dataclass(frozen=True)
class Branch:
    """The rows of one way through the first key's values.

    Attributes:
        name: "up", "down" or "from the start".
        values: in their order.
        rows: of `run_point`; one that failed has status and reason alone.
        second: value of the second key, or None.
    """

    name: str
    values: Sequence[float]
    rows: Sequence[Row]
    second: float | None = None

    def __iter__(self) -> Iterator[tuple[float, Row]]:
        return zip(self.values, self.rows, strict=True)


@dataclasses.dataclass(frozen=True)
class Report:
    """The result.

    Attributes:
        study: whose report this is.
        branches: one or two, for each value of the second key.
    """

    study: Bifurcation
    branches: Sequence[Branch]

    @property
    def ways(self) -> list[str]:
        """The names of the branches, each once."""
        return list(dict.fromkeys(branch.name for branch in self.branches))

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of bifurcation.json, without states."""
        found: dict[str, list[dict[str, Any]]] = {way: [] for way in self.ways}
        for branch in self.branches:
            other = {} if branch.second is None else {"second": branch.second}
            for value, row in branch:
                kept = {name: entry for name, entry in row.items() if name != "state"}
                found[branch.name].append({"value": value, **other, **kept})
        key = {"key": self.study.name}
        other_key = {} if self.study.second is None else {"second_key": self.study.second}
        return {**key, **other_key, "branches": found}

    def to_xarray(self) -> Any:
        """Return every point as an `xarray.Dataset` over way, keys, revolution and coordinate.

        A point that failed is NaN. A period is 0 where there is none, and NaN where it is not told.
        An exponent is per revolution; its lower end is NaN where only an upper bound is known.

        Raises:
            InputError: xarray is not installed.
        """
        xarray = required_package("xarray", "to_xarray", "xarray")
        study = self.study
        done = [row for branch in self.branches for row in branch.rows if "points" in row]
        section = np.shape(done[0]["points"]) if done else (study.bifurcation.revolutions, 0)
        keys = {study.name: list(study.values)}
        if study.second is not None:
            keys[study.second] = [second for second in study.seconds if second is not None]
        places: dict[str, Sequence[object]] = {"way": self.ways, **keys}
        size = tuple(map(len, places.values()))
        found = {name: np.full(size, np.nan) for name in ("period", "error")}
        found |= {f"exponent{end}": np.full(size, np.nan) for end in ("", "_low", "_high")}
        points = np.full((*size, *section), np.nan)
        for branch in self.branches:
            for value, row in branch:
                if "points" not in row:
                    continue
                at = [self.ways.index(branch.name), study.values.index(value)]
                at += [] if branch.second is None else [study.seconds.index(branch.second)]
                here = tuple(at)
                points[here] = row["points"]
                ends = [np.nan if end is None else end for end in row["exponent"]]
                told = (row["period"] or 0) if row["told"] else np.nan
                for name, entry in zip(found, (told, row["error"], *ends), strict=True):
                    found[name][here] = entry
        variables = {name: (tuple(places), values) for name, values in found.items()}
        words = {n: {"units": unit_of(n), "long_name": meaning_of(n)} for n in keys}
        return xarray.Dataset(
            {"points": ((*places, "revolution", "coordinate"), points), **variables},
            coords={
                "way": self.ways,
                **{name: (name, values, words[name]) for name, values in keys.items()},
                "revolution": study.bifurcation.skip + 1 + np.arange(section[0]),
            },
        )
