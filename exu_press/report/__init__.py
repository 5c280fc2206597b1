"""Reports: one self-contained HTML page for a run, a comparison or a sweep."""

from exu_press.report.find import Kind, find_output, report_of
from exu_press.report.shown import Page

__all__ = ["Kind", "Page", "find_output", "report_of"]
