"""The report of a study: tables, pictures and points, the same in a terminal, a file and a page."""

import shlex
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, ClassVar

from exu_press.files.digests import files_read
from exu_press.files.output_directory import REPORT_FILE, plain_data, write_json
from exu_press.plots.words import ONE_LINE, describe
from exu_press.quantities.units import shown_unit
from exu_press.scene import Scene
from exu_press.scene.provenance import Provenance, provenance_of
from exu_press.scene.warnings import scene_warnings
from exu_press.schema.csv_table import Value, write_csv
from exu_press.terminal.columns import columns
from fe_models.lazy import named_object

__all__ = [
    "FORMAT",
    "Column",
    "Line",
    "Panel",
    "Picture",
    "Points",
    "Report",
    "Table",
    "command_text",
    "quantity_column",
    "scale_numbers",
]

FORMAT = "exu_press study 1"
"""Of what a study writes: study.json, runs.jsonl and report.json."""


@dataclass(frozen=True)
class Table:
    """Texts in columns, with lines above and below them.

    Attributes:
        head: names of the columns with their units; empty where there are lines alone.
        indent: of the columns in a terminal.
        right: whether a terminal aligns the columns but for the first one to the right.
        excerpt: indices of the rows that a terminal shows; None for all.
        of_points: whether row k is the run of point k.
        on_terminal: whether a terminal shows it.
    """

    title: str
    head: Sequence[str] = ()
    rows: Sequence[Sequence[str]] = ()
    above: Sequence[str] = ()
    below: Sequence[str] = ()
    indent: int = 0
    right: bool = False
    excerpt: Sequence[int] | None = None
    of_points: bool = False
    on_terminal: bool = True

    def lines(self) -> list[str]:
        """Return the table as a terminal shows it."""
        rows = self.rows if self.excerpt is None else [self.rows[k] for k in self.excerpt]
        body = columns([self.head, *rows], self.indent, right=self.right) if self.head else []
        return [*self.above, *body, *self.below]


@dataclass(frozen=True)
class Picture:
    """A picture of a report.

    Attributes:
        name: of its file, without the ending.
        function: "module:function", from the report, and `arguments`, to a matplotlib figure, or
            None where there is nothing to draw; imported when it draws.
        arguments: of the function, after the report.
    """

    name: str
    caption: str
    function: str
    arguments: tuple[Any, ...] = ()

    def draw(self, report: "Report") -> Any:
        """Return the figure."""
        return named_object(self.function)(report, *self.arguments)


@dataclass(frozen=True)
class Column:
    """Values of a key or a quantity at the points of a report.

    Attributes:
        name: of the key or quantity.
        unit: of the values; "" where they have none.
        values: a number, a text, or None of a point that has none.
        low, high: bounds of the values, where errors are known.
    """

    name: str
    unit: str
    values: Sequence[Any]
    low: Sequence[float | None] | None = None
    high: Sequence[float | None] | None = None


@dataclass(frozen=True)
class Points:
    """Runs of a study as points, which a page shows over any two columns.

    Attributes:
        keys: columns of what varied.
        labels: text that opens with a point, as the command that runs it again.
        across, up: columns of the picture at first; "" for the first key and the first quantity.
        colour: column that the colours show at first; "" for the first key that is not across.
    """

    keys: Sequence[Column]
    quantities: Sequence[Column]
    labels: Sequence[str]
    across: str = ""
    up: str = ""
    colour: str = ""
    title: str = "Points"


@dataclass(frozen=True)
class Line:
    """A curve of a panel.

    Attributes:
        points: whether it is drawn as points.
        low, high: bounds of the values, where errors are known.
    """

    label: str
    x: Sequence[float]
    y: Sequence[float]
    points: bool = False
    low: Sequence[float] | None = None
    high: Sequence[float] | None = None


@dataclass(frozen=True)
class Panel:
    """Curves over one axis, which a page shows.

    Attributes:
        across: label of the x axis, with its unit.
    """

    title: str
    across: str
    up: str
    lines: Sequence[Line]


