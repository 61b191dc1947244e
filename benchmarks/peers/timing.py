# SPDX-License-Identifier: MIT
"""Interleaved repetitions in processor time: what disturbs one disturbs its neighbours."""

import dataclasses
import resource
import statistics
import time
from collections.abc import Callable


@dataclasses.dataclass
class Contender:
    """A method of somebody at one setting. `run` works once and returns (units, end state)."""

    who: str
    setting: str
    run: Callable
    once: bool = False  # too slow to repeat


@dataclasses.dataclass
class Timed:
    who: str
    setting: str
    seconds: list
    ends: list

    @property
    def median(self):
        return statistics.median(self.seconds)


def spent():
    """Seconds of this process, and of those that it started and that have ended."""
    others = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + others.ru_utime + others.ru_stime


def interleaved(contenders, repetitions):
    """Every contender once, then again: seconds for a unit of work, and ends."""
    found = [Timed(c.who, c.setting, [], []) for c in contenders]
    for repetition in range(repetitions):
        for contender, timed in zip(contenders, found, strict=True):
            if contender.once and repetition:
                continue
            begin = spent()
            units, end = contender.run()
            timed.seconds.append((spent() - begin) / units)
            timed.ends.append(end)
    return found
