"""Notebook cells of a scene, a mechanism, a result or a comparison."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from exu_press.mechanism import Mechanism
from exu_press.mechanism.examine import examine
from exu_press.plots.drawing import drawing_figure
from exu_press.plots.file import save_figure
from exu_press.plots.words import ONE_LINE, describe
from exu_press.quantities.table import comparison_cells, comparison_lines
from exu_press.report.comparison import comparison_page
from exu_press.report.html import paragraph, picture, table, warnings
from exu_press.report.page_file import Page
from exu_press.report.run import changed_keys, run_report, warnings_of
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.studies.compare import different_keys
from fe_models.temporary import TemporaryFolder

__all__ = ["Comparison", "cell", "page_of"]

SMALL = "font-size: 0.9em"


@dataclass(frozen=True)
class Comparison:
    """Runs beside each other.

    Attributes:
        results: by label.
    """

    results: Mapping[str, Result]

    def view(self) -> Page:
        """Return the page with their curves over each other; a notebook shows it."""
        return Page(comparison_page(self.results, "comparison"))

    def __str__(self) -> str:
        return "\n".join(comparison_lines(self.results))

    def _repr_html_(self) -> str:
        """Return the differences of the scenes, and the quantities."""
        head, *changed = different_keys({n: run.scene for n, run in self.results.items()})
        names, *rows = comparison_cells(self.results)
        return _frame(table(head, changed) + table(names, rows))


def page_of(result: Result) -> Page:
    """Return the page of a run."""
    return Page(run_report(result, "this run"))


def cell(item: Any) -> str:
    """Return the HTML of a scene, a mechanism or a result."""
    if isinstance(item, Scene):
        return _frame(paragraph(describe([item], ONE_LINE)) + changed_keys(item))
    if isinstance(item, Mechanism):
        return _drawing(item)
    assert isinstance(item, Result)
    texts = warnings_of(item.summary())
    head = paragraph(describe([item.scene], ONE_LINE)) + (warnings(texts) if texts else "")
    numbers = comparison_cells({"": item})[1:]
    return _frame(head + table(("quantity", "value"), numbers))


def _drawing(mechanism: Mechanism) -> str:
    with TemporaryFolder() as folder:
        drawn = drawing_figure(examine(mechanism), mechanism.name)
        path = save_figure(drawn, folder / "mechanism.png")
        return picture(path, mechanism.name)


def _frame(inner: str) -> str:
    return f'<div style="{SMALL}">{inner}</div>'
