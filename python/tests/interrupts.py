# SPDX-License-Identifier: MIT
"""Ctrl-C in the middle of a call, and how long the call takes to stop."""

import signal
import threading
import time

from closeness import smallest
from slowdown import SLOWDOWN

LATEST = 0.5 * SLOWDOWN
"""Seconds from the signal to the exception: five times what is promised, for busy machines."""

LONGEST = 10 * LATEST
"""The same by the clock, whatever else the machine does."""


def seconds_from_signal(call, begun=lambda: True) -> float:
    """From Ctrl-C, a tenth of a second into the call and not before begun(), to KeyboardInterrupt.

    By the clock, or by the processor time that this process had meanwhile, where that is less: what
    others on the machine do makes the clock run on, but not the work after the signal. What waits
    without work is told by the clock alone, and may not take LONGEST.

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
            sent.extend((time.perf_counter(), time.process_time()))
            signal.raise_signal(signal.SIGINT)

    sender = threading.Thread(target=send)
    try:
        try:
            sender.start()
            call()
            ended.append(time.perf_counter())
        except KeyboardInterrupt:
            caught.extend((time.perf_counter(), time.process_time()))
        finally:
            over.set()
            sender.join()
    except KeyboardInterrupt:  # sent in the moment in which the call ended
        pass
    assert caught and not ended, "the call ended before Ctrl-C"
    clock, processor = (after - before for after, before in zip(caught, sent))
    assert clock < LONGEST, f"{clock:.2f} s from Ctrl-C to the exception"
    return smallest(clock, processor)


def grows(path):
    """Whether some blocks of rows more are in a file that a run writes: 300 kB."""
    def size():
        return path.stat().st_size if path.exists() else 0

    before = size()
    return lambda: size() > before + 300_000
