# SPDX-License-Identifier: MIT
"""How far the attitudes of Toutatis in 1992 reach: errors that their fit predicts, and by how much
states miss what was seen until 2008."""

import csv
import pathlib

import matplotlib.pyplot as plt
import numpy as np
import polhode
from polhode import figures

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
EPOCH = np.datetime64("1992-11-09T17:49:47")
PRIOR = """
[[free.prior]]
kind = "attitude"
euler_sigmas = [15, 15, 15]
[[free.prior]]
kind = "rate"
sigmas = [0.1, 0.1, 0.1]
[[free.prior]]
kind = "moments"
sigmas = [0.1, 0.1]
"""


def attitude(alpha, beta, gamma):
    """Of 3-1-3 Euler angles in deg."""
    a, b, c = np.radians([alpha, beta, gamma]) / 2.0
    return [np.cos(b) * np.cos(a + c), np.sin(b) * np.cos(a - c), np.sin(b) * np.sin(a - c),
            np.cos(b) * np.sin(a + c)]  # fmt: skip


def misses(state, t, q):
    """In deg, of a state in free rotation."""
    turns = polhode.fit.SpinResiduals(state, polhode.fit.Snapshots(attitudes=(t, q, 1.0)))
    return np.degrees(np.linalg.norm(turns.residuals(turns.start).reshape(-1, 3), axis=1))


with (EXAMPLES / "toutatis-later.csv").open() as file:
    rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
days = (np.array([row["utc"] for row in rows], dtype="datetime64[s]") - EPOCH) / np.timedelta64(
    1, "D"
)
seen = np.array([attitude(*(float(row[k]) for k in ("alpha", "beta", "gamma"))) for row in rows])
published = polhode.fit.SpinState(
    attitude(145.498, 65.865, 241.524), np.radians([14.510, 33.529, -98.709]),
    [[3.0836, -7.1082e-4, 1.3252e-3], [-7.1082e-4, 3.235, 1.1707e-3],
     [1.3252e-3, 1.1707e-3, 1.0]],
)  # fmt: skip

text = (EXAMPLES / "toutatis-1992.toml").read_text()
grid = np.concatenate([np.arange(0.0, 45.0, 1.0), np.geomspace(45.0, 5860.0, 120)])
lines = []
for label, scenario in (
    ("1992 alone", polhode.load(EXAMPLES / "toutatis-1992.toml")),
    ("1992 and the prior", polhode.Scenario.from_text(text + PRIOR, EXAMPLES / "x.toml")),
):
    (best,) = polhode.fit.fit_scenario(scenario)
    ahead = best.predicted(grid)
    lines.append((label, np.sqrt(np.trace(ahead.scaled_covariance, axis1=1, axis2=2))))

with figures.style.style():
    figure, ax = plt.subplots(figsize=(figures.SINGLE_COLUMN, 2.6), layout="constrained")
    years = 1992.857 + grid / 365.25
    for k, (label, error) in enumerate(lines):
        ax.plot(years, error, label=f"predicted by {label}", **figures.series(k).line)
    ax.plot(1992.857 + days / 365.25, misses(published, days, seen), "o", ms=3.5, mfc="none",
            color="black", label="published state, free, off what was seen")  # fmt: skip
    ax.axhline(57.3, color="0.6", lw=0.8, zorder=0)
    ax.text(1998.3, 50.0, "1 rad", color="0.4", va="top", fontsize=7)
    ax.set_yscale("log")
    ax.set_xlim(1992.6, 2009.2)
    ax.set_xlabel("year")
    ax.set_ylabel("attitude (deg)")
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=1)
figures.save(figure, "toutatis-1992.png")
