# SPDX-License-Identifier: MIT
"""Runs that are killed at random moments and continued, until they are complete."""

import pathlib
import random
import signal
import subprocess
import time

SCENARIO = """schema = 1
title = "A body that is killed"
[body]
moments = [1, 2, 2.5]
[state.attitude-rate]
quaternion = [1, 0, 0, 0]
omega_body = [0.1, 0.2, 1]
[[perturbation]]
kind = "damping"
coefficients = [1e-9, 1e-9, 1e-9]
[[event]]
column = "qw"
value = 0.3
[time]
stop = {stop}
step = 0.1
[output]
columns = ["q", "omega", "g", "andoyer"]
"""


def command(polhode, scenario, folder, *options):
    return [str(polhode), "run", str(scenario), "--out", str(folder / "a.csv"),
            "--out", str(folder / "a.h5"), "--events", str(folder / "events.csv"), *options]


def straight_run(polhode, scenario, folder):
    """The run that is never stopped; its seconds."""
    begun = time.monotonic()
    subprocess.run(command(polhode, scenario, folder), check=True, capture_output=True)
    return time.monotonic() - begun


def changed(path):
    """When, in nanoseconds; never, of a file that has just been renamed."""
    try:
        return path.stat().st_mtime_ns
    except FileNotFoundError:
        return 0


def wait_for_writing(process, folder, begun):
    """Until the process has written a file of the folder, or has ended."""
    while process.poll() is None and all(changed(path) < begun for path in folder.iterdir()):
        time.sleep(0.001)


def killed_run(polhode, scenario, folder, kills, seed, seconds):
    """Kills the run at `kills` random moments, each at most `seconds` after its start, or, every
    second time, after it has begun to write: the command of a wheel starts an interpreter first,
    which takes long on a busy machine. Continues it after each; then lets it end. What each start
    said on standard error, and how many of them were really killed, not complete before."""
    draw = random.Random(seed)
    said, killed = [], 0
    for number in range(kills + 1):
        begun = time.time_ns()
        process = subprocess.Popen(
            command(polhode, scenario, folder, "--resume", "--checkpoint", "0"),
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if number < kills:
            if number % 2 == 1:
                wait_for_writing(process, folder, begun)
            try:
                process.wait(draw.uniform(0.0, seconds))
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
        said.append(process.communicate()[1])
        killed += process.returncode == -signal.SIGKILL
        if process.returncode not in (0, -signal.SIGKILL):
            raise AssertionError(f"kill {number}: {process.returncode}: {said[-1]}")
    return said, killed


def differences(a: pathlib.Path, b: pathlib.Path):
    """What differs between the files of two runs: nothing, or their names."""
    found = [name for name in ("a.csv", "events.csv")
             if (a / name).read_bytes() != (b / name).read_bytes()]
    compared = subprocess.run(["h5diff", "--verbose", a / "a.h5", b / "a.h5"], capture_output=True,
                              text=True)
    if compared.returncode != 0:
        found.append("a.h5: " + compared.stdout + compared.stderr)
    found += [path.name for path in b.iterdir() if path.name not in {p.name for p in a.iterdir()}]
    return found
