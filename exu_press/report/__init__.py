"""Reports: one self-contained HTML page for a run, a comparison or a study."""

from exu_press.report.find import Kind, find_output, report_of
from exu_press.report.page_file import Page

__all__ = ["Kind", "Page", "find_output", "report_of"]
