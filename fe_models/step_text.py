"""What the text of a STEP file says of its damage: an entity for an error message, no judgement.

ISO 10303-21: statements `#12 = TYPE(...);`, texts between quotes, comments as in C.
"""

import re
from functools import cache
from importlib.metadata import PackageNotFoundError, files
from pathlib import Path

__all__ = ["faulty_entity"]

MOST = 100_000_000
"""Bytes of a file that is looked at."""

TEXTS = re.compile(r"'(?:[^']|'')*'")
COMMENTS = re.compile(r"/\*.*?\*/", re.DOTALL)
ENTITY = re.compile(r"\s*#(\d+)\s*=\s*(.*)", re.DOTALL)
TYPE = re.compile(r"([A-Z][A-Z_0-9]*)\s*\(")
REFERENCE = re.compile(r"#(\d+)")
STRANGE = re.compile(r"[(,]\s*[-+]?(?:[0-9.]*#[A-Z]+|NAN|INF|\d[\d.]*E[+-]?\d{4,})", re.IGNORECASE)
"""Beginning of a number that is none."""


def faulty_entity(path: Path) -> str:
    """Return which entity of a STEP file is damaged, to follow a message; nothing if all seem fine.

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
            return _told(number, body, "is there twice")
        entities[number] = body
    for number, body in entities.items():
        if body.count("(") != body.count(")") or not body.rstrip().endswith(")"):
            return _told(number, body, "is cut off")
        if STRANGE.search(body):
            return _told(number, body, "has a number that is none")
        for other in REFERENCE.findall(body):
            if other not in entities:
                return _told(number, body, f"refers to #{other}, which is not there")
        for kind in TYPE.findall(body):
            if not _is_known(kind):
                return _told(number, body, f"is of a type, {kind[:60]}, that no reader knows")
    return ""


def _told(number: str, body: str, what: str) -> str:
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
