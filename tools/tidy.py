#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""clang-tidy on what differs from HEAD in library, command line and bindings (--all: on all)."""

import concurrent.futures
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = "build/release"


def git(*arguments):
    out = subprocess.run(["git", *arguments], cwd=ROOT, text=True, check=True,
                         stdout=subprocess.PIPE)
    return [name for name in out.stdout.split("\n") if name]


def sources(everything):
    if everything:
        names = git("ls-files", "-co", "--exclude-standard")
    else:
        names = git("diff", "--name-only", "HEAD") + git("ls-files", "-o", "--exclude-standard")
    return sorted({n for n in names if n.startswith(("src/", "cli/", "python/"))
                   and n.endswith(".cpp") and (ROOT / n).exists()})


def tidy(name):
    command = ["clang-tidy-16", "-p", BUILD, "--quiet", name]
    run = subprocess.run(command, cwd=ROOT, text=True, capture_output=True)
    return "" if run.returncode == 0 else run.stdout or run.stderr


def main():
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        reports = [report for report in pool.map(tidy, sources("--all" in sys.argv)) if report]
    print("".join(reports), end="")
    return 1 if reports else 0


if __name__ == "__main__":
    sys.exit(main())
