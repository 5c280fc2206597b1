"""What the tests of child processes let them do; a child imports it from here."""

import errno
import json
import os
import re
import sys
from pathlib import Path

from fe_models.errors import InputError


def folder_of_json():
    """Where a module of the standard library comes from, and the search path."""
    return json.__file__, sys.path


def square(x, report=lambda *values: None):
    report("squares", x)
    print("squaring", x)
    return x * x


def refuses():
    raise InputError("no such thing")


def fails():
    raise ValueError("no\nnumber")


def mourns():
    print("about to go", flush=True)
    os._exit(7)


def breaks_down():
    print("before\nTraceback (most recent call last):\n  File\nOSError: no more", flush=True)
    os._exit(1)


def fills_a_disk():
    raise OSError(errno.ENOSPC, "No space left on device", "/small/file")


def deaf(mark):
    """Compute for hours, like compiled code: no other thread of Python runs meanwhile."""
    Path(mark).write_text(str(os.getpid()))
    re.match("(a+)+$", "a" * 60 + "b")


def large(count):
    return [bytes(2**20)] * count, os.getpid()
