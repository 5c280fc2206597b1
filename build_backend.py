"""The build backend of setuptools, which asks for mypy only where the package will be compiled."""

import os
import shutil
import sys
import sysconfig
from collections.abc import Mapping
from typing import Any

from setuptools import build_meta
from setuptools.build_meta import *  # noqa: F403  all other hooks

MYPY = "mypy>=1.15,<3"


def is_compiled(editable: bool) -> bool:
    """Return whether an install is compiled: as EXU_PRESS_COMPILE says, else where it can be.

    An editable one stays in Python, whose sources could be edited beside what was compiled.
    """
    asked = os.environ.get("EXU_PRESS_COMPILE", "")
    if asked not in ("", "0", "1"):
        sys.exit(f"EXU_PRESS_COMPILE = {asked!r}: allowed are 0 and 1")
    compiler = (sysconfig.get_config_var("CC") or "cc").split()[0]
    return asked == "1" or (not asked and not editable and shutil.which(compiler) is not None)


def get_requires_for_build_wheel(config_settings: Mapping[str, Any] | None = None) -> list[str]:
    """Return what building a wheel needs."""
    needed = build_meta.get_requires_for_build_wheel(config_settings)
    return [*needed, *[MYPY] * is_compiled(editable=False)]


def get_requires_for_build_editable(config_settings: Mapping[str, Any] | None = None) -> list[str]:
    """Return what an editable install needs."""
    needed = build_meta.get_requires_for_build_editable(config_settings)
    return [*needed, *[MYPY] * is_compiled(editable=True)]
