"""Runs of the scenes of a study: side by side, resumable."""

import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, Self

from exu_press.errors import InputError, error_prefix
from exu_press.files.digests import file_digest
from exu_press.files.file_format import refuse_newer_format
from exu_press.files.lock import lock_directory
from exu_press.files.output_directory import output_directory, subdirectory, write_json
from exu_press.parallel import FILE, Batch, Row
from exu_press.parallel.task import Function
from exu_press.quantities import own_modules, values_of
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.scene.provenance import files_in
from exu_press.schema.kinds import custom_modules
from exu_press.schema.stored import from_json
from exu_press.studies.base.report import FORMAT, Report
from exu_press.studies.base.study import Study

__all__ = ["Row", "Runs", "arguments_of", "row_of", "run_scene", "scene_from"]

STUDY_FILE = "study.json"


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


class Runs(Batch):
    """The runs of a study in its directory; a context manager.

    Worker processes stay alive between calls of `run_scenes`. Each row is written before the next
    run begins, so that a study that was killed continues: finished runs are read. Two runs are the
    same if their scenes are, whatever the order and number of calls.
    """

    def __init__(
        self,
        study: Study,
        directory: str | Path,
        *,
        report: type[Report] | None = None,
        label: str = "",
        function: Function | None = None,
        quiet: bool = True,
        **workers: Any,
    ) -> None:
        """Prepare; processes start with the first run.

        Args:
            directory: of this study alone.
            report: of the study; its files are written in the end.
            label: of the progress bar; the report's name where there is none.
            function: of a run's arguments, for `rows`; `run_scene` by default.
            workers: `workers` or `dask`, as of a `Batch`.

        Raises:
            InputError: no worker can declare a quantity of the user's own; or as of a `Batch`.
        """
        super().__init__(
            run_scene if function is None else function,
            directory,
            time_limit=study.time_limit,
            has_files=_file_is_whole,
            modules=(*own_modules(), *custom_modules(study.to_dict())),
            label=label or ("study" if report is None else report.name),
            quiet=quiet,
            **workers,
        )
        self._study = study
        self._files = () if report is None else report.files

    def __enter__(self) -> Self:
        """Lock the directory.

        Raises:
            InputError: it cannot be used, belongs to another study, or another run writes in it.
        """
        output_directory(self.directory)
        self.enter_context(lock_directory(self.directory))
        try:
            _claim(self.directory, self._study.to_dict(), self._files)
        except BaseException:
            self.close()
            raise
        return super().__enter__()

    def run_scenes(self, scenes: Sequence[Scene], files: Sequence[str] = ()) -> list[Row]:
        """Return the row of each scene: status, reason, end_time, its quantities by name.

        With the study's `errors` also `errors`, `horizon` and `lyapunov_exponent`. A run that
        raised an error, took too long or ended its process has status and reason alone.

        Args:
            scenes: any number; equal ones are run once.
            files: names of the run.nc of each in the study's directory, if they are kept.
        """
        errors = {"errors": True} if self._study.errors else {}
        arguments: list[dict[str, Any]] = [{**arguments_of(s), **errors} for s in scenes]
        for run, file in zip(arguments, files, strict=False):
            inside = subdirectory(self.directory, str(Path(file).parent))
            run["save"] = str(inside.resolve() / Path(file).name)
        return self.rows(arguments)


def run_scene(arguments: dict[str, Any]) -> dict[str, Any]:
    """Run {"scene": ...}, optionally with "save": file and "errors": True; return its row."""
    from exu_press.verification.simulate import simulate

    scene = scene_from(arguments)
    result = simulate(scene, errors=bool(arguments.get("errors")), beside=False)
    if "save" in arguments:
        result.save(arguments["save"])
    return row_of(result)


def row_of(result: Result) -> dict[str, Any]:
    """Return the row of a run: status, reason, quantities and their errors."""
    info, values = result.info, values_of(result)
    row: dict[str, Any] = {name: info[name] for name in ("status", "reason", "end_time")}
    row |= {name: value.value for name, value in values.items()}
    if "errors" in info:
        row |= {name: info[name] for name in ("errors", "horizon", "lyapunov_exponent")}
    return row


def _file_is_whole(arguments: Mapping[str, Any]) -> bool:
    """Return whether the run.nc of a run can be read, if it has one."""
    from exu_press.result.netcdf import is_whole

    return "save" not in arguments or is_whole(Path(arguments["save"]))


def _claim(directory: Path, study: Mapping[str, Any], written: Sequence[str]) -> None:
    """Write study.json, or check that it is this study's."""
    path = directory / STUDY_FILE
    own = json.loads(json.dumps(study))
    if not path.exists():
        foreign = [name for name in written if (directory / name).exists()]
        if foreign:
            raise InputError(
                f"{directory}: has {foreign[0]} and no {path.name}, so that it may belong to "
                f"another study; allowed is a directory of the study's own, or to delete "
                f"{' and '.join(foreign)}; runs of this study in {FILE} are kept"
            )
        write_json(path, {"format": FORMAT, **own})
        return
    stored: dict[str, Any] = {}
    with suppress(OSError, InputError):
        stored = from_json(dict[str, Any], path.read_bytes(), path.name)
    with error_prefix(f"{path}: "):
        refuse_newer_format(str(stored.pop("format", "")), FORMAT)
    if stored != own:
        names = (name for name in {**own, **stored} if stored.get(name) != own.get(name))
        where = f" in {next(names, '')}" if stored else ""  # it cannot be read
        raise InputError(
            f"{directory}: belongs to another study ({path.name} differs{where}); "
            "allowed is another directory, or to remove this one"
        )
