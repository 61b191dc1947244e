# SPDX-License-Identifier: MIT
"""`pip install .` gives a package that works anywhere, with its stubs, and little else."""

import contextlib
import os
import subprocess
import sys
import tarfile
import zipfile

import pytest
from scikit_build_core.build import build_sdist

CALL = """
import numpy as np, polhode
motion = polhode.FreeRotation(polhode.Body(1, 2, 2.5), polhode.RotorState([1, 0, 0, 0], [0, 1, 2]))
print(polhode.__version__, motion.at(np.zeros(3)).shape, polhode.__file__)
"""


@pytest.fixture(scope="module")
def wheel(root, tmp_path_factory):
    """A wheel made of the checkout by the tools of its .venv: what pip does, without downloads.

    With the compiler and the warnings of the build tree, so that the compiler cache knows it."""
    folder = tmp_path_factory.mktemp("wheel")
    done = subprocess.run(
        [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir",
         folder, "--config-settings=cmake.define.POLHODE_WERROR=ON",
         f"--config-settings=build-dir={root}/build/wheel", root],
        env=dict(os.environ, CXX="c++"), text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
    (path,) = folder.glob("polhode-*.whl")
    return path


def test_an_installed_wheel_works_elsewhere(wheel, tmp_path):
    site = tmp_path / "site"
    subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-deps",
                    "--no-index", "--target", site, wheel], check=True)
    done = subprocess.run([sys.executable, "-c", CALL], cwd=tmp_path, env={"PYTHONPATH": str(site)},
                          stdout=subprocess.PIPE, text=True, check=True)
    version, shape, where = done.stdout.split(" ", 1)[0], "(3,)", str(site)
    assert version == wheel.name.split("-")[1]
    assert shape in done.stdout
    assert where in done.stdout


def test_a_wheel_holds_the_package_its_stubs_and_its_licence(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        stub = archive.read("polhode/_core.pyi").decode()
    package = {name for name in names if name.startswith("polhode/")}
    assert {"polhode/__init__.py", "polhode/_core.pyi", "polhode/py.typed"} <= package
    assert any(name.startswith("polhode/_core.") and name.endswith(".so") for name in package)
    assert any(name.endswith("licenses/LICENSE") for name in names)
    assert "class AndoyerState(Generic[_Value]):" in stub
    assert [name for name in names if not name.startswith(("polhode/", "polhode-"))] == []


def test_a_source_distribution_holds_what_a_build_needs(root, tmp_path):
    with contextlib.chdir(root):
        name = build_sdist(str(tmp_path))
    with tarfile.open(tmp_path / name) as archive:
        files = {path.split("/", 1)[1] for path in archive.getnames() if "/" in path}
    assert {"pyproject.toml", "CMakeLists.txt", "python/CMakeLists.txt", "src/CMakeLists.txt",
            "include/polhode/version.hpp", "cmake/io-dependencies.cmake", "LICENSE"} <= files
    assert not [path for path in files if path.startswith((".venv", "build/"))]
