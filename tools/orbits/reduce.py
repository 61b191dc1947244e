#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""From the sums of planets.c to data/orbits: elements every 1,000 years, without what is faster
than some 4,000 years.

    reduce.py PAST FUTURE OUT_FOLDER      (needs numpy)

OUT_FOLDER gets earth.i32 and mars.i32, little-endian 32-bit integers, four in a row: the number of
rows, the time of the first (kyr), the years between two, 0; then for every row k, h, q, p
(polhode/secular/orbit_history.hpp) in units of 1e-9. FUTURE - leaves the future out: rows end
before 0."""

import pathlib
import sys

import numpy

WINDOW = 400.0  # years: half-width of the weights of planets.c
SPACING = 100.0  # of its sums
CADENCE = 10  # sums a row
FARTHEST = 200_000  # sums: 20 Myr
TAPS = 110  # of the second filter, on either side
CUTOFF = 1 / 4000.0  # per year
KAISER = 10.0


def sums(path):
    return {int(row[0]): row[1:] for row in numpy.loadtxt(path) if row[1] > 0}


def joined(past, future):
    """The elements every 100 years, by their number from t = 0."""
    total = {-j: row.copy() for j, row in sums(past).items()}
    for j, row in (sums(future) if future != "-" else {}).items():
        total[j] = total.get(j, 0) + row
    numbers = numpy.array(sorted(total))
    rows = numpy.array([total[j] for j in numbers])
    return numbers, rows[:, 1:] / rows[:, :1]


def second_filter():
    """Low-pass, and what the first one takes from long periods given back."""
    lag = numpy.arange(-TAPS, TAPS + 1)
    taps = numpy.sinc(2 * CUTOFF * SPACING * lag) * numpy.kaiser(2 * TAPS + 1, KAISER)
    taps /= taps.sum()
    tau = numpy.linspace(-1, 1, 100001)
    weight = numpy.cos(0.5 * numpy.pi * tau) ** 4
    variance = WINDOW**2 * (weight * tau**2).sum() / weight.sum()
    sharper = numpy.array([-1.0, 2.0, -1.0]) * 0.5 * variance / SPACING**2
    sharper[1] += 1.0
    return numpy.convolve(taps, sharper)


def main():
    past, future, out = sys.argv[1:]
    numbers, elements = joined(past, future)
    taps = second_filter()
    reach = len(taps) // 2
    first = max(-((-numbers[0] - reach) // CADENCE) * CADENCE, -FARTHEST)
    last = min(((numbers[-1] - reach) // CADENCE) * CADENCE, FARTHEST)
    kept = range(first, last + 1, CADENCE)
    for name, start in (("earth", 1), ("mars", 6)):
        of = elements[:, start : start + 4]
        smooth = [
            taps @ of[j - numbers[0] - reach : j - numbers[0] + reach + 1] for j in kept
        ]
        path = pathlib.Path(out) / f"{name}.i32"
        head = [len(smooth), first // CADENCE, SPACING * CADENCE, 0]
        rows = numpy.vstack([head, numpy.round(numpy.array(smooth) * 1e9)])
        rows.astype("<i4").tofile(path)
        print(f"{path}: {len(smooth)} rows, {first * SPACING:.0f} to {last * SPACING:.0f} years")


if __name__ == "__main__":
    main()
