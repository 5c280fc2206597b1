"""How far a long job is."""

import io
import threading

from exu_press.terminal.progress import Progress


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_bar_shows_what_is_done_and_starts_no_thread():
    """A process with threads cannot be copied for refinement runs."""
    stream, before = Terminal(), threading.active_count()
    with Progress("run", 2.0, stream=stream) as progress:
        progress.update(1.0)
        assert threading.active_count() == before
        progress.update(2.0)
    assert "100 %" in stream.getvalue().rpartition("\r")[2]


def test_nothing_is_shown_when_quiet():
    stream = Terminal()
    with Progress("run", 2.0, quiet=True, stream=stream) as progress:
        progress.update(2.0)
    assert stream.getvalue() == ""
