"""The one kind of error that a user's input can raise; the package below this one raises it too."""

from fe_models.errors import InputError

__all__ = ["InputError"]

InputError.__module__ = __name__  # as tracebacks and the reference name it
