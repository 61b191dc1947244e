# SPDX-License-Identifier: MIT
"""Ctrl-C in the middle of a call, and how long the call takes to stop."""

import signal
import threading
import time

import pytest
from slowdown import SLOWDOWN

LATEST = 0.5 * SLOWDOWN
"""Seconds from the signal to the exception: five times what is promised, for busy machines."""


def seconds_from_signal(call) -> float:
    """From Ctrl-C, a tenth of a second into the call, to its KeyboardInterrupt."""
    sent = []

    def send():
        sent.append(time.perf_counter())
        signal.raise_signal(signal.SIGINT)

    timer = threading.Timer(0.1, send)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        call()
    caught = time.perf_counter()
    timer.join()
    return caught - sent[0]
