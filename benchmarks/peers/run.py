# SPDX-License-Identifier: MIT
"""`make bench-peers`: polhode beside its peers, time and error in one run.

Writes build/bench/peers.json (a list of records), measured.json (every median and its error, with
or without a peer), machine.json, curves.json. A peer that is not here is reported as missing, and
the run goes on.
"""

import argparse
import pathlib
import shlex
import statistics
import sys
import time

import bodies
import energy
import ensembles
import envisat
import machine
import mars
import native
import obliquity
import orbits
import perturbed
import steps
import torque_free
from records import faults, matched, record, write

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ROOT / "build/release/benchmarks/peers"
# What polhode uses unless told otherwise, and what it has for many bodies together.
DEFAULT = "polhode Collocation, default"
TOGETHER = ("polhode integrate_many", "polhode spin_histories")


# What the issue of peers names and no driver of ours measures, and why.
NOT_MEASURED = (
    "snvec, VPLanet, GRIT, FRB (in no registry)",
    "pyerfa (the nutation of the real Earth is ERFA's own function in polhode, too)")


class Report:
    def __init__(self, options):
        self.options = options
        self.revision = machine.revision(ROOT)
        self.records, self.measured, self.curves = [], [], {}
        self.missing = [*NOT_MEASURED]

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
        self._lines(native.lines_of(path, *arguments), command)

    def bodies(self):
        self._lines(bodies.measured(self.options, PROGRAMS / "peers_errors", self.miss))

    def torque_free(self):
        self._lines(torque_free.measured(self.options, PROGRAMS / "peers_errors", self.miss))

    def _lines(self, lines, command=None):
        self.records += native.paired(lines, command or self._again(), self.revision, self.miss)
        self.measured += [
            {"goal": s["goal"], "case": s["case"], "who": s["who"], "unit": s["unit"],
             "value": statistics.median(s["repetitions"]), "error": s["error"]}
            for s in lines if "missing" not in s]

    def perturbed(self):
        curve, compilation, spread = perturbed.measured(self.options, self.miss)
        self.curves["W1"] = {"points": curve, "compilation": compilation, "variants": spread}
        self._points("G9", "W1, tolerance", curve)
        for goal, case, points in self._spread(spread):
            self._points(goal, f"{case}, tolerance", points)

    def orbits(self):
        for name, points in orbits.measured(self.options, self.miss).items():
            self.curves[name] = {"points": points, "compilation": {}}
            self._points("G9", f"{name}, tolerance", points)

    def obliquity(self):
        points = obliquity.measured(self.options, self.miss)
        self.curves["The spin axis over 100 Myr"] = {
            "points": points, "compilation": {}, "unit": "CPU time (s) for a Myr"}
        self._points("G11", "tolerance", points)

    def envisat(self):
        points = envisat.measured(self.options, self.miss)
        self.curves["Envisat, a year"] = {"points": points, "compilation": {}}
        self._points("G14", "Envisat, a year, tolerance", points)

    def ensembles(self):
        points = ensembles.measured(self.options, self.miss)
        self._points("ensemble", f"{ensembles.MEMBERS} variants of W1, tolerance", points)

    def steps(self):
        points = steps.measured(self.options, PROGRAMS / "peers_errors", self.miss)
        self.curves["Free rotation over 100 turns"] = {"points": points, "compilation": {}}
        self._points("steps", "100 turns, step", points)

    def alone(self):
        """What no peer does in any time."""
        self._points("G15", "Mars, unaveraged, a million years", mars.measured(self.options))
        self._points("energy", "a million turns", energy.measured(self.options))

    def _points(self, goal, case, points):
        self.measured += [{"goal": goal, "case": case, "who": f"{p['who']}, {p['setting']}",
                           "unit": "s", "value": p["seconds"], "error": p["error"],
                           "largest": p.get("largest")} for p in points]
        ours = [{**p, "who": f"{p['who']}, {p['setting']}"} for p in points
                if p["who"].startswith("polhode")]
        for p in points:
            if not p["who"].startswith("polhode"):
                one = [o for o in ours
                       if "batch" in p["who"] or not o["who"].startswith(TOGETHER)]
                self._beside(goal, f"{case} {p['setting']}", one, p)

    def _beside(self, goal, case, ours, theirs):
        """Records of what polhode uses unless told otherwise, and of the match of the peer."""
        match = ours[matched([(p["seconds"], p["error"]) for p in ours], theirs["error"])]
        default = [p for p in ours if p["who"] == DEFAULT]
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
            errors = sorted(p["error"] for p in same)
            merged.append({**same[0], "error": statistics.median(errors), "largest": errors[-1],
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
        write(folder / "measured.json", self.measured)
        write(folder / "curves.json", self.curves)
        write(folder / "machine.json", {**machine.description(), "revision": self.revision,
                                        "missing": self.missing, "command": self._again()})
        return found


def programs(report):
    report.program("peers_free_rotation")
    report.program("peers_bodies")
    report.program("peers_elliptic")
    report.program("peers_output", str(report.options.folder))


PARTS = {"native": programs, "bodies": Report.bodies, "perturbed": Report.perturbed,
         "orbits": Report.orbits, "obliquity": Report.obliquity, "envisat": Report.envisat,
         "ensembles": Report.ensembles, "steps": Report.steps, "java": Report.torque_free,
         "alone": Report.alone}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="draws bodies, times and variants")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--variants", type=int, default=8, help="of W1 (the issue's goal: 32)")
    parser.add_argument("--quick", action="store_true", help="W1 at the tightest settings alone")
    parser.add_argument("--only", default=",".join(PARTS), help="parts, with commas")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build/bench")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    report = Report(options)
    for part in options.only.split(","):
        begin = time.monotonic()
        PARTS[part](report)
        print(f"{part}: {time.monotonic() - begin:.0f} s", file=sys.stderr)
    found = report.save()
    print("\n".join(found), end="\n" if found else "", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
