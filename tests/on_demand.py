"""Values that several tests share, each made when the first of them asks for it."""


class OnDemand(dict):
    """A dictionary whose values a function makes of their keys."""

    def __init__(self, make):
        super().__init__()
        self._make = make

    def __missing__(self, key):
        self[key] = self._make(key)
        return self[key]
