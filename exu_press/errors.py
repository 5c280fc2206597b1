"""The one kind of error that a user's input can raise; the package below this one raises it too."""

from fe_models.errors import InputError

__all__ = ["InputError", "UnusedKeyError"]

InputError.__module__ = __name__  # as tracebacks and the reference name it


class UnusedKeyError(InputError):
    """A key or a table that a scene gives and does not use.

    Attributes:
        name: dotted, or a table's.
    """

    def __init__(self, name: str, shown: str, reason: str) -> None:
        super().__init__(f"{shown}: not used by this scene ({reason}); remove it")
        self.name = name
