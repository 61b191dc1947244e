# SPDX-License-Identifier: MIT
"""Ctrl-C in the middle of a call, and how long the call takes to stop."""

import signal
import threading
import time

from slowdown import SLOWDOWN

LATEST = 0.5 * SLOWDOWN
"""Seconds from the signal to the exception: five times what is promised, for busy machines."""


def seconds_from_signal(call, begun=lambda: True) -> float:
    """From Ctrl-C, a tenth of a second into the call and not before begun(), to KeyboardInterrupt.

    The signal is sent while this function waits for it, or not at all. It would end pytest if it
    came before, when a busy machine has not started the call in that time, or after a call that
    failed or ended by itself.
    """
    over = threading.Event()
    sent, caught, ended = [], [], []

    def send():
        over.wait(0.1)
        while not over.is_set() and not begun():
            over.wait(0.01)
        if not over.is_set():
            sent.append(time.perf_counter())
            signal.raise_signal(signal.SIGINT)

    sender = threading.Thread(target=send)
    try:
        try:
            sender.start()
            call()
            ended.append(time.perf_counter())
        except KeyboardInterrupt:
            caught.append(time.perf_counter())
        finally:
            over.set()
            sender.join()
    except KeyboardInterrupt:  # sent in the moment in which the call ended
        pass
    assert caught and not ended, "the call ended before Ctrl-C"
    return caught[0] - sent[0]


def grows(path):
    """Whether some blocks of rows more are in a file that a run writes: 300 kB."""
    def size():
        return path.stat().st_size if path.exists() else 0

    before = size()
    return lambda: size() > before + 300_000
