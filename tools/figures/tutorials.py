#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of the tutorials into docs/figures: runs each script of docs/tutorials there.

    tools/figures/tutorials.py [NAME...]

Needs the Python package (build/release/python, or PYTHONPATH) and matplotlib."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/site"))
from tutorials import scripts  # noqa: E402


def main():
    places = [*filter(None, os.environ.get("PYTHONPATH", "").split(os.pathsep)),
              ROOT / "build/release/python"]  # fmt: skip
    path = os.pathsep.join(str(pathlib.Path(place).resolve()) for place in places)
    environment = dict(os.environ, MPLBACKEND="agg", PYTHONPATH=path)
    for script in scripts(ROOT):
        if not sys.argv[1:] or script.stem in sys.argv[1:]:
            with tempfile.TemporaryDirectory() as folder:
                for table in script.parent.glob("*.txt"):  # what tutorials read
                    shutil.copy(table, folder)
                subprocess.run([sys.executable, script], cwd=folder, check=True,
                               env=environment, stdout=subprocess.DEVNULL)
                for picture in pathlib.Path(folder).glob("*.png"):
                    shutil.copy(picture, ROOT / "docs/figures")


if __name__ == "__main__":
    main()
