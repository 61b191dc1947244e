# SPDX-License-Identifier: MIT
"""Calls that are rejected."""

import pytest


def rejected(error, message, call, *arguments, **options):
    """The call raises the error, with this pattern in its message."""
    with pytest.raises(error, match=message):
        call(*arguments, **options)
