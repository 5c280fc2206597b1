"""Texts as pictures and pages have them; terminals, CSV and NetCDF keep units in ASCII."""

import re
import textwrap
from collections.abc import Sequence

__all__ = ["list_first", "plain", "shorten", "typeset", "wrap_name", "wrap_text"]

LETTERS = 44
"""In a line beside a panel."""

POWERS = str.maketrans("23", "\N{SUPERSCRIPT TWO}\N{SUPERSCRIPT THREE}")
POWER = re.compile(r"(?<=\w)\^([23])(?!\w)")
MICRO_UNIT = re.compile(r"(?<![\w./])u(?=(?:m|rad)(?![\w/]|\.\w))")


def shorten(words: str, letters: int) -> str:
    """Return words that have at most so many letters, an ellipsis in place of the rest.

    >>> shorten("pivot of the upper link", 10), shorten("pivot", 10)
    ('pivot of…', 'pivot')
    """
    return words if len(words) <= letters else words[: letters - 1].rstrip(" ,") + "…"


def list_first(names: Sequence[str], letters: int) -> str:
    """Return the first names that have at most so many letters, and how many more there are.

    >>> list_first(["counter pin", "knuckle 6, each side", "pivot"], 33)
    'counter pin; knuckle 6, each side; and 1 more'
    >>> list_first(["counter pin", "pivot"], 33)
    'counter pin; pivot'
    """
    count = len(names)
    while count > 1 and len("; ".join(names[:count])) > letters:
        count -= 1
    rest = [f"and {len(names) - count} more"] if count < len(names) else []
    return "; ".join([*names[:count], *rest])


def plain(text: str) -> str:
    """Return a text as matplotlib draws it: as it stands, nothing in it a formula."""
    return text.replace("$", r"\$")


def wrap_text(text: str, letters: int = LETTERS) -> str:
    """Return a text in lines of a panel's width, as matplotlib draws it.

    >>> wrap_text("largest acceleration of the slider, averaged over 1 ms, m/s^2")
    'largest acceleration of the slider, averaged\\nover 1 ms, m/s²'
    """
    return plain("\n".join(textwrap.wrap(typeset(text), letters)))


def wrap_name(name: str, letters: int, behind: str) -> str:
    """Return a name likewise, in lines that end behind a sign of it.

    >>> wrap_name("joints.crank_pin.clearance", 20, ".")
    'joints.crank_pin.\\nclearance'
    """
    return wrap_text(name.replace(behind, f"{behind} "), letters).replace(f"{behind} ", behind)


def typeset(text: str) -> str:
    """Return a text with the signs that units are printed with; names and paths stay.

    >>> typeset("peak acceleration, m/s^2"), typeset("0.31 um"), typeset("2 +- 0.1 urad")
    ('peak acceleration, m/s²', '0.31 µm', '2 ± 0.1 µrad')
    >>> typeset("joints.um.radius in out/um/run.nc")
    'joints.um.radius in out/um/run.nc'
    """
    text = POWER.sub(lambda match: match[1].translate(POWERS), text)
    return MICRO_UNIT.sub("\N{MICRO SIGN}", text).replace(" +- ", " \N{PLUS-MINUS SIGN} ")
