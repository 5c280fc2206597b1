"""The command line: one module a command."""

from exu_press.cli.main import main

__all__ = ["main"]
