#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""W1 by heyoka (Taylor series, compiled for the processor), for comparison: pip install heyoka.

Writes one JSON list of rows {name, cpu_time, error, steps}; the seconds of compilation are apart.
State: q, omega, position and velocity of the orbit."""

import json
import time

import heyoka
import numpy

# By heyoka itself in 80 bits at tolerance 1e-19, from omega = (5, 4, 7.5) exactly.
END = numpy.array([-0.945141005522927046, 0.146971342462726509, -0.006995745105808708,
                   -0.291648699164300929])
STOP = 6283.185307179586
MOMENTS = (0.9, 1.0, 1.1)


def equations():
    w, x, y, z, a, b, c, px, py, vx, vy = heyoka.make_vars(
        "w", "x", "y", "z", "a", "b", "c", "px", "py", "vx", "vy")
    r2 = px * px + py * py
    attraction, k = r2**-1.5, 3.0 * r2**-2.5
    nx = (1.0 - 2.0 * (y * y + z * z)) * px + 2.0 * (x * y + w * z) * py
    ny = 2.0 * (x * y - w * z) * px + (1.0 - 2.0 * (x * x + z * z)) * py
    nz = 2.0 * (x * z + w * y) * px + 2.0 * (y * z - w * x) * py
    I1, I2, I3 = MOMENTS
    return [(w, 0.5 * (-x * a - y * b - z * c)), (x, 0.5 * (w * a + y * c - z * b)),
            (y, 0.5 * (w * b - x * c + z * a)), (z, 0.5 * (w * c + x * b - y * a)),
            (a, (I2 - I3) * (b * c - k * ny * nz) / I1),
            (b, (I3 - I1) * (c * a - k * nz * nx) / I2),
            (c, (I1 - I2) * (a * b - k * nx * ny) / I3),
            (px, vx), (py, vy), (vx, -attraction * px), (vy, -attraction * py)]


def main():
    rows = []
    for tolerance in (1e-9, 1e-11, 1e-13, 1e-14, 1e-15, 1e-16):
        start = [1.0, 0.0, 0.0, 0.0, 5.0, 4.0, 7.5, 0.9, 0.0, 0.0, (1.1 / 0.9) ** 0.5]
        begun = time.process_time()
        solver = heyoka.taylor_adaptive(equations(), start, tol=tolerance)
        compiled = time.process_time()
        steps = solver.propagate_until(STOP)[3]
        seconds = time.process_time() - compiled
        q = solver.state[:4] / numpy.linalg.norm(solver.state[:4])
        q *= numpy.sign(q @ END)
        rows.append({"name": f"heyoka {heyoka.__version__}/{tolerance:g}", "cpu_time": seconds,
                     "error": 4.0 * float(numpy.arcsin(numpy.linalg.norm(q - END) / 2.0)),
                     "steps": steps, "compilation": compiled - begun})
    print(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
