"""Where a result comes from: date, command, version, and digests of every file that went in."""

import sys
from collections.abc import Iterator
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any, NotRequired, TypedDict

from exu_press.errors import InputError
from exu_press.files.command import command_line
from exu_press.files.digests import file_digest, files_read, locate
from exu_press.scene.scene import Scene

__all__ = ["Provenance", "changed_inputs", "files_in", "provenance_of", "rows_of"]


class Provenance(TypedDict):
    """Where a result comes from.

    Attributes:
        date: when the integration started, with its zone, as ISO 8601 has it.
        command: for a shell.
        version: of exu_press.
        files: sha256 of the files that went in, by their paths as they were given; a file of this
            package begins with "exu_press:".
        code: sha256 of the user's modules that kinds of the scene come from, with all of the user's
            own files that these import or name.
        start: the run from which this one goes on.
    """

    date: str
    command: str
    version: str
    files: dict[str, str]
    code: dict[str, str]
    start: NotRequired[str]


def provenance_of(scene: Scene | None = None) -> Provenance:
    """Return the provenance of what is computed now: of a scene, or of all files read so far."""
    files = files_read()
    code: dict[str, str] = {}
    if scene is not None:
        data = scene.to_dict()
        files = {**scene.files, **{path: file_digest(path) for path in files_in(data)}}
        code = _code_digests(scene)
    return {
        "date": datetime.now(UTC).astimezone().isoformat(timespec="seconds"),
        "command": command_line(),
        "version": version("exu-press"),
        "files": files,
        "code": code,
    }


def rows_of(provenance: Provenance) -> list[tuple[str, str]]:
    """Return provenance as texts with their heads, for a page."""
    heads = [(name, str(provenance[name])) for name in ("date", "command", "version")]
    heads += [("goes on from", provenance["start"])] if "start" in provenance else []
    digests = {**provenance["files"], **provenance["code"]}
    return heads + [(f"sha256 of {name}", digest) for name, digest in digests.items()]


def changed_inputs(provenance: Provenance, scene: Scene) -> dict[str, str]:
    """Return the inputs of a run that are others now, each with how: changed, missing or new.

    Args:
        provenance: of the run.
        scene: of the run.
    """
    now: dict[str, str | None] = {}
    for name in provenance["files"]:
        try:
            now[name] = file_digest(locate(name))
        except InputError:
            now[name] = None
    code = _code_digests(scene)
    stored = {**provenance["files"], **provenance["code"]}
    present = {**dict.fromkeys(stored), **now, **code}
    return {
        name: "missing" if digest is None else "changed" if name in stored else "new"
        for name, digest in present.items()
        if digest != stored.get(name)
    }


def files_in(data: Any) -> Iterator[str]:
    """Yield the texts of a scene that are names of files, as of STEP files, and files of these."""
    if isinstance(data, dict):
        if isinstance(description := data.get("matrices"), str) and Path(description).is_file():
            from fe_models.matrices import Description  # loads SciPy's reader

            yield from map(str, Description.read(Path(description)).files.values())
        for value in data.values():
            yield from files_in(value)
    elif isinstance(data, list | tuple):
        for value in data:
            yield from files_in(value)
    elif isinstance(data, str) and Path(data).suffix and Path(data).is_file():
        yield data


def _code_digests(scene: Scene) -> dict[str, str]:
    """Return the digests of the user's sources that a scene's kinds come from."""
    modules = {kind.module for _, kind in scene.kinds()} - {""}
    if not modules:
        return {}
    from exu_press.files.sources import users_files  # parses them

    files = users_files(module.partition(".")[0] for module in modules - {"__main__"})
    script = getattr(sys.modules["__main__"], "__file__", None)
    if "__main__" in modules and script is not None:
        files["__main__"] = Path(script)
    return {label: file_digest(file) for label, file in sorted(files.items())}
