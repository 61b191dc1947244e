# SPDX-License-Identifier: MIT
"""`make bench-peers`: polhode beside its peers, time and error in one run.

Writes build/bench/peers.json (a list of records), machine.json, curves.json. A peer that is not
here is reported as missing, and the run goes on.
"""

import argparse
import pathlib
import shlex
import statistics
import sys

import machine
import native
import obliquity
import orbits
import perturbed
import steps
import torque_free
from records import faults, matched, record, write

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ROOT / "build/release/benchmarks/peers"
DEFAULTS = ("polhode Adaptive, 1e-15", "polhode Collocation, default")


# What the issue of peers names and no driver of ours measures, and why.
NOT_MEASURED = (
    "snvec, VPLanet, GRIT, FRB (in no registry)",
    "pyerfa (the nutation of the real Earth is ERFA's own function in polhode, too)")


class Report:
    def __init__(self, options):
        self.options = options
        self.revision = machine.revision(ROOT)
        self.records, self.missing, self.curves = [], [*NOT_MEASURED], {}

    def miss(self, who):
        if who not in self.missing:
            print(f"missing: {who}", file=sys.stderr)
            self.missing.append(who)

    def program(self, name, *more):
        path = PROGRAMS / name
        if not path.exists():
            self.miss(f"{name} (not built)")
            return
        arguments = (self.options.seed, self.options.repetitions, *more)
        command = shlex.join([str(path.relative_to(ROOT)), *map(str, arguments)])
        lines = native.lines_of(path, *arguments)
        self.records += native.paired(lines, command, self.revision, self.miss)

    def perturbed(self):
        curve, compilation, spread = perturbed.measured(self.options, self.miss)
        self.curves["W1"] = {"points": curve, "compilation": compilation, "variants": spread}
        for goal, case, points in [("G9", "W1", curve), *self._spread(spread)]:
            ours = [{**p, "who": f"{p['who']}, {p['setting']}"} for p in points
                    if p["who"].startswith("polhode")]
            for p in points:
                if not p["who"].startswith("polhode"):
                    self._beside(goal, f"{case}, tolerance {p['setting']}", ours, p)

    def orbits(self):
        for name, points in orbits.measured(self.options, self.miss).items():
            self.curves[name] = {"points": points, "compilation": {}}
            ours = [{**p, "who": f"{p['who']}, {p['setting']}"} for p in points
                    if p["who"].startswith("polhode")]
            for p in points:
                if not p["who"].startswith("polhode"):
                    self._beside("G9", f"{name}, tolerance {p['setting']}", ours, p)

    def obliquity(self):
        points = obliquity.measured(self.options, self.miss)
        if not points:
            return
        self.curves["The spin axis over 20 Myr"] = {
            "points": points, "compilation": {}, "unit": "CPU time (s) for a Myr"}
        ours = [{**p, "who": f"{p['who']}, {p['setting']}"} for p in points
                if p["who"].startswith("polhode")]
        for p in points:
            if not p["who"].startswith("polhode"):
                self._beside("G11", f"tolerance {p['setting']}", ours, p)

    def steps(self):
        points = steps.measured(self.options, PROGRAMS / "peers_errors", self.miss)
        if not points:
            return
        self.curves["Free rotation over 100 turns"] = {"points": points, "compilation": {}}
        ours = [{**p, "who": f"{p['who']}, {p['setting']}"} for p in points
                if p["who"].startswith("polhode")]
        for p in points:
            if not p["who"].startswith("polhode"):
                self._beside("steps", f"100 turns, step {p['setting']}", ours, p)

    def torque_free(self):
        lines = torque_free.measured(self.options, PROGRAMS / "peers_errors", self.miss)
        self.records += native.paired(lines, self._again(), self.revision, self.miss)

    def _beside(self, goal, case, ours, theirs):
        """Records of what polhode uses unless told otherwise, at its tightest, and of its match."""
        match = ours[matched([(p["seconds"], p["error"]) for p in ours], theirs["error"])]
        default = [p for p in ours if p["who"] in DEFAULTS][-1:]
        for mine in [match, *(p for p in default if p is not match)]:
            self.records.append(record(goal, case, mine, theirs, "s", command=self._again(),
                                       revision=self.revision))

    @staticmethod
    def _spread(spread):
        """A point for each contender: the median error, and all repetitions, over variants."""
        if not spread:
            return []
        merged = []
        for same in zip(*spread, strict=True):
            merged.append({**same[0], "error": statistics.median(p["error"] for p in same),
                           "seconds": statistics.median(p["seconds"] for p in same),
                           "repetitions": [s for p in same for s in p["repetitions"]]})
        return [("G10", f"{len(spread)} variants of W1, median error", merged)]

    def _again(self):
        o = self.options
        return f"make bench-peers SEED={o.seed} REPETITIONS={o.repetitions} VARIANTS={o.variants}"

    def save(self):
        found = faults(self.records)
        folder = self.options.folder
        write(folder / "peers.json", self.records)
        write(folder / "curves.json", self.curves)
        write(folder / "machine.json", {**machine.description(), "revision": self.revision,
                                        "missing": self.missing, "command": self._again()})
        return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="draws bodies, times and variants")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--variants", type=int, default=8, help="of W1 (the issue's goal: 32)")
    parser.add_argument("--quick", action="store_true", help="W1 at the tightest settings alone")
    parser.add_argument("--only", default="native,perturbed,orbits,obliquity,steps,java",
                        help="parts, with commas")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build/bench")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    report = Report(options)
    parts = options.only.split(",")
    if "native" in parts:
        report.program("peers_free_rotation")
        report.program("peers_elliptic")
        report.program("peers_output", str(options.folder))
    if "perturbed" in parts:
        report.perturbed()
    if "orbits" in parts:
        report.orbits()
    if "obliquity" in parts:
        report.obliquity()
    if "steps" in parts:
        report.steps()
    if "java" in parts:
        report.torque_free()
    found = report.save()
    print("\n".join(found), end="\n" if found else "", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
