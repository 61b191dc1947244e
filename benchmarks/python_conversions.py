# SPDX-License-Identifier: MIT
"""What Python adds to the C++ of a call: a million rows against build/release/benchmarks/
bench_batch_conversions, one row, and the import. Prints docs/accuracy/python.md.

Run as: PYTHONPATH=build/release/python .venv/bin/python benchmarks/python_conversions.py > PAGE
"""

from __future__ import annotations

import json
import platform
import subprocess
import sys
import time
import timeit
from pathlib import Path

import numpy as np
import polhode

ROOT = Path(__file__).resolve().parents[1]
BENCH = ROOT / "build/release/benchmarks/bench_batch_conversions"
ROWS = 1_000_000
ROUNDS = 5


def cpp_times() -> dict[str, float]:
    """Least time of each call in milliseconds, as the C++ program measures it now."""
    done = subprocess.run(
        [BENCH, "--benchmark_format=json", "--benchmark_min_time=0.5"],
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True)
    return {b["name"]: b["real_time"] for b in json.loads(done.stdout)["benchmarks"]}


def million_calls() -> dict:
    body = polhode.Body(1.0, 1.7, 2.1)
    motion = polhode.FreeRotation(
        body, polhode.RotorState([0.9, 0.1, -0.3, 0.2], [0.2, 0.4, 0.89]))
    t = np.linspace(0.0, 1e4, ROWS)
    s = motion.at(t)
    andoyer, euler = polhode.to_andoyer(s), polhode.to_euler(s)
    return {
        "FreeRotation.at": lambda: motion.at(t),
        "FreeRotation.at_grid": lambda: motion.at_grid(0.0, 0.01, ROWS),
        "to_andoyer": lambda: polhode.to_andoyer(s),
        "to_rotor(AndoyerState)": lambda: polhode.to_rotor(andoyer),
        "to_euler": lambda: polhode.to_euler(s),
        "to_rotor(EulerState)": lambda: polhode.to_rotor(euler),
        "to_sadov": lambda: polhode.to_sadov(body, s),
        "nearest_poincare": lambda: polhode.charts.nearest_poincare(s),
        "kinetic_energy": lambda: polhode.kinetic_energy(body, s),
    }


def milliseconds(call) -> float:
    start = time.perf_counter()
    call()
    return 1e3 * (time.perf_counter() - start)


def scalar_times() -> dict[str, float]:
    """Microseconds of one call for one state."""
    body = polhode.Body(1.0, 1.7, 2.1)
    s = polhode.RotorState([1.0, 0.0, 0.0, 0.0], [0.2, 0.4, 0.89])
    motion = polhode.FreeRotation(body, s)
    a, q, g = polhode.to_andoyer(s), np.array([1.0, 0, 0, 0]), np.array([0.2, 0.4, 0.89])
    calls = {
        "to_andoyer(s)": lambda: polhode.to_andoyer(s),
        "to_rotor(a)": lambda: polhode.to_rotor(a),
        "motion.at(1.0)": lambda: motion.at(1.0),
        "a.G": lambda: a.G,
        "s.q": lambda: s.q,
        "RotorState(q, g)": lambda: polhode.RotorState(q, g),
        "AndoyerState(0.1, 0.2, 0.3, 0.5, 1.0, 0.2)":
            lambda: polhode.AndoyerState(0.1, 0.2, 0.3, 0.5, 1.0, 0.2),
        "kinetic_energy(body, s)": lambda: polhode.kinetic_energy(body, s),
        "angular_velocity(body, s)": lambda: polhode.angular_velocity(body, s),
    }
    return {name: sorted(timeit.repeat(call, number=20_000, repeat=5))[0] / 20_000 * 1e6
            for name, call in calls.items()}


def import_seconds(statement: str) -> float:
    """Least wall time of a fresh interpreter that runs the statement."""
    def once() -> float:
        start = time.perf_counter()
        subprocess.run([sys.executable, "-c", statement], check=True)
        return time.perf_counter() - start

    return min(once() for _ in range(10))  # NaN: none among times


def compared(calls: dict) -> dict[str, tuple[float, float]]:
    """Milliseconds of C++ and of Python, taken in turns: both see the machine in the same mood."""
    cpp = {name: float("inf") for name in calls}
    python = dict(cpp)
    for _ in range(ROUNDS):
        for name, value in cpp_times().items():
            cpp[name] = min(cpp[name], value)  # NaN: none among times
        for name, call in calls.items():
            taken = (milliseconds(call) for _ in range(5))
            python[name] = min(python[name], *taken)  # NaN: none among times
    return {name: (cpp[name], python[name]) for name in calls}


PAGE = """# Speed of the Python package

`benchmarks/python_conversions.py` measured this and wrote the page: least times on a virtual
machine with two cores, Python {python}, NumPy {numpy}. Both columns allocate what they return;
the C++ is `benchmarks/batch_conversions.cpp`, compiled alike.

| a million rows | C++ | Python | more |
|---|---|---|---|
{million}

| one state | Python |
|---|---|
{scalar}

`import polhode` takes {more:.2f} s more than `import numpy` ({numpy_import:.2f} s); apart from
NumPy it imports only tomlkit. What is behind the numbers is in
[the design of the package](../design/0006-python.md).
"""


def main() -> None:
    million = [f"| `{name}` | {c:.1f} ms | {p:.1f} ms | {100 * (p / c - 1):+.0f} % |"
               for name, (c, p) in compared(million_calls()).items()]
    scalar = [f"| `{name}` | {value:.2f} us |" for name, value in scalar_times().items()]
    numpy_import = import_seconds("import numpy")
    both = import_seconds("import numpy, polhode")
    more = max(0.0, both - numpy_import)  # NaN: none among times
    print(PAGE.format(
        python=platform.python_version(), numpy=np.__version__, million="\n".join(million),
        scalar="\n".join(scalar), numpy_import=numpy_import,
        more=more), end="")


if __name__ == "__main__":
    main()
