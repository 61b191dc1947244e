#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills a run at random moments (kill -9), continues it each time, and compares its files.

The straight run is the measure: CSV and events byte for byte, HDF5 by h5diff.

tools/killed_runs.py [--polhode build/release/polhode] [--kills 50] [--runs 1] [--seed 1]

Prints one line per run. Exit status 1 when anything differs.
"""

import argparse
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests/cli"))

import killed_runs  # noqa: E402


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--polhode", type=pathlib.Path, default=ROOT / "build/release/polhode")
    arguments.add_argument("--kills", type=int, default=50)
    arguments.add_argument("--runs", type=int, default=1)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--stop", type=float, default=60000, help="seconds of the body's time")
    chosen = arguments.parse_args()
    failed = False
    for number in range(chosen.runs):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            scenario, straight, killed = (folder / x for x in ("body.toml", "straight", "killed"))
            scenario.write_text(killed_runs.SCENARIO.format(stop=chosen.stop))
            straight.mkdir()
            killed.mkdir()
            seconds = killed_runs.straight_run(chosen.polhode, scenario, straight)
            seed = chosen.seed + number
            said, kills = killed_runs.killed_run(chosen.polhode, scenario, killed, chosen.kills,
                                                 seed, 1.5 * seconds / chosen.kills)
            found = killed_runs.differences(straight, killed)
            failed = failed or bool(found)
            continued = sum("continues at" in text for text in said)
            print(f"seed {seed}: straight {seconds:.1f} s; {kills} kills, {continued} starts from "
                  f"a checkpoint; {'; '.join(found) if found else 'files equal'}", flush=True)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
