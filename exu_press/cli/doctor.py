"""Check the installation: versions, extras, and two small runs whose results are known."""

import argparse

from exu_press.installation import check

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press doctor"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add nothing: there is nothing to choose."""


def execute(options: argparse.Namespace) -> int:
    """Print the versions; return 0, or 1 if something is missing or a run goes wrong."""
    print(check.machine())
    versions = check.versions()
    for name, version in versions.items():
        print(f"  {name:16} {version or 'MISSING'}")
    print("extras")
    for extra, packages in check.extras().items():
        missing = ", ".join(name for name, version in packages.items() if version is None)
        print(f"  {extra:16} {f'not installed: {missing}' if missing else 'installed'}")
    cost = "in Python: two to four times as slow; EXU_PRESS_COMPILE=1 at installation compiles them"
    print(f"joints: {'compiled' if check.joints_compiled() else cost}")
    runs = check.runs()
    for run in runs:
        error = f"off by {run.error:.2g} {run.unit}, allowed {run.allowed:g} {run.unit}"
        text = run.reason or f"{run.what} {error}"
        print(f"{'ok' if run.ok else 'WRONG'}: {run.name}: {text}")
    sound = all(versions.values()) and all(run.ok for run in runs)
    print("this installation works" if sound else "this installation does not work")
    return 0 if sound else 1
