#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The address of the repository: pyproject.toml sets it, README.md, CITATION.cff and
web/package.json repeat it, the site reads it.

    tools/repository.py       prints it, and the files that say another
    tools/repository.py URL   writes another into all of them"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PLACES = {
    "pyproject.toml": re.compile(r'(?<=^Repository = ")[^"]+', re.MULTILINE),
    "CITATION.cff": re.compile(r'(?<=^repository-code: ")[^"]+', re.MULTILINE),
    "web/package.json": re.compile(r'(?<="url": ")[^"]+'),
    "README.md": re.compile(r"(?<=^git clone )\S+", re.MULTILINE),
}


def addresses() -> dict[str, list[str]]:
    """File -> the addresses that it says."""
    return {name: pattern.findall((ROOT / name).read_text(encoding="utf-8"))
            for name, pattern in PLACES.items()}  # fmt: skip


def main() -> int:
    for address in sys.argv[1:]:
        for name, pattern in PLACES.items():
            text = (ROOT / name).read_text(encoding="utf-8")
            (ROOT / name).write_text(pattern.sub(address, text), encoding="utf-8")
    found = addresses()
    (address,) = found["pyproject.toml"]
    others = [name for name, said in found.items() if said != [address]]
    print(address, *(f"{name}: says {found[name]}" for name in others), sep="\n")
    return 1 if others else 0


if __name__ == "__main__":
    sys.exit(main())
