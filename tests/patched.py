"""Tests that put other parts into the package, which compiled code does not take."""

import pytest

from exu_press.joints import COMPILED

PATCHED = pytest.mark.skipif(COMPILED, reason="compiled code does not take what is put in here")
