"""What wrong input is refused with."""

import pytest

from exu_press.errors import InputError


def refused(call, *arguments, **named):
    """Return the one line with which a call is refused."""
    with pytest.raises(InputError) as caught:
        call(*arguments, **named)
    message = str(caught.value)
    assert "\n" not in message
    return message
