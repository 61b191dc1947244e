# SPDX-License-Identifier: MIT
"""What a wheel holds that is not ours: each with version, licence and size, and its licence's
text in the wheel."""

import dataclasses
import importlib.metadata
import os
import pathlib
import re
import subprocess

# Whose licence (an SPDX identifier) and whose text.
SHARED = {"liberfa1": "BSD-3-Clause", "libexpat1": "MIT", "libfmt9": "MIT",
          "libtbb12": "Apache-2.0", "libudunits2-0": "UCAR", "zlib1g": "Zlib"}
HEADERS = {"libeigen3-dev": "MPL-2.0", "libboost1.74-dev": "BSL-1.0",
           "libtomlplusplus-dev": "MIT", "libcli11-dev": "BSD-3-Clause"}
# Boost is a hundred libraries, with 2 MB of names: ours is headers of one.
PART_USED = {"libboost1.74-dev": "libs/multiprecision/*"}


@dataclasses.dataclass(frozen=True)
class Part:
    name: str
    version: str
    licence: str
    how: str
    size: int | None
    text: bytes


def package_of(soname):
    """The distribution's package of a shared library; the wheel's name of it has a hash inside."""
    plain = re.sub(r"-[0-9a-f]{8}(?=\.so)", "", soname)
    said = subprocess.run(["dpkg-query", "-S", f"*/{plain}"], text=True, capture_output=True)
    if said.returncode:
        raise SystemExit(f"wheel: {soname} is bundled, and no package has it")
    return said.stdout.split(":")[0]


def version_of(package):
    return subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], text=True,
                          stdout=subprocess.PIPE, check=True).stdout


def text_of(package, licence):
    text = pathlib.Path("/usr/share/doc", package, "copyright").read_text(encoding="utf-8")
    if package in PART_USED:  # of a collection: who wrote that part, and its licence
        paragraphs = re.split(r"\n\s*\n(?=\S)", text)
        (who,) = (one for one in paragraphs
                  if one.startswith("Files:") and f" {PART_USED[package]}\n" in one)
        (terms,) = (one for one in paragraphs if one.startswith(f"License: {licence}\n"))
        text = f"{who}\n\n{terms}\n"
    return text.encode()


def static_size(module, archive):
    """What of a static library is in the module: the sizes of its functions and tables there."""
    def symbols(path, *options):
        said = subprocess.run(["nm", "-S", *options, path], text=True, capture_output=True).stdout
        rows = (line.split() for line in said.splitlines())
        return {row[3]: int(row[1], 16) for row in rows if len(row) == 4 and row[2] not in "Bb"}

    inside = symbols(module)
    return sum(size for name, size in symbols(archive).items() if inside.get(name) == size)


def parts(libraries, prefix, module):
    """All that a wheel has: shared libraries beside its module, and what was linked into it."""
    found = []
    for path in libraries:
        package = package_of(path.name)
        if package not in SHARED:
            raise SystemExit(f"wheel: {path.name} of {package} is bundled; if it is meant to be, "
                             "tools/wheel/bundled.py needs its licence")
        found.append(Part(package, version_of(package), SHARED[package], "shared library",
                          path.stat().st_size, text_of(package, SHARED[package])))
    pc = (prefix / "lib/pkgconfig/hdf5-serial.pc").read_text()
    found.append(Part("hdf5", re.search(r"(?m)^Version: (.*)$", pc).group(1), "BSD-3-Clause",
                      "in the module", static_size(module, prefix / "lib/libhdf5.a"),
                      (prefix / "COPYING").read_bytes()))
    for package, licence in HEADERS.items():
        found.append(Part(package, version_of(package), licence, "headers", None,
                          text_of(package, licence)))
    nanobind = importlib.metadata.distribution("nanobind")
    (text,) = (path for path in nanobind.files if path.name == "LICENSE")
    found.append(Part("nanobind", nanobind.version, "BSD-3-Clause", "in the module", None,
                      pathlib.Path(os.fspath(text.locate())).read_bytes()))
    return found


def table(of):
    """Lines for people, and for the file BUNDLED in the wheel."""
    rows = [("part", "version", "licence", "how", "bytes")]
    rows += [(p.name, p.version, p.licence, p.how, "" if p.size is None else f"{p.size:,}")
             for p in of]
    widths = [max(len(row[i]) for row in rows) for i in range(5)]
    return "".join("  ".join(word.ljust(width) for word, width in zip(row, widths)).rstrip() + "\n"
                   for row in rows)
