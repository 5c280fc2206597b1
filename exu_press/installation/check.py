"""Checks of an installation: versions, extras, and two small runs whose results are known."""

import importlib.metadata
import os
import platform
from collections.abc import Callable
from dataclasses import dataclass

from packaging.requirements import Requirement

from exu_press.installation.versions import version_of

__all__ = ["Run", "extras", "joints_compiled", "machine", "runs", "versions"]

PACKAGE = "exu-press"

IDEAL_PEAK_ERROR = 1e-6
"""Allowed error of the ideal press's slider, m; it is below 1e-11 in practice."""

LUBRICATED_SLIDER = -0.40686791372440756
"""Slider position of the lubricated slider-crank after 0.4 revolutions, m: by a model of its own
with two coordinates, integrated by SciPy's Radau to 1e-10 (tests/independent)."""

LUBRICATED_ERROR = 1e-7
"""Allowed error of it at steps of 1e-4 s, m; the film alone moves the slider by 3.5e-6 m."""


@dataclass(frozen=True)
class Run:
    """A small run and the number it should give.

    Attributes:
        name: of the run, in words.
        what: the quantity.
        unit: of it.
        value: the run's result.
        expected: the right result.
        allowed: largest difference.
        reason: why the run ended early or failed; empty where it did not.
    """

    name: str
    what: str
    unit: str
    value: float
    expected: float
    allowed: float
    reason: str = ""

    @property
    def error(self) -> float:
        """Distance from the expected value."""
        return abs(self.value - self.expected)

    @property
    def ok(self) -> bool:
        """Return whether the number is right."""
        return not self.reason and self.error <= self.allowed


def machine() -> str:
    """Return Python, system, processor and the number of cores, in words."""
    return (
        f"Python {platform.python_version()}, {platform.system()} {platform.machine()}, "
        f"{os.cpu_count()} cores"
    )


def versions() -> dict[str, str | None]:
    """Return the version of every package that is needed; None where it is missing."""
    return {name: version_of(name) for name in [PACKAGE, *_requirements()[""]]}


def extras() -> dict[str, dict[str, str | None]]:
    """Return the versions of each extra's packages, by extra; None where one is missing."""
    return {
        extra: {name: version_of(name) for name in names}
        for extra, names in _requirements().items()
        if extra
    }


def joints_compiled() -> bool:
    """Return whether the joints' forces come from compiled code."""
    from exu_press.joints.compiled import COMPILED

    return COMPILED


def runs() -> list[Run]:
    """Run the press with ideal joints and a lubricated slider-crank, half a second together."""
    return [_attempt("ideal press", _ideal_press), _attempt("lubricated film", _lubricated_run)]


def _attempt(name: str, run: Callable[[], Run]) -> Run:
    """Return a run; whatever keeps it from running is its reason."""
    try:
        return run()
    except Exception as error:  # a broken installation can fail in any way
        text = f"{type(error).__name__}: {error}"
        return Run(name, "", "", float("nan"), float("nan"), 0.0, text)


def _ideal_press() -> Run:
    import numpy as np

    from exu_press import Scene, simulate
    from exu_press.scene import mechanism_of

    scene = Scene.from_dict({"joints": {}, "revolutions": 1.0})
    result = simulate(scene)
    angle = scene.start_angle + scene.angular_speed * result.time
    ideal, _, _ = mechanism_of(scene).ideal_slider(angle, scene.angular_speed)
    error = float(np.abs(result["slider_position"] - ideal).max())
    return Run(
        "press, ideal joints, one revolution",
        "slider's distance from the closed form",
        "m",
        error,
        0.0,
        IDEAL_PEAK_ERROR,
        str(result.info["reason"]),
    )


def _lubricated_run() -> Run:
    from exu_press import Scene, simulate

    scene = Scene.from_dict(
        {
            "mechanism": "slider_crank",
            "joints": {"crank_pin": "lubricated"},
            "film": {"law": "pinkus"},
            "start": "centred",
            "revolutions": 0.4,
            "solver": {"step": 1e-4},
        }
    )
    result = simulate(scene)
    return Run(
        "slider-crank, lubricated pin, 0.4 revolutions",
        "slider position at the end",
        "m",
        float(result["slider_position"][-1]),
        LUBRICATED_SLIDER,
        LUBRICATED_ERROR,
        str(result.info["reason"]),
    )


def _requirements() -> dict[str, list[str]]:
    """Return the names of the packages that this system needs, by extra; "" is always needed."""
    metadata = importlib.metadata.metadata(PACKAGE)
    required = [Requirement(line) for line in metadata.get_all("Requires-Dist", [])]
    names: dict[str, list[str]] = {}
    for extra in ("", *metadata.get_all("Provides-Extra", [])):
        always = set(names.get("", []))
        names[extra] = [
            requirement.name
            for requirement in required
            if requirement.name not in {PACKAGE, *always}
            and (requirement.marker is None or requirement.marker.evaluate({"extra": extra}))
        ]
    return names
