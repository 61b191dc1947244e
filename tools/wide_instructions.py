#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Wide instructions: no function that is compiled for a set of instructions that a processor may
lack can stand in for one that is compiled for all of them.

The linker keeps one of several functions of a name. So every function that src/*/lanes/*.cpp offers
for such a set must have the set in its name, as a template on it has. Fails with those that have
not. The argument is a build folder; left out, build/release."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Each as the demangler writes it.
SETS = {"avx2": "InstructionSet)1", "avx512": "InstructionSet)2"}
SYMBOL = re.compile(r"^[0-9a-f]* *([A-Za-z]) (.*)$")


def shared(listing, isa):
    """Of what nm lists, the functions that others may share, without the set in their name."""
    for line in listing.splitlines():
        match = SYMBOL.match(line)
        # DW.ref.*: the address of a function of the C++ library, no code
        if match and match[1] in "TWVuBD" and not match[2].startswith("DW.ref.") \
                and SETS[isa] not in match[2]:  # fmt: skip
            yield match[2]


def errors_of(built):
    errors = []
    for isa in SETS:
        objects = sorted(built.glob(f"src/CMakeFiles/polhode_*_{isa}.dir/**/*.o"))
        if not objects:
            errors.append(f"{built}: holds no object of src/*/lanes for {isa}")
            continue
        listing = subprocess.run(["nm", "-C", "--defined-only", *objects],
                                 capture_output=True, text=True, check=True).stdout  # fmt: skip
        errors += [f"{name} is compiled for {isa} and may be taken for all processors"
                   for name in shared(listing, isa)]  # fmt: skip
    return errors


def main():
    built = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/release"
    errors = errors_of(built)
    print("\n".join(errors), end="\n" if errors else "")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
