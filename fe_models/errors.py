"""The one kind of error that a user's input can raise, here and in exu_press."""

__all__ = ["InputError"]


class InputError(ValueError):
    """Something the user gave is wrong: the message says what, where, and what is allowed.

    The command line prints the message in one line and exits with status 2.
    """

    def __str__(self) -> str:
        """Return the message; what no terminal can show of a name in a file stands as in Python."""
        return "".join(
            letter if letter.isprintable() or letter == "\n" else repr(letter)[1:-1]
            for letter in super().__str__()
        )
