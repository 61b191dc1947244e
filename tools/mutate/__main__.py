#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Mutation testing by schemata: `make mutate SEED=1 MUTANTS=400`. docs/design/0011-mutation.md"""

import argparse
import os
import pathlib
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from mutate import campaign, candidates, draw, equivalent, reach, report, tree  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(prog="tools/mutate", description=__doc__)
    parser.add_argument("--seed", default="1", help="of the draw (1)")
    parser.add_argument("--mutants", type=int, default=400, help="how many are drawn (400)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 2, help="cores (all)")
    parser.add_argument("--release", type=pathlib.Path, default=ROOT / "build/release",
                        help="the configured build whose flags are used (build/release)")
    parser.add_argument("--slowest", type=float, metavar="SECONDS",
                        help="leave out tests that take longer (none)")
    parser.add_argument("--programs", default=",".join(tree.TARGETS), metavar="NAME,NAME",
                        help="the test programs that are run (all)")
    parser.add_argument("--only", metavar="KEY,KEY", help="run these of the drawn mutants alone")
    parser.add_argument("--page", type=pathlib.Path,
                        help="also write the tables into this page (docs/accuracy/tests.md)")
    parser.add_argument("--list", action="store_true", help="only print the drawn mutants")
    chosen = parser.parse_args()
    if not 1 <= chosen.mutants <= 5000:
        parser.error(f"--mutants {chosen.mutants}: must be from 1 to 5000")
    chosen.programs = chosen.programs.split(",")
    for name in chosen.programs:
        if name not in tree.TARGETS:
            parser.error(f"--programs {name}: must be among {', '.join(tree.TARGETS)}")
    return chosen


def main():
    a = arguments()
    place = ROOT / "build/mutate"
    place.mkdir(parents=True, exist_ok=True)
    start = time.monotonic()

    def step(words):
        print(f"[{time.monotonic() - start:6.0f} s] {words}", flush=True)

    reasons = equivalent.entries(ROOT / "tools/mutate/equivalent.toml")
    everything = candidates.all_mutants(ROOT, a.release / "compile_commands.json",
                                        place / "candidates.json", a.jobs)
    mutants = draw.drawn(everything, a.seed, a.mutants)
    step(f"{len(mutants)} of {len(everything)} possible mutants drawn with seed {a.seed}")
    if a.list:
        for m in mutants:
            print(f"{m.key} {m.file}:{m.line} {m.operator}: {m.original}  ->  {m.mutated}")
        return 0
    state = candidates.fingerprint(ROOT, candidates.files_read(ROOT))
    if a.slowest is not None or len(a.programs) < len(tree.TARGETS):
        state += f" {' '.join(a.programs)}, tests of {a.slowest} s"
    built = tree.Tree(ROOT, place, a.release, a.programs, a.jobs)
    kept, dropped = built.made(mutants)
    step(f"built, {len(dropped)} do not compile")
    folder = built.build / "tests"
    tests = reach.recorded(folder, a.programs, place / "reach.jsonl", a.jobs, a.slowest)
    passed = [t for t in tests if not t.left_out]
    step(f"{len(passed)} tests pass without a mutant in {sum(t.seconds for t in passed):.0f} s; "
         f"{len(tests) - len(passed)} are left out")
    chosen = {n: m for n, m in kept.items() if not a.only or m.key in a.only.split(",")}
    results = campaign.run(folder, chosen, passed, place / "results.jsonl", state, a.jobs)
    parts = list(kept.values()), dropped, results, reasons, a.seed
    (place / "report.md").write_text(report.text(*parts))
    print("\n".join(report.summary(*parts)))
    if a.page:
        a.page.write_text(report.put_into(a.page.read_text(), report.summary(*parts)))
    step("build/mutate/report.md: every survivor")
    return 0


if __name__ == "__main__":
    sys.exit(main())
