"""Search for a damaged entity in the text of a STEP file, for an error message.

ISO 10303-21: statements `#12 = TYPE(...);`, texts between quotes, comments as in C.
"""

import re
from functools import cache
from importlib.metadata import PackageNotFoundError, files
from pathlib import Path

__all__ = ["faulty_entity"]

MOST = 100_000_000
"""Largest size of a file that is searched, bytes."""

TEXTS = re.compile(r"'(?:[^']|'')*'")
COMMENTS = re.compile(r"/\*.*?\*/", re.DOTALL)
ENTITY = re.compile(r"\s*#(\d+)\s*=\s*(.*)", re.DOTALL)
TYPE = re.compile(r"([A-Z][A-Z_0-9]*)\s*\(")
REFERENCE = re.compile(r"#(\d+)")
STRANGE = re.compile(r"[(,]\s*[-+]?(?:[0-9.]*#[A-Z]+|NAN|INF|\d[\d.]*E[+-]?\d{4,})", re.IGNORECASE)
"""Beginning of an invalid number."""


def faulty_entity(path: Path) -> str:
    """Return the damaged entity of a STEP file, to follow a message; nothing if none is found.

    A type is known if the library that reads it has its name.
    """
    try:
        if path.stat().st_size > MOST:
            return ""
        text = path.read_bytes().decode("latin-1")
    except OSError:
        return ""
    entities = {}
    statements = COMMENTS.sub("", TEXTS.sub("''", text)).split(";")
    for statement in statements:
        if (match := ENTITY.fullmatch(statement)) is None:
            continue
        number, body = match.groups()
        if number in entities:
            return _describe_fault(number, body, "is there twice")
        entities[number] = body
    for number, body in entities.items():
        if body.count("(") != body.count(")") or not body.rstrip().endswith(")"):
            return _describe_fault(number, body, "is cut off")
        if STRANGE.search(body):
            return _describe_fault(number, body, "has a number that is none")
        for reference in REFERENCE.findall(body):
            if reference not in entities:
                text = f"refers to #{reference}, which is not there"
                return _describe_fault(number, body, text)
        for kind in TYPE.findall(body):
            if not _is_known(kind):
                return _describe_fault(
                    number, body, f"is of a type, {kind[:60]}, that no reader knows"
                )
    return ""


def _describe_fault(number: str, body: str, what: str) -> str:
    start = " ".join(body.split())[:60]
    return f": #{number} = {start}{'...' if len(start) == 60 else ''} {what}"


@cache
def _is_known(kind: str) -> bool:
    """Return whether the library has the name of a type; True where there is no library."""
    return not _library() or kind.encode() in _library()


@cache
def _library() -> bytes:
    """Return the library that reads STEP files, or nothing."""
    try:
        named = [file for file in files("netgen-occt") or () if "TKDESTEP" in file.name]
        return Path(str(named[0].locate())).read_bytes() if named else b""
    except (PackageNotFoundError, OSError):
        return b""
