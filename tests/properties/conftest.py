"""The quick suite draws the same examples in every run; the long tests draw new ones."""

from hypothesis import settings

settings.register_profile("quick", derandomize=True)
settings.load_profile("quick")
