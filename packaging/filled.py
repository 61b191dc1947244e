#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The recipes of this folder for one release: packaging/filled.py SDIST URL HOMEPAGE MAINTAINER

Writes build/packaging/: each recipe with the version and the digest of SDIST, which is what URL
must serve."""

import hashlib
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
RECIPES = ("conda-forge/recipe.yaml", "spack/package.py")


def filled(text, values):
    """The text with its @NAMES@ replaced, all of them."""
    for name, value in values.items():
        text = text.replace(f"@{name}@", value)
    left = re.findall(r"@[A-Z0-9]+@", text)
    if left:
        raise ValueError(f"{', '.join(left)} left")
    return text


def values_of(sdist, url, homepage, maintainer):
    version = re.fullmatch(r"polhode-(.*)\.tar\.gz", sdist.name)
    if version is None:
        raise ValueError(f"{sdist.name} is no polhode-VERSION.tar.gz")
    return {"VERSION": version.group(1), "URL": url, "HOMEPAGE": homepage,
            "MAINTAINER": maintainer,
            "SHA256": hashlib.sha256(sdist.read_bytes()).hexdigest()}


def main():
    if len(sys.argv) != 5:
        raise SystemExit(__doc__)
    values = values_of(pathlib.Path(sys.argv[1]), *sys.argv[2:])
    for recipe in RECIPES:
        path = HERE.parent / "build/packaging" / recipe
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(filled((HERE / recipe).read_text(), values))
        print(path)


if __name__ == "__main__":
    main()
