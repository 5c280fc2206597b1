"""A study as a command: what it reads, what it runs, and its own arguments."""

import argparse
from abc import ABC, abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

from exu_press.scene import Scene
from exu_press.studies.base.report import Report
from exu_press.studies.base.study import Study, load_study

__all__ = ["SceneCommand", "StudyCommand"]


class StudyCommand(ABC):
    """`exu-press NAME STUDY.toml`; the registry of studies names the class."""

    example: ClassVar[str]
    """A call."""

    study: ClassVar[type[Study]]
    """Kind of the file's study."""

    uses_workers: ClassVar[bool] = True
    """Whether its runs are done side by side."""

    of_scene: ClassVar[bool] = False
    """Whether it reads a scene, as SceneCommand does, and no study file."""

    @staticmethod  # noqa: B027  most studies have none
    def add_arguments(parser: argparse.ArgumentParser) -> None:
        """Add arguments beside those that all studies have."""

    @classmethod
    def load(cls, options: argparse.Namespace) -> Study:
        """Return the study of the arguments, which are checked.

        Raises:
            InputError: not allowed.
        """
        return load_study(options.study, cls.study, allow_code=options.allow_code)

    @staticmethod
    @abstractmethod
    def run(study: Any, directory: Path, **how: Any) -> Report:
        """Do the runs that are missing, write the report, and return it.

        Args:
            study: of the kind `study`.
            directory: of this study alone.
            how: quiet, and with `uses_workers` workers and dask, of `Runs`.
        """

    @staticmethod
    def select(report: Any, options: argparse.Namespace) -> Report:
        """Return the report with what the arguments choose of it."""
        selected: Report = report
        return selected


class SceneCommand(StudyCommand):
    """`exu-press NAME SCENE.toml`: a study of one scene, made of the command's arguments."""

    of_scene = True

    replaced_keys: ClassVar[Mapping[str, str]] = {}
    """Keys of a scene in whose place the command has arguments, by which `--set` is refused."""

    @classmethod
    @abstractmethod
    def study_of(cls, scene: Scene, options: argparse.Namespace) -> Study:
        """Return the study of a scene.

        Raises:
            InputError: arguments are not allowed.
        """
