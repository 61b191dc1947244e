#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Public headers: their labels in one order, none that says "none", polhode.hpp names them all, and
a compiler of another standard first says that polhode needs C++20.

With --fix, writes the list of polhode.hpp."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
INCLUDE = ROOT / "include"
UMBRELLA = INCLUDE / "polhode/polhode.hpp"
LABELS = ["Equations", "Corrections", "Units", "Domain", "Accuracy", "Errors", "Cost"]
# Layers of other targets: a program that takes text, files or threads names their headers itself.
NOT_IN_UMBRELLA = {"text", "tables", "output", "scenario", "run", "cli", "ensemble", "fit",
                   "mpi"}


def label_errors(path):
    name = path.relative_to(INCLUDE).as_posix()
    if "detail" in path.parts:
        return []
    comment = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if not line.startswith("//"):
            break
        comment.append(line)
    pattern = re.compile(rf"^// ({'|'.join(LABELS)})(?= {{2,}}|$)")
    found = [m.group(1) for m in map(pattern.match, comment) if m]
    empty = [line for line in comment if re.fullmatch(pattern.pattern + r" +none\.?", line)]
    if empty:
        return [f"include/{name}: leave out the label that says nothing: {empty[0]}"]
    if found != [label for label in LABELS if label in found]:
        return [f"include/{name}: labels in the order {', '.join(found)}; "
                f"expected {', '.join(LABELS)}"]
    return []


def standard_errors(path):
    """A header without other polhode headers must include version.hpp, which rejects compilers
    older than C++20."""
    text = path.read_text(encoding="utf-8")
    if path.name == "version.hpp" or '#include "polhode/' in text:
        return []
    return [f"include/{path.relative_to(INCLUDE).as_posix()}: includes no other header; expected "
            '#include "polhode/version.hpp"  // asks for C++20']


def umbrella_text():
    names = (p.relative_to(INCLUDE).as_posix() for p in INCLUDE.rglob("*.hpp")
             if p != UMBRELLA and "detail" not in p.parts)
    core = sorted(n for n in names if n.split("/")[1] not in NOT_IN_UMBRELLA)
    head = UMBRELLA.read_text(encoding="utf-8").split("#pragma once")[0]
    return head + "#pragma once\n\n" + "".join(f'#include "{n}"\n' for n in core)


def main():
    if "--fix" in sys.argv:
        UMBRELLA.write_text(umbrella_text(), encoding="utf-8")
    errors = [e for path in sorted(INCLUDE.rglob("*.hpp"))
              for e in label_errors(path) + standard_errors(path)]
    if UMBRELLA.read_text(encoding="utf-8") != umbrella_text():
        errors.append("include/polhode/polhode.hpp is not the list of public headers: "
                      "tools/headers.py --fix")
    print("\n".join(errors), end="\n" if errors else "")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
