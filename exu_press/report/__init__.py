"""Reports: one self-contained HTML page for a run, a comparison or a sweep."""

from exu_press.report.find import Kind, find_output, report_of

__all__ = ["Kind", "find_output", "report_of"]
