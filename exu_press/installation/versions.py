"""Versions of installed packages."""

from importlib.metadata import PackageNotFoundError, version

__all__ = ["version_of"]


def version_of(package: str) -> str | None:
    """Return the version of an installed package; None where it is missing."""
    try:
        return version(package)
    except PackageNotFoundError:
        return None
