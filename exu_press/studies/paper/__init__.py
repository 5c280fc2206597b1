"""The paper's section 5, number by number, and what moves each number."""

from exu_press.studies.paper.report import Report
from exu_press.studies.paper.study import paper

__all__ = ["Report", "paper"]
