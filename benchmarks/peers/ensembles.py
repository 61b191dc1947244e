# SPDX-License-Identifier: MIT
"""Ensembles: 64 variants of W1 at rates that differ by up to 1e-3, each to its end, as users run
them: `polhode ensemble` of a table of draws, heyoka's ensembles of its integrator and of its batch,
a loop over SciPy. Time is that of a member, on one thread, reading and writing included (heyoka's
compilation is not); the error is the median over some of the members, of which the ends are known
in 80 bits.
"""

import pathlib
import statistics
import subprocess

import equations
import numpy as np
import perturbed
from perturbed import ECCENTRICITY, STOP
from timing import Contender, interleaved

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build/release/polhode"
W1 = ROOT / "examples/gravity-gradient-w1.toml"
MEMBERS, KNOWN = 64, 8
TOLERANCES = (1e-15, 2.2e-16)
ENSEMBLE = """
[ensemble]
size = {size}
keep = "final"
[[ensemble.vary]]
kind = "table"
keys = ["state.attitude-rate.omega_body"]
file = "rates.csv"
"""


def polhode_contenders(cases, folder):
    """The program, from the start of its process to its end."""
    folder.mkdir(parents=True, exist_ok=True)
    names = ",".join(f"w{k}" for k in (1, 2, 3))
    (folder / "rates.csv").write_text("\n".join(
        [names, *(",".join(map(repr, case.rates)) for case in cases)]) + "\n")
    (folder / "w1.toml").write_text(W1.read_text() + ENSEMBLE.format(size=len(cases)))
    out = folder / "ends.csv"
    same = [PROGRAM, "ensemble", folder / "w1.toml", "--threads", "1", "--restart",
            "--set", "time.count=2", "--set", 'output.columns=["q"]', "--out", out]

    def run(*more):
        def once():
            subprocess.run([*same, *more], check=True, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)
            lines = [line for line in out.read_text().splitlines() if not line.startswith("#")]
            place = lines[0].split(",").index("qw")
            return len(cases), [np.array([float(x) for x in line.split(",")[place:place + 4]])
                                for line in lines[1:]]
        return once

    def tolerance(t):
        return run("--set", 'method.kind="collocation"', "--set", f"method.tolerance={t:g}")

    return [Contender("polhode ensemble", "default", run()),
            *(Contender("polhode ensemble", f"{t:g}", tolerance(t)) for t in (1e-10, 1e-11))]


def heyoka_contenders(heyoka, cases):
    made = perturbed.Heyoka(heyoka, TOLERANCES)
    starts = [np.array(equations.start(case.rates, ECCENTRICITY)) for case in cases]
    lanes = perturbed.LANES

    def place(taylor, k):
        taylor.time = 0.0
        taylor.state[:] = starts[k]
        return taylor

    def place_batch(taylor, k):
        taylor.set_time(np.zeros(lanes))
        taylor.state[:] = np.array(starts[lanes * k:lanes * (k + 1)]).T
        return taylor

    def scalar(tolerance):
        def once():
            found = heyoka.ensemble_propagate_until(made.scalar[tolerance], STOP, len(starts),
                                                    place, max_workers=1)
            return len(starts), [one[0].state[:4].copy() for one in found]
        return once

    def batch(tolerance):
        def once():
            found = heyoka.ensemble_propagate_until_batch(
                made.batch[tolerance], STOP, len(starts) // lanes, place_batch, max_workers=1)
            return len(starts), [q.copy() for one in found for q in one[0].state[:4].T]
        return once

    return [Contender(f"heyoka ensemble_propagate_until{more}", f"{t:g}", make(t))
            for t in TOLERANCES for more, make in (("", scalar), ("_batch", batch))]


def scipy_contender(cases):
    """A member, by what W1 is measured with; its error is that of one end, too."""
    contender = perturbed.scipy_contenders(cases[0])[0]

    def once():
        members, end = contender.run()
        return members, [end]
    return Contender("SciPy DOP853, a loop", contender.setting, once, once=True)


def measured(options, missing):
    try:
        import heyoka
    except ImportError:
        missing("heyoka (and with it the references of ensembles)")
        return []
    if not PROGRAM.exists():
        missing("ensembles (polhode is not built)")
        return []
    cases = perturbed.cases(MEMBERS, options.seed)[1:]
    contenders = [*polhode_contenders(cases, options.folder / "ensemble"),
                  *heyoka_contenders(heyoka, cases)]
    try:
        import scipy  # noqa: F401
        contenders += [] if options.quick else [scipy_contender(cases)]
    except ImportError:
        missing("SciPy")
    references = perturbed.References(heyoka)
    exact = [references.of(case) for case in cases[:KNOWN]]
    found = []
    for t in interleaved(contenders, options.repetitions):
        side = "polhode" if t.who.startswith("polhode") else "peers"
        errors = sorted(equations.angle(end, ends[side])
                        for end, ends in zip(t.ends[0], exact, strict=False))
        found.append({"who": t.who, "setting": t.setting, "seconds": t.median,
                      "repetitions": t.seconds, "error": statistics.median(errors),
                      "largest": errors[-1]})
    return found