class Report(ABC):
    """The result of a study.

    A terminal prints its tables and lists its files; `save` writes it; `exu-press report` makes a
    page of what was written, which needs no code of the study.
    """

    name: ClassVar[str]
    """Of the study's command."""

    files: ClassVar[tuple[str, ...]] = ()
    """Names of what `save` writes and a user reads."""

    heading: ClassVar[str] = ""
    """What stands before the scenes in the title."""

    scene_file: ClassVar[str] = ""
    """Name of the file of the scene that the study led to."""

    drawn: ClassVar[tuple[tuple[str, str], ...]] = ()
    """Name and caption of each picture; NAME_figure in the module `figure` beside the report's
    draws it."""

    study: Any

    @property
    def title(self) -> str:
        """Heading of the page."""
        return f"{self.heading}: {describe(self.scenes, ONE_LINE)}"

    @property
    def scene(self) -> Scene | None:
        """The scene of the study, or the one that it led to; None where it has none."""
        scene: Scene = self.study.scene
        return scene

    @abstractmethod
    def tables(self) -> list[Table]:
        """Return the tables."""

    @property
    def subtitle(self) -> str:
        """Line below the heading of the page."""
        return ""

    @property
    def scenes(self) -> Sequence[Scene]:
        """Scenes whose warnings are shown."""
        return [] if self.scene is None else [self.scene]

    @property
    def failures(self) -> list[str]:
        """Reasons why the study did not come to its end; its command then returns `exit_status`."""
        return []

    @property
    def exit_status(self) -> int:
        """Exit status of the command."""
        return 3 if self.failures else 0

    def pictures(self) -> list[Picture]:
        """Return the pictures."""
        module = f"{type(self).__module__.rpartition('.')[0]}.figure"
        return [Picture(name, text, f"{module}:{name}_figure") for name, text in self.drawn]

    def points(self) -> Points | None:
        """Return the runs as points; None where the page has none."""
        return None

    def panels(self) -> list[Panel]:
        """Return curves of the page."""
        return []

    def to_dict(self) -> dict[str, Any]:
        """Return the contents of NAME.json, where NaN is null; empty where there is no file."""
        return {}

    def csv_files(self) -> dict[str, Mapping[str, Sequence[Value]]]:
        """Return columns, SI, by the name of the CSV file that has them."""
        return {}

    def lines(self) -> list[str]:
        """Return the tables as a terminal shows them, an empty line between two of them."""
        tables = [table for table in self.tables() if table.on_terminal]
        return [line for table in tables for line in ("", *table.lines())][1:]

    def warnings(self) -> list[str]:
        """Return the warnings of its scenes, each once."""
        return list(dict.fromkeys(text for scene in self.scenes for text in scene_warnings(scene)))

    def save(self, directory: Path) -> None:
        """Write NAME.json, CSV files, the scene, and the file of which a page is made."""
        if data := self.to_dict():
            write_json(directory / f"{self.name}.json", plain_data(data))
        for name, values in self.csv_files().items():
            write_csv(directory / name, values)
        if self.scene_file and self.scene is not None:
            self.scene.save(directory / self.scene_file, overwrite=True)
        write_json(directory / REPORT_FILE, {"format": FORMAT, **self.page_data()})

    def provenance(self) -> Provenance:
        """Return where it comes from: also of all files that the command read."""
        of_scene = provenance_of(self.scene)
        return {**of_scene, "files": {**files_read(), **of_scene["files"]}}

    def page_data(self) -> dict[str, Any]:
        """Return that of which a page is made."""
        points = self.points()
        return {
            "title": self.title,
            "subtitle": self.subtitle,
            "scene": None if self.scene is None else self.scene.to_dict(),
            "warnings": [*self.failures, *self.warnings()],
            "tables": [asdict(table) for table in self.tables()],
            "pictures": {picture.name: picture.caption for picture in self.pictures()},
            "points": None if points is None else asdict(points),
            "panels": [asdict(panel) for panel in self.panels()],
            "provenance": self.provenance(),
        }


def quantity_column(
    name: str,
    values: Sequence[Any],
    low: Sequence[float | None] | None = None,
    high: Sequence[float | None] | None = None,
    *,
    default_unit: str | None = None,
) -> Column:
    """Return a key or a quantity as a column, in the unit of `shown_unit`.

    Args:
        values: SI.
        low, high: bounds of the values, SI.
        default_unit: unit of a name that is neither key nor quantity.
    """
    unit, scale = shown_unit(name, [v for v in values if isinstance(v, float)], default_unit)
    bounds = (None if b is None else scale_numbers(b, scale) for b in (low, high))
    return Column(name, unit, scale_numbers(values, scale), *bounds)


def scale_numbers(values: Sequence[Any], scale: float) -> list[Any]:
    """Return values with a factor at the numbers among them."""
    return [scale * value if isinstance(value, float) else value for value in values]


def command_text(changes: Mapping[str, Any]) -> str:
    """Return the command that runs a study's scene with keys changed; None leaves one as it is.

    >>> command_text({"speed_rpm": 300.0, "film.law": None})
    'exu-press run SCENE.toml --set speed_rpm=300.0'
    """
    texts = (f"{name}={value}" for name, value in changes.items() if value is not None)
    return " ".join(["exu-press run SCENE.toml", *(f"--set {shlex.quote(text)}" for text in texts)])
