# SPDX-License-Identifier: MIT
"""Cells of a map or an ensemble on the workers of an executor: processes, mpi4py.futures, Dask.

A task is some cells in a row, and all that a worker must know to compute them; what they give is
taken in their order, so that it does not matter who computes which."""

from __future__ import annotations

import os
import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Executor, Future, wait
from typing import Any

from polhode import _core, _toml

WAITING = 4
"""Tasks for each worker that may wait for an earlier one."""
LOOKS = 0.05
"""Seconds between two looks whether the work was stopped."""
SHORT, MOST = 0.05, 64
"""A task that took fewer seconds is followed by ones of twice as many cells, up to so many."""

_worker = threading.local()


def cells(
    kind: str, text: str, path: str, any_machine: bool, stage: bytes, begin: int, end: int
) -> tuple[float, list[bytes]]:
    """In a worker: cells begin to end - 1 of a stage of the map or ensemble of a text, and the
    seconds that they took. The one that was last asked for stays."""
    started = time.perf_counter()
    of = (kind, text, path, any_machine)
    if getattr(_worker, "of", None) == of and _worker.stage != stage:
        try:
            _worker.work.begin(stage)
            _worker.stage = stage
        except ValueError:  # a file that it names has changed since
            _worker.of = None
    if getattr(_worker, "of", None) != of:
        _worker.of = None
        scenario = _core._Scenario.from_text(text.encode("utf-8"), path, _toml.known_kinds())
        work = (scenario.map_work if kind == "map" else scenario.ensemble_work)(any_machine)
        work.begin(stage)
        _worker.work, _worker.stage, _worker.of = work, stage, of
    found = [_worker.work.cell(index) for index in range(begin, end)]
    return time.perf_counter() - started, found


def stage_runner(kind: str, executor: Any, file: Any, any_machine: bool) -> Callable[..., None]:
    """The function that runs a stage of the "map" or "ensemble" of a scenario on an executor."""
    if not isinstance(executor, Executor):
        raise TypeError(
            f"{kind}: executor: got {executor!r}; expected a concurrent.futures.Executor, such "
            "as ProcessPoolExecutor, MPIPoolExecutor of mpi4py, or client.get_executor() of Dask"
        )
    text, path, name = file.text, file.path, file.name
    cell = "cell" if kind == "map" else "chunk"

    def run(
        stage: bytes,
        first: int,
        count: int,
        take: Callable[[int, bytes], bool],
        is_stopped: Callable[[], bool],
    ) -> None:
        most = WAITING * _workers(executor)
        waiting: deque[tuple[int, int, Future[Any]]] = deque()
        following, each = first, 1
        try:
            while following < count or waiting:
                if is_stopped():
                    return
                while following < count and len(waiting) < most:
                    end = min(following + each, count)
                    task = executor.submit(
                        cells, kind, text, path, any_machine, stage, following, end
                    )
                    waiting.append((following, end, task))
                    following = end
                begin, end, task = waiting[0]
                if not wait((task,), LOOKS).done:
                    continue
                seconds, found = task.result()
                waiting.popleft()
                if not all(take(index, part) for index, part in zip(range(begin, end), found)):
                    return
                if seconds < SHORT and end - begin == each:
                    each = min(2 * each, MOST)
        except Exception as error:
            at = f"from {cell} {waiting[0][0]} on" if waiting else f"at {cell} {following}"
            raise RuntimeError(
                f"{name}: a worker of the executor failed, {at}: {type(error).__name__}: {error}"
            ) from error
        finally:
            for _, _, task in waiting:
                task.cancel()

    return run


def _workers(executor: Any) -> int:
    """How many tasks it runs at a time, as far as it says it."""
    for name in ("num_workers", "_max_workers"):  # of mpi4py; of the standard library
        number = getattr(executor, name, None)
        if isinstance(number, int) and number > 0:
            return number
    client = getattr(executor, "_client", None)  # of Dask
    return sum(client.ncores().values()) if client is not None else os.cpu_count() or 1
