"""The run that `run --from` goes on from, and the keys that both runs share."""

import dataclasses
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.digests import file_digest
from exu_press.files.output_directory import RUN_FILE, checkpoint_directory
from exu_press.mechanism import Mechanism
from exu_press.model.state import State
from exu_press.result import Result
from exu_press.result.checkpoint import has_blocks
from exu_press.scene import Scene, mechanism_of
from exu_press.scene.bodies import OF_FILES, Flexible

__all__ = ["start_path", "start_state", "with_start"]

OF_THE_START = "start", "start_angle_deg"
"""Keys that do nothing where a run goes on from another one."""

GEOMETRY = {
    "joints": ("at", "journal", "bearing", "shape"),
    "bodies": ("centre_of_mass", "angle"),
    "guides": ("direction", "body", "on", "at", "centre"),
    "gears": ("body", "to", "ratio"),
}
"""What of a mechanism decides positions and velocities that fit its constraints."""

OF_NO_MODE = {"flexible", "matrices", "damping_ratio", "sn_stress", "sn_cycles", "sn_slope"}
"""Keys of a flexible body besides those that decide its modes, but for the name of its part."""


def start_path(name: str) -> Path:
    """Return the file, or the directory of blocks, that --from means.

    In the directory of a run, what a killed one has left is newer than the result beside it.
    """
    path = Path(name)
    file = path / RUN_FILE if path.is_dir() else path
    blocks = path if has_blocks(path) else checkpoint_directory(file)
    return blocks if has_blocks(blocks) and (path.is_dir() or not path.exists()) else file


def start_state(path: Path, scene: Scene) -> State:
    """Return the state in which a run ended, from which a scene's goes on.

    Raises:
        InputError: the run did not get to its end, or the scene has keys with which its bodies
            would start where, or as fast as, its joints do not let them, or that do nothing.
    """
    previous = Result.load(path)
    if not previous.completed or "state" not in previous.info:
        why = previous.info["reason"] or "it was written without the state at its end"
        raise InputError(f"--from {path}: allowed is a run that reached its end; {why}")
    for key, asked, began in _shared_keys(scene, previous.scene):
        if asked != began:
            raise InputError(
                f"--from {path}: {key} = {asked!r}; allowed is {began!r}, as in that run"
            )
    for key in OF_THE_START:
        asked, began = getattr(scene, key), getattr(previous.scene, key)
        if asked != began:
            raise InputError(
                f"--from {path}: {key} = {asked!r} does nothing in a run that goes on; "
                f"allowed is {began!r}, with which that run began"
            )
    return previous.info["state"]


def with_start(result: Result, path: Path) -> Result:
    """Return a run that went on from another one, with that in its provenance."""
    provenance = result.info["provenance"]
    files = sorted(path.iterdir()) if path.is_dir() else [path]
    digests = {str(file): file_digest(file) for file in files}
    provenance = {
        **provenance,
        "files": {**provenance["files"], **digests},
        "start": str(path),
    }
    return replace(result, info={**result.info, "provenance": provenance})


def _shared_keys(scene: Scene, previous: Scene) -> Iterator[tuple[str, object, object]]:
    """Yield names and both values of what a run that goes on shares with the one before it."""
    yield from _shared_geometry(mechanism_of(scene), mechanism_of(previous))
    if scene.drive is None:
        yield "speed_rpm", scene.speed_rpm, previous.speed_rpm
    for name, joint in scene.joints.items():
        began = previous.joints[name]
        yield f"joints.{name}.kind", joint.kind, began.kind
        if joint.film is not None and began.film is not None:
            kinds = joint.film.at_contact.kind, began.film.at_contact.kind
            yield f"joints.{name}.film.at_contact", *kinds
    yield "bodies", [*scene.bodies], [*previous.bodies]
    for name, body in scene.bodies.items():
        earlier = previous.bodies[name]
        yield f"bodies.{name}", Path(body.source).name, Path(earlier.source).name
        for key in dataclasses.fields(Flexible):
            if key.name not in OF_NO_MODE.union(OF_FILES):
                values = getattr(body, key.name), getattr(earlier, key.name)
                yield f"bodies.{name}.{key.name}", *values


def _shared_geometry(
    mechanism: Mechanism, previous: Mechanism
) -> Iterator[tuple[str, object, object]]:
    """Yield names and both values of what two mechanisms share, but for masses and stiffness."""
    yield "mechanism", mechanism.name, previous.name
    for kind, keys in GEOMETRY.items():
        items, earlier = (
            {item.name: item for item in getattr(drawn, kind)} for drawn in (mechanism, previous)
        )
        yield f"{kind} of the mechanism", [*items], [*earlier]
        for name, item in items.items():
            for key in keys:
                values = getattr(item, key), getattr(earlier[name], key)
                yield f"{kind}.{name}.{key} of the mechanism", *values
