# SPDX-License-Identifier: MIT
"""The shared libraries of a wheel: auditwheel puts those into it that PEP 600 does not promise on
every machine. It does promise zlib and expat, which a small container may lack, so that these are
put in here."""

import hashlib
import pathlib
import re
import shutil
import sys

from bare_root import PROMISED, shared_library
from static_hdf5 import run

PATCHELF = pathlib.Path(sys.executable).parent / "patchelf"


def needs(path):
    """What an ELF file asks the dynamic linker for."""
    return run(PATCHELF, "--print-needed", path).split()


def elf_files(tree):
    return [*tree.glob("polhode/*.so"), *(tree / "polhode.libs").glob("*")]


def add_promised_ones(tree):
    """Into polhode.libs, under names that no other library has, as auditwheel does it."""
    libs = tree / "polhode.libs"
    libs.mkdir(exist_ok=True)
    users = elf_files(tree)
    while users:
        user = users.pop()
        for name in needs(user):
            if PROMISED.match(name) or (libs / name).exists():
                continue
            source = shared_library(name).resolve()
            digest = hashlib.sha256(source.read_bytes()).hexdigest()[:8]
            own = libs / re.sub(r"(?=\.so)", f"-{digest}", name, count=1)
            if not own.exists():
                shutil.copy(source, own)
                run(PATCHELF, "--set-soname", own.name, "--set-rpath", "$ORIGIN", own)
                users.append(own)
            run(PATCHELF, "--replace-needed", name, own.name, user)


def check(tree):
    """Every library that a file asks for is in the wheel or on every machine, and none is there
    for nothing. The names of those that are."""
    own = {path.name for path in (tree / "polhode.libs").glob("*")}
    asked = set()
    for path in elf_files(tree):
        for name in needs(path):
            if name not in own and not PROMISED.match(name):
                raise SystemExit(f"wheel: {path.name} needs {name}, which the wheel does not have")
            asked.add(name)
    if own - asked:
        raise SystemExit(f"wheel: nothing needs {', '.join(sorted(own - asked))}")
    return own
