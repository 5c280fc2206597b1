"""The pictures of a run, drawn by a process beside the command."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.output_directory import remove_partial
from exu_press.plots.format import picture_format
from exu_press.result import Result
from exu_press.result.channels import is_on_disk
from exu_press.scene import Scene, mechanism_of
from exu_press.terminal.interrupt import postponed_interrupt
from fe_models.processes import performed_beside
from fe_models.temporary import TemporaryFolder

__all__ = ["PicturesBeside", "pictures_beside"]


class PicturesBeside:
    """What a process draws, in the order of the requests.

    A run on the disk is drawn by this process, as elsewhere it would be in memory.
    """

    def __init__(self, begin: Callable[..., Callable[[], list[Path]]], folder: Path) -> None:
        """Let it load what draws.

        Args:
            begin: asks the process to call a function with arguments, see `performed_beside`.
            folder: for pictures that are drawn before the errors of a run are known.
        """
        self.directories: set[Path] = set()
        self._begin, self._folder = begin, folder
        self._begun = [begin(_load)]
        self._drawn_early: Scene | None = None

    def prepare(self, scene: Scene) -> None:
        """Find what all pictures of a scene's run show."""
        self._begun.append(self._begin(_prepare, scene))

    def draw_early(self, run: Result) -> None:
        """Draw the pictures of a run that show no errors, which are not known yet."""
        if run.completed and not is_on_disk(run.channels):
            with postponed_interrupt():  # half a request would spoil the next one
                self._begun.append(self._begin(_draw_early, run, self._folder))
                self._drawn_early = run.scene

    def draw(self, run: Result, directory: Path) -> Callable[[], list[Path]]:
        """Draw all pictures of a run; return what returns their files."""
        self.directories.add(directory)
        early = self._folder if self._drawn_early == run.scene else None
        if is_on_disk(run.channels):
            return partial(_draw, run, directory)
        self._begun.append(self._begin(_draw, run, directory, early))
        return lambda: [written() for written in self._begun][-1]


@contextmanager
def pictures_beside() -> Iterator[PicturesBeside]:
    """Yield what draws pictures; no half picture is left of a process that is killed."""
    pictures = None
    try:
        with TemporaryFolder() as folder, performed_beside(_perform) as begin:
            pictures = PicturesBeside(begin, folder)
            yield pictures
    finally:
        for directory in pictures.directories if pictures else ():
            remove_partial(directory / f"*{picture_format().ending}")


def _perform(function: Callable[..., list[Path]], *arguments: object) -> list[Path]:
    return function(*arguments)


def _load() -> list[Path]:
    import exu_press.plots.save  # noqa: F401

    return []


def _prepare(scene: Scene) -> list[Path]:
    _ = mechanism_of(scene).dead_centres  # kept
    return []


def _draw_early(run: Result, folder: Path) -> list[Path]:
    from exu_press.plots.save import save_early_pictures

    try:
        return save_early_pictures(run, folder)
    except InputError:  # no room; it is drawn later
        return []


def _draw(run: Result, directory: Path, early: Path | None = None) -> list[Path]:
    from exu_press.plots import save_pictures

    return save_pictures(run, directory, early)
