#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Wide instructions: no function that is compiled for a set of instructions that a processor may
lack can stand in for one that is compiled for all of them.

The linker keeps one of several functions of a name. So every function that an object of
src/*/lanes/*_avx*.cpp offers must have its set in its name, as a template on it has. Fails with
those that have not."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Of the archive's members: states_avx512.cpp.o; its set as the demangler writes it.
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


def errors_of(library):
    if not library.exists():
        return [f"{library}: no such library: build it first"]
    members = subprocess.run(["ar", "t", library], capture_output=True, text=True, check=True)
    found = [name for name in members.stdout.split() if re.search(r"_avx\w+\.cpp\.o$", name)]
    errors = []
    for member in found:
        isa = re.search(r"_(avx\w+)\.cpp\.o$", member)[1]
        text = subprocess.run(["ar", "p", library, member], capture_output=True, check=True).stdout
        object_file = library.parent / f".{member}"
        object_file.write_bytes(text)
        try:
            listing = subprocess.run(["nm", "-C", "--defined-only", object_file],
                                     capture_output=True, text=True, check=True).stdout  # fmt: skip
        finally:
            object_file.unlink()
        errors += [f"{member}: {name} is compiled for {isa} and may be taken for all processors"
                   for name in shared(listing, isa)]  # fmt: skip
    if not found:
        errors.append(f"{library}: holds no object of src/*/lanes")
    return errors


def main():
    built = ROOT / "build/release/src"
    libraries = [pathlib.Path(name) for name in sys.argv[1:]] or [
        built / f"libpolhode{part}.a" for part in ("", "_ensemble", "_fit")
    ]
    errors = [error for library in libraries for error in errors_of(library)]
    print("\n".join(errors), end="\n" if errors else "")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
