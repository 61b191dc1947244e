#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""clang-tidy on what differs from HEAD in library, command line and bindings (--all: on all)."""

import concurrent.futures
import functools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = ROOT / "build/release"
COMMANDS = BUILD / "tidy"


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


def write_commands():
    """The compile commands, with those of its sources in place of a group (CMake's unity build)."""
    apart = []
    for entry in json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8")):
        file = pathlib.Path(entry["file"])
        if file.parent.name == "Unity":
            sources = re.findall(r'^#include "(.*\.cpp)"', file.read_text(encoding="utf-8"), re.M)
            apart += [dict(entry, file=source, command=entry["command"].replace(str(file), source))
                      for source in sources]
        else:
            apart.append(entry)
    COMMANDS.mkdir(exist_ok=True)
    (COMMANDS / "compile_commands.json").write_text(json.dumps(apart), encoding="utf-8")


def clang_tidy():
    """The oldest version from 16 on that is installed."""
    names = [f"clang-tidy-{version}" for version in range(16, 41)] + ["clang-tidy"]
    for name in names:
        if shutil.which(name):
            return name
    sys.exit("tools/tidy.py: no clang-tidy of version 16 or later; run: tools/install-deps --clang")


def tidy(program, name):
    # the commands are those of GCC
    command = [program, "-p", COMMANDS, "--quiet", "--extra-arg=-Wno-unknown-warning-option", name]
    run = subprocess.run(command, cwd=ROOT, text=True, capture_output=True)
    return "" if run.returncode == 0 else run.stdout or run.stderr


def main():
    write_commands()
    report_of = functools.partial(tidy, clang_tidy())
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        reports = [report for report in pool.map(report_of, sources("--all" in sys.argv)) if report]
    print("".join(reports), end="")
    return 1 if reports else 0


if __name__ == "__main__":
    sys.exit(main())
