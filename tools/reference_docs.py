#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the generated parts of docs/reference from the table of scenario keys: the JSON Schema,
the lists of keys and units in scenario.md and that of columns in files.md.
tests/cli/test_reference.py fails when they are stale.

Usage: tools/reference_docs.py [--check]   (after make build)"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
REFERENCE = ROOT / "docs/reference"


def schema(polhode, part):
    return subprocess.run([polhode, "schema", part], check=True, text=True,
                          stdout=subprocess.PIPE).stdout


def documents(polhode):
    """Path -> what it must hold."""
    result = {REFERENCE / "scenario.schema.json": schema(polhode, "json")}
    for name, parts in {"scenario.md": ("units", "keys"), "files.md": ("columns",)}.items():
        page = (REFERENCE / name).read_text(encoding="utf-8")
        for part in parts:
            text = schema(polhode, part).strip("\n")
            pattern = re.compile(rf"(<!-- {part}: [^\n]*-->\n).*?(<!-- end of {part} -->)",
                                 re.DOTALL)
            page, count = pattern.subn(lambda m, t=text: m[1] + "\n" + t + "\n\n" + m[2], page)
            if count != 1:
                sys.exit(f"docs/reference/{name}: {count} places for {part}, expected one")
        result[REFERENCE / name] = page
    return result


def stale(polhode):
    return [path for path, text in documents(polhode).items()
            if not path.exists() or path.read_text(encoding="utf-8") != text]


def main():
    polhode = ROOT / "build/release/polhode"
    old = stale(polhode)
    if "--check" in sys.argv:
        for path in old:
            print(f"{path.relative_to(ROOT)} is stale: tools/reference_docs.py")
        return 1 if old else 0
    for path, text in documents(polhode).items():
        path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
