"""The study: a key goes up and down, and the long run at each of its values."""

import dataclasses
from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.files.output_directory import write_json
from exu_press.parallel import Chain
from exu_press.scene import Scene
from exu_press.schema.checks import Table, key, table_from
from exu_press.studies.attractor.lyapunov import BATCHES
from exu_press.studies.base import Row, Runs, Study, Values
from exu_press.studies.bifurcation.point import run_point
from exu_press.terminal.columns import columns

__all__ = ["Bifurcation", "Branch", "Report", "bifurcation"]

WAYS = ("up and down", "up", "down", "from the start")

FILE = "bifurcation.json"


@dataclasses.dataclass(frozen=True)
class LongRun(Table):
    """The table [bifurcation]: how long each run is, and where it begins."""

    table = "bifurcation"

    skip: int = key(30, "revolutions of the transient at each value", at_least=1)
    revolutions: int = key(48, "revolutions in the section", at_least=2 * BATCHES)
    longest: int = key(8, "period up to which is looked for, revolutions", at_least=1)
    way: str = key("up and down", "which way the key goes", choices=WAYS)


@dataclasses.dataclass(frozen=True)
class Bifurcation(Study):
    """A study file with one key, and its table [bifurcation].

    Attributes:
        bifurcation: of `LongRun`, or its mapping.

    Raises:
        InputError: there is another number of keys than one, its values are no numbers that
            increase, or the runs are too short for the period asked.
    """

    bifurcation: LongRun | Mapping[str, Any] = dataclasses.field(default_factory=LongRun)

    def __post_init__(self) -> None:
        """Check the key and the lengths."""
        super().__post_init__()
        if not isinstance(self.bifurcation, LongRun):
            if not isinstance(self.bifurcation, Mapping):
                raise InputError(f"bifurcation = {self.bifurcation!r:.200}: allowed is a table")
            own = table_from(LongRun, "bifurcation", self.bifurcation)
            object.__setattr__(self, "bifurcation", own)
        if len(self.keys) != 1:
            raise InputError(
                f"[keys]: {', '.join(self.keys)}; allowed in a file for exu-press bifurcation is "
                "one key"
            )
        values = self.values
        if not all(a < b for a, b in pairwise(values)):
            raise InputError(f"keys.{self.name}: allowed are numbers that increase")
        if self.own.revolutions < 3 * self.own.longest:
            raise InputError(
                f"bifurcation.revolutions = {self.own.revolutions}: allowed are at least "
                f"{3 * self.own.longest}, for periods up to {self.own.longest}"
            )
        if self.errors or self.save_runs:
            raise InputError("errors, save_runs: not used by exu-press bifurcation; remove them")

    @property
    def own(self) -> LongRun:
        """The table [bifurcation]."""
        assert isinstance(self.bifurcation, LongRun)
        return self.bifurcation

    @property
    def name(self) -> str:
        """The key's dotted name."""
        return next(iter(self.keys))

    @property
    def values(self) -> tuple[float, ...]:
        """The key's values."""
        found = self.keys[self.name]
        numbers = found.values if isinstance(found, Values) else ()
        if not numbers or any(isinstance(v, bool) or not isinstance(v, (int, float))
                              for v in numbers):  # fmt: skip
            raise InputError(f"keys.{self.name} = {found.plain()!r:.200}: allowed is [number, ...]")
        return tuple(float(value) for value in numbers)


@dataclasses.dataclass(frozen=True)
class Branch:
    """The rows of one way through the key's values.

    Attributes:
        name: "up", "down" or "from the start".
        values: in their order.
        rows: of `run_point`; one that failed has status and reason alone.
    """

    name: str
    values: Sequence[float]
    rows: Sequence[Row]


@dataclasses.dataclass(frozen=True)
class Report:
    """The result.

    Attributes:
        study: what was asked.
        branches: one or two.
    """

    study: Bifurcation
    branches: Sequence[Branch]

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of bifurcation.json, without states."""
        return {
            "key": self.study.name,
            "branches": {
                one.name: [
                    {"value": value, **{n: v for n, v in row.items() if n != "state"}}
                    for value, row in zip(one.values, one.rows, strict=True)
                ]
                for one in self.branches
            },
        }

    def lines(self) -> list[str]:
        """Return what stands on the terminal."""
        rows = [(self.study.name, "way", "period", "exponent per revolution", "motion")]
        for branch in self.branches:
            for value, row in zip(branch.values, branch.rows, strict=True):
                if row["status"] != "completed":
                    rows.append((f"{value:g}", branch.name, row["status"], row["reason"][:60], ""))
                    continue
                _, low, high = row["exponent"]
                told = f"below {high:.3g}" if low is None else f"{low:.3g} to {high:.3g}"
                rows.append((f"{value:g}", branch.name, row["in_words"], told, row["motion"]))
        return columns(rows)


def bifurcation(
    study: Bifurcation,
    directory: str | Path,
    *,
    workers: int | None = None,
    dask: str | None = None,
    quiet: bool = True,
) -> Report:
    """Run the study, going on where its directory was left, and write bifurcation.json.

    On the ways up and down each run starts in the state in which the run at the last value ended,
    so that hysteresis is seen; both ways run beside each other. After a value whose run failed, the
    next one starts as the scene does.

    Args:
        study: what is asked.
        directory: of this study alone.
        workers: number of processes; all cores unless told.
        dask: address of a Dask scheduler instead.
        quiet: False shows the progress.
    """
    values = study.values
    with Runs(
        study, directory, written=[FILE], label="bifurcation", function=run_point,
        workers=workers, dask=dask, quiet=quiet,
    ) as runs:  # fmt: skip
        if study.own.way == "from the start":
            rows = runs.rows([_arguments(study, value, None) for value in values])
            branches = [Branch("from the start", values, rows)]
        else:
            ways = {"up": values, "down": values[::-1]}
            names = [name for name in ways if name in study.own.way]
            found: dict[str, list[Row]] = {name: [] for name in names}
            chains = [_way(study, ways[name], found[name]) for name in names]
            runs.follow(chains, len(names) * len(values))
            branches = [Branch(name, ways[name], found[name]) for name in names]
    report = Report(study, branches)
    write_json(Path(directory) / FILE, report.to_dict())
    return report


def _way(study: Bifurcation, values: Sequence[float], rows: list[Row]) -> Chain:
    """Yield the arguments of runs one after another, and add their rows to `rows`."""
    last = None
    for value in values:
        row = yield _arguments(study, value, last)
        rows.append(row)
        last = value, row


def _arguments(study: Bifurcation, value: float, last: tuple[float, Row] | None) -> dict[str, Any]:
    """Return the arguments of `run_point`, from the row at the value before."""
    scene: Scene = study.scene_at({study.name: value})
    own = study.own
    found: dict[str, Any] = {
        "scene": scene.to_dict(),
        "skip": own.skip,
        "revolutions": own.revolutions,
        "longest": own.longest,
        "start": None,
    }
    if last is not None and "state" in last[1]:
        found["start"] = last[1]["state"]
        found["speed"] = study.scene_at({study.name: last[0]}).speed_rpm
    return found
