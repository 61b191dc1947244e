#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Public headers: their labels in one order, none that says "none", and a compiler of another
standard first says that polhode needs C++20."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
INCLUDE = ROOT / "include"
LABELS = ["Equations", "Corrections", "Units", "Domain", "Accuracy", "Errors", "Cost"]


def blocks(text):
    """Comments at the start of a line: runs of lines that begin with //."""
    return re.findall(r"(?:^//[^\n]*\n)+", text, re.MULTILINE)


def label_errors(path):
    """A header with several parts has such a comment before each."""
    name = path.relative_to(INCLUDE).as_posix()
    if "detail" in path.parts:
        return []
    errors = []
    pattern = re.compile(rf"^// ({'|'.join(LABELS)})(?= {{2,}}|$)")
    for comment in map(str.splitlines, blocks(path.read_text(encoding="utf-8"))):
        found = [m.group(1) for m in map(pattern.match, comment) if m]
        empty = [line for line in comment if re.fullmatch(pattern.pattern + r" +none\.?", line)]
        if empty:
            errors.append(f"include/{name}: leave out the label that says nothing: {empty[0]}")
        elif found != [label for label in LABELS if label in found]:
            errors.append(f"include/{name}: labels in the order {', '.join(found)}; "
                          f"expected {', '.join(LABELS)}")
    return errors


def standard_errors(path):
    """A header without other polhode headers must include version.hpp, which rejects compilers
    older than C++20."""
    text = path.read_text(encoding="utf-8")
    if path.name == "version.hpp" or '#include "polhode/' in text:
        return []
    return [f"include/{path.relative_to(INCLUDE).as_posix()}: includes no other header; expected "
            '#include "polhode/version.hpp"  // asks for C++20']


def main():
    errors = [e for path in sorted(INCLUDE.rglob("*.hpp"))
              for e in label_errors(path) + standard_errors(path)]
    print("\n".join(errors), end="\n" if errors else "")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
