"""A scene in words, for the title of a picture."""

import math
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence

from exu_press.mechanism.press import NoCounterweight
from exu_press.result import Result
from exu_press.scene import Scene, mechanism_of
from exu_press.scene.guide import ElasticGuide

__all__ = ["ONE_LINE", "describe", "early_stops", "joint_in_words"]

ONE_LINE = math.inf
"""Width where words are wrapped by what shows them, as a page does."""

FEW = 3
"""Joints or groups with clearance that are named one by one."""

SEPARATOR = "  ·  "
CROSS = "\N{MULTIPLICATION X}"  # as it marks the end of the curves


def describe(scenes: Iterable[Scene], width: float = 130) -> str:
    """Return the common parts of scenes in words, in lines of at most `width` letters.

    A joint that only some scenes have with clearance is named with that clearance.
    """
    scenes = list(scenes)
    kinds = [_kinds_of_joints(scene) for scene in scenes]
    joints = kinds[0] if all(kind == kinds[0] for kind in kinds) else _common_of_joints(scenes)
    first, *further = (list(_phrases(scene, joints)) for scene in scenes)
    shared = [text for text in first if all(text in phrases for phrases in further)]
    return _join_wrapped(shared, width)


def early_stops(results: Mapping[str, Result], width: int = 130) -> str:
    """Return a line for every run that did not reach its end, or nothing."""
    lines = []
    for label, result in results.items():
        if not result.completed:
            why = str(result.info["reason"] or result.info["status"]).partition(";")[0]
            which = f"{label}: " if len(results) > 1 else ""
            lines.append(
                textwrap.shorten(f"{which}stopped early ({CROSS}): {why}", width, placeholder="...")
            )
    return "\n".join(lines)


def joint_in_words(name: str) -> str:
    """Return a joint's name with its side behind it.

    >>> joint_in_words("ball_left"), joint_in_words("crank_pin")
    ('Ball, left', 'Crank pin')
    """
    for side in ("left", "right"):
        name = name.replace(f"_{side}", f", {side}")
    return name.replace("_", " ").capitalize()


def _phrases(scene: Scene, joints: Iterable[str]) -> Iterator[str]:
    """Yield what there is to say about a scene, with phrases about its joints."""
    yield mechanism_of(scene).name.replace("_", " ").capitalize()
    yield _of_bodies(scene)
    yield f"{scene.speed_rpm:g} rpm"
    yield from joints
    yield from _of_loads(scene)
    if scene.drive is not None:
        motor = scene.drive
        torque = motor.torque.shown_torque
        yield f"motor of {torque:g} N m, flywheel {motor.inertia:g} kg m²"
    if scene.guides:
        yield _of_guides(scene)
    if scene.press is not None and isinstance(scene.press.counterweight, NoCounterweight):
        yield "no counterweight"


def _of_guides(scene: Scene) -> str:
    """Return the guides of each kind in one phrase; without names where all are of one."""
    alike: dict[str, list[str]] = {}
    for name, guide in scene.guides.items():
        alike.setdefault(_guide_in_words(guide), []).append(name.replace("_", " "))
    if len(alike) == 1 and len(scene.guides) == len(mechanism_of(scene).guides):
        return f"guides {next(iter(alike))}"
    phrases = (f"{', '.join(names)} {words}" for words, names in alike.items())
    return f"guides: {'; '.join(phrases)}"


def _guide_in_words(guide: ElasticGuide) -> str:
    words = []
    if guide.clearance is not None:
        words.append(f"clearance {guide.clearance * 1e3:g} mm")
    if guide.oil is not None:
        words.append(f"oil of {guide.oil.viscosity:g} Pa s")
    if guide.rubs:
        words.append(f"{guide.friction.kind} friction")
    kinds = ["elastic"] if guide.soft and guide.clearance is None else []
    kinds += [f"with {' and '.join(words)}"] if words else []
    return ", ".join(kinds)


def _of_bodies(scene: Scene) -> str:
    names = ", ".join(name.replace("_", " ") for name in scene.bodies)
    return f"flexible {names}" if names else "rigid bodies"


def _of_loads(scene: Scene) -> Iterator[str]:
    for name, load in scene.applied_loads.items():
        what = "blanking" if load.kind == "blanking" else f"{name.replace('_', ' ')}"
        words = f"{what} force {load.curve.peak / 1e3:g} kN"
        if math.isnan(load.curve.peak):
            words = f"{what} of kind {load.kind}"
        if load.body != mechanism_of(scene).slider:
            words += f" on {load.body.replace('_', ' ')}"
        arm = load.point[0] * load.direction[1] - load.point[1] * load.direction[0]
        if arm:
            words += f", {arm * 1e3:g} mm off centre"
        yield words


def _common_of_joints(scenes: Sequence[Scene]) -> list[str]:
    """Return the kinds that joints have in all scenes, and the clearances of those that have one.

    Joints that are alike are in one phrase where more than FEW have clearance.
    """
    names = dict.fromkeys(name for scene in scenes for name in scene.joints.by_group)
    common: list[tuple[str, str]] = []
    for name in names:
        members = [
            scene.joints.get(member) for scene in scenes for member in scene.joints.members(name)
        ]
        words = name.replace("_", " ")
        kinds = {None if joint is None else joint.kind for joint in members}
        if len(kinds) == 1:
            common.append((words, str(kinds.pop())))
        clearances = {joint.clearance for joint in members if joint is not None} - {0.0}
        if len(clearances) == 1:
            text = f"radial clearance {clearances.pop() * 1e3:g} mm"
            is_group = any(name in scene.joints.groups for scene in scenes)
            singular = words.removesuffix("s") if is_group and len(names) <= FEW else words
            common.append((singular, text))
    if len(names) <= FEW:
        return [f"{joint} {text}" for joint, text in common]
    alike: dict[str, list[str]] = {}
    for joint, text in common:
        alike.setdefault(text, []).append(joint)
    return [f"{', '.join(joints)} {text}" for text, joints in alike.items()]


def _kinds_of_joints(scene: Scene) -> list[str]:
    """Return the joints and groups of each kind and clearance in one phrase."""
    alike: dict[tuple[str, float], list[str]] = {}
    for name, joint in scene.joints.by_group.items():
        alike.setdefault((joint.kind, joint.clearance), []).append(name.replace("_", " "))
    return [
        f"{', '.join(names)} {kind}, clearance {clearance * 1e3:g} mm"
        for (kind, clearance), names in alike.items()
    ] or ["all joints ideal"]


def _join_wrapped(phrases: Iterable[str], width: float) -> str:
    """Return phrases in lines that break only between them."""
    lines: list[str] = []
    for phrase in phrases:
        if lines and len(lines[-1]) + len(SEPARATOR) + len(phrase) <= width:
            lines[-1] += SEPARATOR + phrase
        else:
            lines.append(phrase)
    return "\n".join(lines)
