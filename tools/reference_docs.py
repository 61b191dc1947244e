#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the generated parts of docs/reference from the table of scenario keys: the JSON Schema,
and the lists of keys and units in scenario.md. tests/cli/test_reference.py fails when they are
stale.

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
    page = (REFERENCE / "scenario.md").read_text(encoding="utf-8")
    for part in ("units", "keys"):
        text = schema(polhode, part).strip("\n")
        pattern = re.compile(rf"(<!-- {part}: [^\n]*-->\n).*?(<!-- end of {part} -->)", re.DOTALL)
        page, count = pattern.subn(lambda m, t=text: m[1] + "\n" + t + "\n\n" + m[2], page)
        if count != 1:
            sys.exit(f"docs/reference/scenario.md: {count} places for {part}, expected one")
    return {REFERENCE / "scenario.md": page,
            REFERENCE / "scenario.schema.json": schema(polhode, "json")}


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
