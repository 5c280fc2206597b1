"""Docstrings are written to be read in an editor; here they become what Sphinx takes."""

import re
from typing import Any

COLON = "\ue000"
"""Stands for a colon while Napoleon, which would take what is before it for a type, is at work."""


def setup(app: Any) -> dict[str, Any]:
    """Add the steps before and after Napoleon's reading of Args and Parameters."""
    app.connect("autodoc-process-docstring", before_napoleon, priority=100)
    app.connect("autodoc-process-docstring", after_napoleon, priority=900)
    return {"parallel_read_safe": True}


def before_napoleon(
    app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]
) -> None:
    """Escape bars outside formulas, and leave references as they stand: [1] and its list."""
    formula = None  # indent of a formula, an example or a literal block
    for i, line in enumerate(lines):
        indent = len(line) - len(line.lstrip())
        if formula is not None and line.strip() and indent <= formula:
            formula = None
        if line.strip().startswith(".. math::") or line.rstrip().endswith("::"):
            formula = indent
        elif formula is None and not line.lstrip().startswith((">>>", "...")):
            line = re.sub(r"\.\. (\[\d+\])", r"*  \1", line)
            line = re.sub(r"(\[\d+\])_", r"\1", line)
            if what in ("data", "attribute", "property"):
                line = line.replace(":", COLON)
            lines[i] = outside_code(line)
    lines[:] = sections(lines)


def after_napoleon(
    app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]
) -> None:
    """Bring the colons back."""
    lines[:] = [line.replace(COLON, ":") for line in lines]


def outside_code(line: str) -> str:
    """Return a line with the bars escaped that are not between backticks."""
    parts = line.split("`")
    parts[::2] = [re.sub(r"(?<!\\)\|", r"\\|", part) for part in parts[::2]]
    return "`".join(parts)


def sections(lines: list[str]) -> list[str]:
    """Return NumPy's sections with descriptions where ours, "name : description", has a type.

    What is returned is described without a type: a section of plain text.
    """
    lines_out: list[str] = []
    section = ""
    for i, line in enumerate(lines):
        after = lines[i + 1] if i + 1 < len(lines) else ""
        if after and set(after) == {"-"}:
            section = line.strip()
            lines_out.append("Result" if section == "Returns" else line)
        elif section in ("Parameters", "Raises") and re.match(r"\w[\w, ]* : ", line):
            name, _, kind = line.partition(" : ")
            lines_out += [name, "    " + kind]
        else:
            lines_out.append(line)
    return lines_out
