"""Tests that patch the package from outside, which compiled code does not notice."""

import pytest

from exu_press.joints import COMPILED

PATCHED = pytest.mark.skipif(COMPILED, reason="compiled code does not look up what is patched here")
