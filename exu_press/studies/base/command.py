"""A study as a command: what it reads, what it runs, and its own arguments."""

import argparse
import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

from exu_press.scene import Scene
from exu_press.studies.base.keys import Key
from exu_press.studies.base.report import Report
from exu_press.studies.base.study import Study, load_study

__all__ = ["SceneCommand", "SceneStudy", "StudyCommand", "list_of_texts"]


class StudyCommand(ABC):
    """`exu-press NAME STUDY.toml`; the registry of studies names the class."""

    example: ClassVar[str]
    """A call."""

    study: ClassVar[type[Study]]
    """Kind of the file's study."""

    uses_workers: ClassVar[bool] = True
    """Whether its runs are done side by side."""

    @classmethod  # noqa: B027  most studies have none
    def add_arguments(cls, parser: argparse.ArgumentParser) -> None:
        """Add arguments beside those that all studies have."""

    @classmethod
    def load(cls, options: argparse.Namespace) -> Study:
        """Return the study of the arguments, which are checked."""
        return load_study(options.study, cls.study, allow_code=options.allow_code)

    @staticmethod
    @abstractmethod
    def run(study: Any, directory: Path, **how: Any) -> Report:
        """Do the runs that are missing, write the report, and return it.

        Args:
            directory: of this study alone.
            how: quiet, and with `uses_workers` workers and dask, of `Runs`.
        """

    @staticmethod
    def select(report: Any, options: argparse.Namespace) -> Report:
        """Return the report with what the arguments choose of it."""
        selected: Report = report
        return selected


def list_of_texts(meaning: str) -> Any:
    """Declare an argument of a study of one scene that may be repeated."""
    return dataclasses.field(default=(), metadata={"texts": meaning})


@dataclasses.dataclass(frozen=True)
class SceneStudy(Study):
    """A study of one scene; its own fields are arguments of its command.

    `key` declares a number, `--NAME N`, or a truth value, `--NAME`; `list_of_texts` a tuple of
    texts, `--NAME TEXT` as often as one likes.

    Attributes:
        label: name of the scene in tables and files.
    """

    with_keys = plain_runs = False

    keys: Mapping[str, Key] = dataclasses.field(default_factory=dict)
    label: str = "scene"


class SceneCommand(StudyCommand):
    """`exu-press NAME SCENE.toml`: a study of one scene and of the command's arguments."""

    study: ClassVar[type[SceneStudy]]

    replaced_keys: ClassVar[Mapping[str, str]] = {}
    """Keys of a scene in whose place the command has arguments, by which `--set` is refused."""

    @classmethod
    def add_arguments(cls, parser: argparse.ArgumentParser) -> None:
        """Add an argument for each of the study's own fields."""
        for field in cls._own_fields():
            meaning, default = (
                field.metadata.get("texts") or field.metadata["meaning"],
                field.default,
            )
            how: dict[str, Any] = {"metavar": "N", "type": type(default)}
            if isinstance(default, bool):
                how = {"action": "store_true"}
            elif isinstance(default, tuple):
                how = {"action": "append", "metavar": field.name.upper()}
                meaning += "; may be repeated"
                default = []
            else:
                meaning += f" ({default})"
            parser.add_argument(f"--{field.name}", default=default, help=meaning, **how)

    @classmethod
    def study_of(cls, scene: Scene, options: argparse.Namespace) -> SceneStudy:
        """Return the study of a scene."""
        values = {field.name: getattr(options, field.name) for field in cls._own_fields()}
        lists = {name: tuple(value) for name, value in values.items() if isinstance(value, list)}
        return cls.study(scene=scene, label=Path(options.scene).stem, **{**values, **lists})

    @classmethod
    def _own_fields(cls) -> list["dataclasses.Field[Any]"]:
        known = {field.name for field in dataclasses.fields(SceneStudy)}
        return [field for field in dataclasses.fields(cls.study) if field.name not in known]
