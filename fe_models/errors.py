"""The one kind of error that a user's input can raise, here and in exu_press."""

__all__ = ["InputError"]


class InputError(ValueError):
    """Something the user gave is wrong: the message says what, where, and what is allowed.

    The command line prints the message in one line and exits with status 2.
    """
