# SPDX-License-Identifier: MIT
"""The copied tree with the drawn mutants in it, and the test programs built from it."""

import json
import re
import subprocess

from . import candidates, schemata, sites

ABOVE = ("property", "paper")
TARGETS = tuple(f"unit_{layer}" for layer in sites.LAYERS) + ABOVE + ("unit_analysis",)
ERROR = re.compile(r"^(\S+?):(\d+):\d+: (?:fatal )?(?:error|note)|^(\S+?):(\d+):\d+:\s+required")


class Tree:
    def __init__(self, root, place, release, programs, jobs):
        self.root, self.source, self.build = root, place / "tree", place / "build"
        self.dropped_file, self.release = place / "dropped.json", release
        self.programs, self.jobs = programs, jobs

    def made(self, mutants):
        """Builds; returns {number: mutant} of those that compile, and those that do not."""
        dropped = set(json.loads(self.dropped_file.read_text())) \
            if self.dropped_file.exists() else set()
        numbers = dict(enumerate(mutants, start=1))
        while True:
            kept = {n: m for n, m in numbers.items() if m.key not in dropped}
            self.write(kept)
            log = self.compile()
            if log is None:
                return kept, [m for m in mutants if m.key in dropped]
            guilty = self.guilty(log, kept)
            if not guilty:
                raise RuntimeError("mutate: the tree does not build:\n" + log[-4000:])
            for m in guilty:
                print(f"  does not compile: {m.file}:{m.line}: {m.original} -> {m.mutated}",
                      flush=True)
            dropped |= {m.key for m in guilty}
            self.dropped_file.write_text(json.dumps(sorted(dropped)))

    def write(self, kept):
        """Files whose text stays the same keep their time, so that ninja passes them by."""
        by_file = {}
        for number, m in kept.items():
            by_file.setdefault(m.file, []).append((number, m))
        wanted = {}
        for path in candidates.files_read(self.root):
            name = path.relative_to(self.root).as_posix()
            wanted[name] = schemata.rewritten(path.read_bytes(), by_file[name]) \
                if name in by_file else path.read_bytes()
        own = self.root / "tools/mutate"
        wanted["active.hpp"] = (own / "active.hpp").read_bytes()
        for program in TARGETS:
            folder = program.replace("unit_", "unit/")
            wanted[f"tests/{folder}/mutants_recorder.cpp"] = (own / "recorder.cpp").read_bytes()
        for name, content in wanted.items():
            path = self.source / name
            if not path.exists() or path.read_bytes() != content:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)
        for path in self.source.rglob("*"):
            if path.is_file() and path.relative_to(self.source).as_posix() not in wanted:
                path.unlink()

    def compile(self):
        """None, or what the compiler said."""
        if not (self.build / "build.ninja").exists():
            subprocess.run(
                ["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja",
                 "-DCMAKE_BUILD_TYPE=Release",
                 f"-DCMAKE_CXX_FLAGS_RELEASE={self.release_flags()}",
                 f"-DCMAKE_CXX_FLAGS=-std=c++20 -w -include {self.source / 'active.hpp'}",
                 "-DPOLHODE_WERROR=OFF", "-DPOLHODE_IO=OFF", "-DPOLHODE_EPHEMERIS=OFF",
                 "-DPOLHODE_ENSEMBLE=OFF", "-DPOLHODE_FIT=OFF", "-DPOLHODE_CLI=OFF",
                 "-DPOLHODE_INSTALL=OFF"],
                check=True, stdout=subprocess.DEVNULL)
        # The library first: it is quick, and finds most of what does not compile.
        for targets in (["polhode_core"], self.programs):
            run = subprocess.run(["ninja", "-C", self.build, f"-j{self.jobs}", "-k", "6", *targets],
                                 text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if run.returncode != 0:
                return run.stdout
        return None

    def release_flags(self):
        cache = (self.release / "CMakeCache.txt").read_text()
        return re.search(r"^CMAKE_CXX_FLAGS_RELEASE:\w+=(.*)$", cache, re.M).group(1)

    def guilty(self, log, kept):
        """The mutants on the lines that errors, or else the notes to them, name."""
        for pattern in (": error:", ""):
            found = []
            for line in log.splitlines():
                match = ERROR.match(line)
                if match is None or pattern not in line:
                    continue
                name, number = match.group(1) or match.group(3), match.group(2) or match.group(4)
                path = (self.build / name).resolve()
                found += [m for m in kept.values() if path == (self.source / m.file).resolve()
                          and m.line <= int(number) <= m.last_line]
            if found:
                return list({m.key: m for m in found}.values())
        return []
