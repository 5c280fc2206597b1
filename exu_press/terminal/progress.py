"""Progress of a long job: a bar on a terminal, plain lines elsewhere, nothing when quiet."""

import sys
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, ClassVar, NoReturn, TextIO

if TYPE_CHECKING:
    from tqdm import tqdm

__all__ = ["Progress"]

SECONDS_BETWEEN_LINES = 5.0


class Progress(AbstractContextManager["Progress", None]):
    """Progress towards a total, with the time left.

    Used as a context manager; `update` may be called as often as one likes. One that is begun while
    a `whole` one is open shows a part of that: it goes on from where the whole one is. One with a
    `report` calls that with the share that is done, and shows nothing.

    Attributes:
        label: what goes on; may be changed.
    """

    _whole: "ClassVar[Progress | None]" = None

    def __init__(
        self,
        label: str,
        total: float,
        unit: str = "s",
        *,
        quiet: bool = False,
        whole: bool = False,
        stream: TextIO | None = None,
        report: Callable[[float], None] | None = None,
    ) -> None:
        self._part_of, self._done = None if quiet else Progress._whole, 0.0
        self._begun = 0.0 if self._part_of is None else self._part_of._done
        if whole:
            Progress._whole = self
        self.label, self._total = label, total
        number = f"{total:.3g}" if total < 1e3 else f"{total:.0f}"
        self._size = f"of {number} {unit}, " if unit else ""
        self._stream = sys.stderr if stream is None else stream
        self._quiet = quiet
        self._start = self._last_line = time.monotonic()
        self._report = report
        shows = not quiet and report is None and self._part_of is None
        on_terminal = shows and self._stream.isatty()
        self._bar = self._begin_bar() if on_terminal else None

    def _begin_bar(self) -> "tqdm[NoReturn]":
        from tqdm import tqdm

        tqdm.monitor_interval = 0  # no thread of its own: a process with one can be copied
        return tqdm(
            miniters=1e-12,  # looks at the clock at every update, as that thread would
            desc=self.label,
            total=self._total,
            file=self._stream,
            bar_format=f"{{desc}}: {{percentage:3.0f}} %|{{bar}}| {self._size}{{remaining}} left",
        )

    def update(self, done: float) -> None:
        """Say how much is done."""
        self._done = done
        if self._part_of is not None:
            self._part_of.update(self._begun + done)
        elif self._report is not None:
            self._report(done / self._total)
        elif self._bar is not None:
            self._bar.set_description_str(self.label, refresh=False)
            self._bar.update(min(done, self._total) - self._bar.n)
        elif not self._quiet:
            now = time.monotonic()
            if now - self._last_line >= SECONDS_BETWEEN_LINES and done > 0:
                self._last_line = now
                print(
                    f"{self.label}: {100 * done / self._total:.0f} % {self._size}"
                    f"{self.time_left(done):.0f} s left",
                    file=self._stream,
                    flush=True,
                )

    def time_left(self, done: float) -> float:
        """Return the estimated time until the end, s, where `done` is done."""
        if self._part_of is not None:
            return self._part_of.time_left(self._begun + done)
        return (time.monotonic() - self._start) * (self._total / done - 1.0)

    def say(self, text: str) -> None:
        """Write a line, above the bar if there is one."""
        if self._part_of is not None:
            self._part_of.say(text)
            return
        line = f"{self.label}: {text}"
        if self._bar is not None:
            self._bar.write(line, file=self._stream)
        elif not self._quiet and self._report is None:
            print(line, file=self._stream, flush=True)

    def __exit__(self, *_: object) -> None:
        if Progress._whole is self:
            Progress._whole = None
        if self._bar is not None:
            self._bar.close()
