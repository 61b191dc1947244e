#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Builds a wheel that needs nothing of the machine that it is installed on, and tries it there.

tools/wheel [--python PYTHON]... [--keep-root]

For each PYTHON (the one that runs this, if none is given; 3.12 and later: one wheel for the stable
ABI) into build/dist: compiled with a static HDF5, repaired by auditwheel, completed with what PEP
600 takes for granted but small containers lack, and with the licences of all that is in it. Each
wheel is installed and used in build/bare-root, where no library that polhode is built with can be
found; one that fails there stays in build/wheel-complete. Then the source distribution.
"""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys

from auditwheel.wheeltools import InWheelCtx

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import bundled  # noqa: E402
import own_libraries  # noqa: E402
import trial  # noqa: E402
from static_hdf5 import run, static_hdf5  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build"


def newest(folder, pattern="*.whl"):
    return max(folder.glob(pattern), key=lambda path: path.stat().st_mtime)


def environment(python):
    """An interpreter with what builds wheels: this one, or a virtual environment of another."""
    if os.path.realpath(python) == os.path.realpath(sys.executable):
        return sys.executable
    version = run(python, "-c", "import sys; print('%d.%d' % sys.version_info[:2])").strip()
    folder = BUILD / f"wheel-python-{version}"
    if not (folder / "complete").exists():
        run(python, "-m", "venv", "--clear", folder)
        run(folder / "bin/python", "-m", "pip", "install", "--quiet", "scikit-build-core>=0.10",
            "nanobind>=2.4", "numpy", "ninja")
        (folder / "complete").touch()
    return str(folder / "bin/python")


def built(python, prefix):
    raw = BUILD / "wheel-raw"
    raw.mkdir(parents=True, exist_ok=True)
    # as deep as the other builds, so that the compiler cache knows what they have compiled
    tag = run(python, "-c", "import sys; print('%d%d' % sys.version_info[:2])").strip()
    run(python, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", raw,
        f"--config-settings=build-dir={BUILD}/wheel-cp{tag}",
        "--config-settings=cmake.define.POLHODE_WERROR=ON", ROOT,
        PKG_CONFIG_PATH=f"{prefix}/lib/pkgconfig", CXX=os.environ.get("CXX", "c++"))
    # and the module before its symbols are stripped
    return newest(raw), newest(BUILD / f"wheel-cp{tag}/python", "_core*.so")


def repaired(wheel):
    """With its shared libraries inside, and without symbols that only a debugger reads."""
    tools = pathlib.Path(sys.executable).parent
    run(tools / "auditwheel", "repair", "--strip", "--wheel-dir", BUILD / "wheel-repaired", wheel,
        PATH=f"{tools}:{os.environ['PATH']}")
    return newest(BUILD / "wheel-repaired")


def completed(wheel, module, prefix, out):
    """The same wheel with all of its libraries, and in its dist-info a list of what it bundles with
    their licences. That list, and the names of the libraries."""
    with InWheelCtx(wheel, out) as context:
        tree = pathlib.Path(context.path)
        own_libraries.add_promised_ones(tree)
        own = own_libraries.check(tree)
        found = bundled.parts(sorted((tree / "polhode.libs").glob("*")), prefix, module)
        (info,) = tree.glob("polhode-*.dist-info")
        folder = info / "licenses" / "bundled"
        folder.mkdir(parents=True)
        listed = bundled.table(found)
        (folder / "BUNDLED.txt").write_text(listed)
        for part in found:
            (folder / f"{part.name}.txt").write_bytes(part.text)
    return listed, own


def made(python, keep_root):
    prefix = static_hdf5(BUILD / "wheel-hdf5")
    raw, module = built(environment(python), prefix)
    wheel = repaired(raw)
    dist, candidate = BUILD / "dist", BUILD / "wheel-complete" / wheel.name
    for folder in (dist, candidate.parent):
        folder.mkdir(exist_ok=True)
    listed, own = completed(wheel, module, prefix, candidate)
    print(f"\n{wheel.name}: {candidate.stat().st_size:,} bytes\n{listed}", flush=True)
    trial.try_wheel(candidate, own, python, BUILD, ROOT, keep_root)
    shutil.move(candidate, dist / wheel.name)
    print(f"wheel: {dist / wheel.name}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--python", action="append", default=[], metavar="PYTHON",
                        help="an interpreter to build for, with its headers; several are allowed")
    parser.add_argument("--keep-root", action="store_true", help="leave build/bare-root there")
    options = parser.parse_args()
    for python in options.python or [sys.executable]:
        made(shutil.which(python) or parser.error(f"{python} is not found"), options.keep_root)
    subprocess.run([sys.executable, "-c", "from scikit_build_core.build import build_sdist; "
                    f"print(build_sdist({str(BUILD / 'dist')!r}))"], cwd=ROOT, check=True)


if __name__ == "__main__":
    main()
