# SPDX-License-Identifier: MIT
"""All mutants of the checkout, read once per state of the sources."""

import concurrent.futures
import dataclasses
import hashlib
import json

from . import sites
from .mutant import Mutant

READ = ("include", "src", "tests", "cmake")


def files_read(root):
    """What the test programs are built from."""
    found = [root / "CMakeLists.txt"]
    for folder in READ:
        found += [p for p in sorted((root / folder).rglob("*"))
                  if p.is_file() and "__pycache__" not in p.parts]
    return found


def fingerprint(root, paths):
    digest = hashlib.sha256()
    for path in paths:
        digest.update(str(path.relative_to(root)).encode() + b"\0")
        digest.update(path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


def _of_file(task):
    return [dataclasses.asdict(m) for m in sites.candidates(*task)]


def all_mutants(root, database, cache, jobs):
    own = [root / "tools/mutate" / name for name in ("mutant.py", "operators.py", "sites.py")]
    mutated = [p for p in files_read(root) if p.relative_to(root).parts[0] in ("include", "src")]
    stamp = fingerprint(root, mutated + own)
    if cache.exists():
        kept = json.loads(cache.read_text())
        if kept["stamp"] == stamp:
            return [Mutant(**m) for m in kept["mutants"]]
    flags = sites.flags_of(database)
    tasks = [(root, file, layer, flags) for file, layer in sites.files_of(root).items()]
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        found = [m for part in pool.map(_of_file, tasks, chunksize=4) for m in part]
    cache.write_text(json.dumps({"stamp": stamp, "mutants": found}))
    return [Mutant(**m) for m in found]
