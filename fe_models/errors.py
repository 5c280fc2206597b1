"""The one kind of error that a user's input can raise, here and in exu_press."""

import re

__all__ = ["InputError"]

MOST_LETTERS = 8000
"""Most letters of a message: lists of what is allowed have up to half of them."""

MOST_IN_A_WORD = 400
"""Most letters of a word in a message: a path of a usual length stands in full, what was pasted by
mistake does not."""

LONG_WORD = re.compile(rf"\S{{{MOST_IN_A_WORD + 1},}}")


class InputError(ValueError):
    """Something the user gave is wrong: the message says what, where, and what is allowed.

    The command line prints the message in one line and exits with status 2.
    """

    def __str__(self) -> str:
        """Return the message in one line; a very long one, or a long word, without its middle.

        What no terminal can show of a name in a file stands as in Python.
        """
        half = MOST_IN_A_WORD // 2
        text = LONG_WORD.sub(
            lambda word: f"{word[0][:half]}[...]{word[0][-half:]}", super().__str__()
        )
        if len(text) > MOST_LETTERS:
            half = MOST_LETTERS // 2
            text = f"{text[:half]} [...] {text[-half:]}"
        return "".join(letter if letter.isprintable() else repr(letter)[1:-1] for letter in text)
