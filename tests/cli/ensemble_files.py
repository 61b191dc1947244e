# SPDX-License-Identifier: MIT
"""Parts of scenarios with [ensemble], and what their outputs hold."""

import hashlib
import pathlib
import subprocess
import time

import h5py
import numpy
from slowdown import SLOWDOWN

SECONDS = 120 * SLOWDOWN

VARY = """
[[ensemble.vary]]
kind = "normal"
key = "state.attitude-rate.omega_body[2]"
sigma = 0.05
[[ensemble.vary]]
kind = "uniform"
key = "body.moments[1]"
low = 1.6
high = 2.2
[[ensemble.vary]]
kind = "attitude"
keys = ["state.attitude-rate.quaternion"]
"""
COLLOCATION = """
[method]
kind = "collocation"
tolerance = 1e-10
[[perturbation]]
kind = "constant-torque"
torque = [1e-4, 0, 2e-4]
"""
TORQUE = """
[[perturbation]]
kind = "constant-torque"
torque = [1e-4, 0, 2e-4]
"""


def rows_of(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    names = lines[0].split(",")
    numbers = numpy.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    return {name: numbers[:, k] for k, name in enumerate(names)}


def dimensions(path):
    """Names of the dimensions of each dataset of columns; each has a scale, as long as it is."""
    found = {}
    with h5py.File(path) as file:
        for name in file.attrs["groups"]:
            data = file[name]
            scales = [data] if data.is_scale else [dimension[0] for dimension in data.dims]
            assert tuple(map(len, scales)) == data.shape
            found[name] = tuple(scale.name[1:] for scale in scales)
    return found


def mark(path):
    """SHA-256 of what a file holds: of HDF5, of its datasets."""
    if path.suffix == ".csv":
        return hashlib.sha256(path.read_bytes()).hexdigest()
    digest = hashlib.sha256()
    with h5py.File(path) as file:
        file.visititems(lambda name, item: digest.update(name.encode() + item[()].tobytes())
                        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" else None)
    return digest.hexdigest()


def expect_other_sines_rejected(polhode, elsewhere, words, out):
    """Killed work goes on by `elsewhere`, a machine with other sines, only if it is told to.

    The first of the words is the command, which is also the name of the work."""
    process = subprocess.Popen([polhode, *words], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    wait_for_another(pathlib.Path(f"{out}.checkpoint"), b"", process)
    process.kill()
    process.wait()
    done = elsewhere(*words, "--resume")
    assert done.returncode == 2
    assert f"is of another {words[0]}: elementary functions of the machine was " in done.stderr
    assert "; --any-machine goes on with other last digits; " in done.stderr
    done = elsewhere(*words, "--resume", "--any-machine")
    assert done.returncode == 0 and "continues after " in done.stderr


def wait_for_another(checkpoint, before, process):
    """Until the checkpoint holds something else."""
    until = time.monotonic() + SECONDS
    while process.poll() is None and time.monotonic() < until and bytes_of(checkpoint) == before:
        time.sleep(0.01)
    assert bytes_of(checkpoint) != before


def bytes_of(path):
    return path.read_bytes() if path.exists() else b""
