# SPDX-License-Identifier: MIT
"""The two sides: a revision, built in a worktree under build/bits, and the working tree."""

import dataclasses
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOME = ROOT / "build/bits"
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
    tree: pathlib.Path

    @property
    def polhode(self):
        return self.tree / "build/release/polhode"

    def compile(self, source, program):
        """A probe of the working tree with the headers and libraries of this side."""
        libraries = sorted((self.tree / "build/release/src").rglob("*.a"))
        called(["g++", *FLAGS, f"-I{self.tree}/include", source, "-Wl,--start-group", *libraries,
                "-Wl,--end-group", "-o", program],
               f"{source.relative_to(ROOT)} does not compile against {self.name}")


def sha_of(revision):
    return called(["git", "rev-parse", "--verify", "--quiet", "--end-of-options",
                   f"{revision}^{{commit}}"],
                  f"{revision} is no revision of this repository", cwd=ROOT)


def build(side, options=(), environment=None):
    """Library and command line; quick where ccache has seen the sources."""
    if not (side.tree / "build/release/build.ninja").exists():
        called(["cmake", "--preset", "release", *options], f"{side.name} cannot be configured",
               cwd=side.tree, env=environment)
    called(["cmake", "--build", "build/release", "--target", "polhode"],
           f"{side.name} does not build", cwd=side.tree, env=environment)


def working_tree():
    side = Side("the working tree", ROOT)
    build(side)
    return side


def built_revision(revision):
    sha = sha_of(revision)
    tree = HOME / sha[:12]
    if not (tree / "CMakeLists.txt").exists():
        HOME.mkdir(parents=True, exist_ok=True)
        called(["git", "worktree", "prune"], "git worktree prune failed", cwd=ROOT)
        called(["git", "worktree", "add", "--detach", "--force", tree, sha],
               f"{revision} cannot be checked out into {tree}", cwd=ROOT)
    # one cache for all revisions: paths count from the top of each
    environment = {"CCACHE_BASEDIR": str(tree), "CCACHE_NOHASHDIR": "1", **os.environ}
    side = Side(f"{revision} ({sha[:12]})", tree)
    build(side, [f"-DPOLHODE_{part}=OFF" for part in ("PYTHON", "TESTS", "BENCHMARKS")],
          environment)
    return side
