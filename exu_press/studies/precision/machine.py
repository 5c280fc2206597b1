"""The machine on which the times were taken."""

import os
import platform
from pathlib import Path
from typing import Any

from exu_press.installation.versions import version_of

__all__ = ["machine"]

PACKAGES = ("exu-press", "exudyn", "numpy", "scipy", "numba", "scikit-sundae", "numbalsoda")


def machine() -> dict[str, Any]:
    """Return processor, system, its load, and versions; null for missing packages."""
    return {
        "processor": _processor(),
        "cores": os.cpu_count(),
        "load": list(os.getloadavg()) if hasattr(os, "getloadavg") else None,
        "system": platform.platform(),
        "versions": {
            "python": platform.python_version(),
            **{name: version_of(name) for name in PACKAGES},
        },
    }


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()
