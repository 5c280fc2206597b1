"""Entry of `exu-press`: until the command runs, Ctrl-C ends the process quietly."""

import atexit
import gc
import signal

__all__ = ["main"]


def main() -> int:
    """Run the command line and return the exit status."""
    usual = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if usual:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from exu_press.cli import main as run

    if usual:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    atexit.register(gc.freeze)  # Python's end looks for cycles in all else, for a tenth of a second
    return run()


if __name__ == "__main__":
    raise SystemExit(main())
