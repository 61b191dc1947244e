# SPDX-License-Identifier: MIT
"""Lines of JSON that are appended as they come and read again after the program was killed."""

import concurrent.futures
import json
import threading

_LOCK = threading.Lock()


def read(path):
    """All whole lines."""
    found = []
    for line in path.read_text().splitlines() if path.exists() else []:
        try:
            found.append(json.loads(line))
        except ValueError:
            continue  # at which it was killed
    return found


def append(path, record):
    with _LOCK, path.open("a+b") as file:
        if file.tell() > 0:
            file.seek(-1, 2)
            if file.read(1) != b"\n":
                file.write(b"\n")
        file.write(json.dumps(record).encode() + b"\n")


def each(work, tasks, jobs):
    """[work(task)] by some threads. The first exception ends it, once what runs has ended."""
    pool = concurrent.futures.ThreadPoolExecutor(jobs)
    try:
        return list(pool.map(work, tasks))
    finally:
        pool.shutdown(cancel_futures=True)
