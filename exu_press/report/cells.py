"""Notebook cells of a scene, a mechanism, a result or a comparison."""

from typing import Any

from exu_press.mechanism import Mechanism
from exu_press.mechanism.examine import examine
from exu_press.plots.drawing import drawing_figure
from exu_press.plots.file import save_figure
from exu_press.plots.words import ONE_LINE, describe
from exu_press.quantities.table import quantity_cells, with_headings
from exu_press.report.comparison import comparison_page, comparison_tables
from exu_press.report.html import paragraph, picture, table, warnings
from exu_press.report.page_file import Page
from exu_press.report.run import changed_keys, warnings_of
from exu_press.report.run_report import run_report
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.studies.comparison import Comparison
from fe_models.temporary import TemporaryFolder

__all__ = ["cell", "page_of"]

SMALL = "font-size: 0.9em"


def page_of(item: Result | Comparison) -> Page:
    """Return the page of a run or a comparison."""
    if isinstance(item, Comparison):
        return Page(comparison_page(item.results, "comparison"))
    return Page(run_report(item, "this run"))


def cell(item: Any) -> str:
    """Return the HTML of a scene, a mechanism, a result or a comparison."""
    if isinstance(item, Scene):
        return _frame(paragraph(describe([item], ONE_LINE)) + changed_keys(item))
    if isinstance(item, Mechanism):
        return _drawing(item)
    if isinstance(item, Comparison):
        return _frame("".join(comparison_tables(item)))
    assert isinstance(item, Result)
    texts = warnings_of(item.summary())
    head = paragraph(describe([item.scene], ONE_LINE)) + (warnings(texts) if texts else "")
    numbers = with_headings(quantity_cells({"": item}))
    return _frame(head + table(("quantity", "value"), numbers))


def _drawing(mechanism: Mechanism) -> str:
    with TemporaryFolder() as folder:
        drawn = drawing_figure(examine(mechanism), mechanism.name)
        path = save_figure(drawn, folder / "mechanism.png")
        return picture(path, mechanism.name)


def _frame(inner: str) -> str:
    return f'<div style="{SMALL}">{inner}</div>'
