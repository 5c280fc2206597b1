"""The arguments of a run, with digests of the files that its scene names."""

from typing import Any

from exu_press.errors import InputError
from exu_press.files.digests import file_digest
from exu_press.scene import Scene
from exu_press.scene.provenance import files_in

__all__ = ["arguments_of", "scene_from"]


def arguments_of(scene: Scene) -> dict[str, Any]:
    """Return what identifies a run of a scene: its keys and the digests of its files."""
    data = scene.to_dict()
    files = {path: file_digest(path) for path in files_in(data)}
    return {"scene": data, "files": files} if files else {"scene": data}


def scene_from(arguments: dict[str, Any]) -> Scene:
    """Return the scene of a run's arguments.

    Raises:
        InputError: one of its files has been changed since they were made, or is gone.
    """
    for path, digest in arguments.get("files", {}).items():
        if file_digest(path) != digest:
            raise InputError(
                f"{path}: has been changed while the study goes on; the same command does the run "
                "with the new file"
            )
    return Scene.from_dict(arguments["scene"])
