# SPDX-License-Identifier: MIT
"""The two sides: programs, Python package and inputs of a revision, a build folder, or the tree.

A revision is built in a worktree under build/bits. Each side reads the inputs of its own checkout.
Inputs that are missing there are copied from the working tree, with the old names.
"""

import dataclasses
import functools
import os
import pathlib
import shutil
import subprocess

import tomllib
from bitwise.names import Names

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOME = ROOT / "build/bits"
PYTHON = ROOT / ".venv/bin/python"
# Inputs: probes, scenarios, tables of commands, and the valid calls that the Python tests share.
INPUTS = ["tools/bitwise", "examples", "python/tests", "tests/slowdown.py",
          "tests/scenario_parts.py"]
# As in the preset `release`, for the library and for the probes.
FLAGS = ["-std=c++20", "-O2", "-DNDEBUG", "-ffp-contract=off"]


class Failed(Exception):
    """One line, and what was said before it."""


def called(command, what, **options):
    words = [str(word) for word in command]
    done = subprocess.run(words, text=True, capture_output=True, **options)
    if done.returncode != 0:
        raise Failed(f"{done.stdout}{done.stderr}\n{what}".strip())
    return done.stdout.strip()


@dataclasses.dataclass
class Side:
    name: str
    folder: str  # of its outputs
    build: pathlib.Path
    tree: pathlib.Path
    keep: bool = False  # whether outputs are kept for the next comparison
    names: "Names | None" = None  # of an old side: old and new public names

    @property
    def polhode(self):
        return self.build / "polhode"

    def command(self, *words):
        """A command line, with the old names on an old side."""
        old = self.names.to_old if self.names else bytes
        return [self.polhode, *(old(str(word).encode()).decode() for word in words)]

    def compile(self, source, program):
        """A probe with the headers and libraries of this side."""
        libraries = sorted((self.build / "src").rglob("*.a"))
        called(["g++", *FLAGS, f"-I{self.tree}/include", source, "-Wl,--start-group", *libraries,
                "-Wl,--end-group", "-o", program],
               f"{source.name} does not compile against {self.name}")

    @functools.cached_property
    def inputs(self):
        """A folder with the layout of the checkout."""
        if self.tree == ROOT:
            return ROOT
        folder = HOME / "inputs" / self.folder
        shutil.rmtree(folder, ignore_errors=True)
        for name in INPUTS:
            for source in files_of(ROOT / name):
                target = folder / source.relative_to(ROOT)
                target.parent.mkdir(parents=True, exist_ok=True)
                own = self.tree / source.relative_to(ROOT)
                if own.exists():
                    continue
                data = source.read_bytes()
                target.write_bytes(self.names.to_old(data) if self.names else data)
            for own in files_of(self.tree / name):
                target = folder / own.relative_to(self.tree)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(own, target)
        return folder


    def table(self, name):
        """The cases of the working tree, each as the table of this side has it, if it does."""
        own = table_of(self.inputs / name)
        text = (ROOT / name).read_bytes()
        cases = tomllib.loads((self.names.to_old(text) if self.names else text).decode())
        for group, of_group in cases.items():
            of_group.update({case: script for case, script in own.get(group, {}).items()
                             if case in of_group})
        return cases


def table_of(path):
    return tomllib.loads(path.read_text(encoding="utf-8"))


def files_of(path):
    if path.is_file():
        return [path]
    return [file for file in sorted(path.rglob("*"))
            if file.is_file() and "__pycache__" not in file.parts]


def build(side, environment=None):
    """Command line and Python package; quick where ccache has seen the sources."""
    called(["cmake", "--build", "build/release", "--target", "polhode", "polhode_stub"],
           f"{side.name} does not build", cwd=side.tree, env=environment)


def working_tree():
    side = Side("the working tree", "working", ROOT / "build/release", ROOT)
    if not (side.build / "build.ninja").exists():
        called(["cmake", "--preset", "release"], f"{side.name} cannot be configured", cwd=ROOT)
    build(side)
    return side


def built_folder(folder, name):
    """A build folder as it is; nothing is built."""
    cache = (folder / "CMakeCache.txt").read_text(encoding="utf-8")
    (home,) = [line.partition("=")[2] for line in cache.splitlines()
               if line.startswith("CMAKE_HOME_DIRECTORY:")]
    return Side(f"{folder} ({name})", name, folder.resolve(), pathlib.Path(home))


def built_revision(revision):
    sha = called(["git", "rev-parse", "--verify", "--quiet", "--end-of-options",
                  f"{revision}^{{commit}}"],
                 f"{revision} is no revision of this repository", cwd=ROOT)
    tree = HOME / sha[:12]
    if not (tree / "CMakeLists.txt").exists():
        HOME.mkdir(parents=True, exist_ok=True)
        called(["git", "worktree", "prune"], "git worktree prune failed", cwd=ROOT)
        called(["git", "worktree", "add", "--detach", "--force", tree, sha],
               f"{revision} cannot be checked out into {tree}", cwd=ROOT)
    # one cache for all revisions: paths count from the top of each
    environment = {"CCACHE_BASEDIR": str(tree), "CCACHE_NOHASHDIR": "1", **os.environ}
    side = Side(f"{revision} ({sha[:12]})", tree.name, tree / "build/release", tree, keep=True)
    called(["cmake", "--preset", "release", f"-DPython_EXECUTABLE={PYTHON}", "-DPOLHODE_PYTHON=ON",
            "-DPOLHODE_TESTS=OFF", "-DPOLHODE_BENCHMARKS=OFF"],
           f"{side.name} cannot be configured", cwd=tree, env=environment)
    build(side, environment)
    return side


def old_side(text):
    """A revision, or a build folder by its path."""
    folder = pathlib.Path(text)
    is_build = (folder / "CMakeCache.txt").exists()
    return built_folder(folder, "old") if is_build else built_revision(text)
