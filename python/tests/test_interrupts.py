# SPDX-License-Identifier: MIT
"""Tests of Ctrl-C send it into their own call, however busy the machine is, and nowhere else."""

import threading
import time

import interrupts
import pytest
from interrupts import grows, seconds_from_signal


def test_a_call_is_interrupted_when_it_has_begun():
    begun = threading.Event()

    def late():
        time.sleep(0.3)
        begun.set()
        end = time.perf_counter() + 60
        while time.perf_counter() < end:
            time.sleep(0.01)  # one long sleep would not see a signal that a thread raises

    assert 0 <= seconds_from_signal(late, begun.is_set) < 30
    assert begun.is_set()


def test_work_after_the_signal_is_counted_and_waiting_has_an_end(monkeypatch):
    def served_late(rest):
        try:
            end = time.perf_counter() + 60
            while time.perf_counter() < end:
                time.sleep(0.01)
        except KeyboardInterrupt:
            rest()
            raise

    def work():
        end = time.process_time() + 0.2
        while time.process_time() < end:
            pass

    assert seconds_from_signal(lambda: served_late(work)) >= 0.2
    monkeypatch.setattr(interrupts, "LONGEST", 0.2)
    with pytest.raises(AssertionError, match="s from Ctrl-C to the exception"):
        seconds_from_signal(lambda: served_late(lambda: time.sleep(0.3)))


@pytest.mark.parametrize("seconds", [0.0, 0.2])
def test_a_call_that_ends_too_early_is_reported(seconds):
    with pytest.raises(AssertionError, match="the call ended before Ctrl-C"):
        seconds_from_signal(lambda: time.sleep(seconds), lambda: False)


def test_no_signal_comes_after_a_call_that_failed():
    def fails():
        raise ValueError("this")

    with pytest.raises(ValueError, match="this"):
        seconds_from_signal(fails)
    time.sleep(0.2)


def test_a_file_grows(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(b"1" * 1000)
    grown = grows(path)
    path.write_bytes(b"1" * 300_000)
    assert not grown()
    path.write_bytes(b"1" * 301_001)
    assert grown()
