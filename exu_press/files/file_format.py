"""Formats of files: a name and a number, which grows with what older versions cannot read."""

from importlib.metadata import version

from exu_press.errors import InputError

__all__ = ["NewerFormatError", "refuse_newer_format"]


class NewerFormatError(InputError):
    """A file is undamaged, and a later version of exu_press has written it."""


def refuse_newer_format(stored: str, known: str) -> None:
    """Refuse a file of the known name, "name number", with a greater number.

    Raises:
        NewerFormatError: the file is of a later one.
    """
    name, _, newest = known.rpartition(" ")
    stored_name, _, number = stored.rpartition(" ")
    if stored_name == name and number.isdecimal() and int(number[:9]) > int(newest):
        raise NewerFormatError(
            f"is of format {number[:9]}, written by a newer version of exu_press; this one, "
            f"{version('exu-press')}, reads formats up to {newest}: update exu_press"
        )
