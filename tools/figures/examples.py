#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of the pages on real bodies into docs/figures: runs docs/examples/figures.

    tools/figures/examples.py [NAME...]

Needs the Python package (build/release/python, or PYTHONPATH) and matplotlib."""

import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main():
    places = [*filter(None, os.environ.get("PYTHONPATH", "").split(os.pathsep)),
              ROOT / "build/release/python"]  # fmt: skip
    path = os.pathsep.join(str(pathlib.Path(place).resolve()) for place in places)
    environment = dict(os.environ, MPLBACKEND="agg", PYTHONPATH=path)
    for script in sorted((ROOT / "docs/examples/figures").glob("*.py")):
        if not sys.argv[1:] or script.stem in sys.argv[1:]:
            subprocess.run([sys.executable, script], cwd=ROOT / "docs/figures", check=True,
                           env=environment)


if __name__ == "__main__":
    main()
