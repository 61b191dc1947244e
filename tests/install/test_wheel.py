# SPDX-License-Identifier: MIT
"""`pip install .` gives a package that works anywhere, with its stubs, and little else."""

import contextlib
import os
import re
import signal
import subprocess
import sys
import tarfile
import time
import zipfile

import pytest
from scikit_build_core.build import build_sdist

CALL = """
import numpy as np, polhode
motion = polhode.FreeRotation(polhode.Body(1, 2, 2.5), polhode.RotorState([1, 0, 0, 0], [0, 1, 2]))
print(polhode.__version__, motion.at(np.zeros(3)).shape, polhode.__file__)
"""


@pytest.fixture(scope="module")
def wheel(root, build, tmp_path_factory):
    """A wheel made of the checkout by the tools of its .venv: what pip does, without downloads.

    With the compiler and the warnings of the build tree, so that the compiler cache has its objects
    already."""
    folder = tmp_path_factory.mktemp("wheel")
    cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")
    options = ["--config-settings=cmake.define." + name + ("=ON" if name + ":BOOL=ON" in cache else
                                                           "=OFF")
               for name in ("POLHODE_WERROR", "POLHODE_JOINED")]
    done = subprocess.run(
        [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir",
         folder, *options, f"--config-settings=build-dir={root}/build/wheel", root],
        env=dict(os.environ, CXX="c++"), text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
    (path,) = folder.glob("polhode-*.whl")
    return path


@pytest.fixture(scope="module")
def site(wheel, tmp_path_factory):
    """A folder in which the wheel is installed."""
    folder = tmp_path_factory.mktemp("site")
    subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-deps",
                    "--no-index", "--target", folder, wheel], check=True)
    return folder


def test_an_installed_wheel_works_elsewhere(wheel, site, tmp_path):
    done = subprocess.run([sys.executable, "-c", CALL], cwd=tmp_path, env={"PYTHONPATH": str(site)},
                          stdout=subprocess.PIPE, text=True, check=True)
    version, shape, where = done.stdout.split(" ", 1)[0], "(3,)", str(site)
    assert version == wheel.name.split("-")[1]
    assert shape in done.stdout
    assert where in done.stdout


@pytest.fixture
def both(site, polhode, tmp_path):
    """both("info", FILE) -> exit status and output of the wheel's command and of the program; names
    of the two in their messages become NAME."""
    command = site / "bin/polhode"

    def call(*words, **options):
        ends = []
        for program in (command, polhode):
            done = subprocess.run([program, *words], stdin=subprocess.DEVNULL, capture_output=True,
                                  env=dict(os.environ, PYTHONPATH=str(site)), cwd=tmp_path)
            name = os.fsencode(program)
            ends.append((done.returncode, done.stdout.replace(name, b"NAME"),
                         done.stderr.replace(name, b"NAME")))
        return ends

    return call


def test_a_wheel_brings_the_command(both, root, tmp_path):
    scenario = root / "examples/apophis.toml"
    for status, words in ((0, ["--version"]), (0, ["--help"]), (0, ["info", scenario, "--json"]),
                          (2, ["inform"]), (2, ["info", b"no-\xff.toml"]), (0, ["init", "tide"]),
                          (0, ["run", scenario, "--out", "-"]), (0, ["completion", "zsh"])):
        ours, theirs = both(*words)
        assert ours == theirs and ours[0] == status
        assert ours[1] or status


def test_the_command_of_a_wheel_stops_as_programs_do(site, root, tmp_path):
    def started(*words, **options):
        return subprocess.Popen([site / "bin/polhode", *words], text=True, cwd=tmp_path,
                                stderr=subprocess.PIPE,
                                env=dict(os.environ, PYTHONPATH=str(site)), **options)

    # nobody reads on: it ends by the signal, without a word
    run = started("run", root / "examples/apophis.toml", "--out", "-", stdout=subprocess.PIPE)
    run.stdout.readline()
    run.stdout.close()
    assert run.stderr.read() == "" and run.wait() == -signal.SIGPIPE
    # Ctrl-C: in order, and with what continues it
    text = (root / "examples/gravity-gradient-satellite.toml").read_text()
    (tmp_path / "long.toml").write_text(re.sub(r"(?m)^stop = .*$", 'stop = "100 yr"', text))
    run = started("run", "long.toml", "--out", "a.csv", "--checkpoint", "0",
                  stdout=subprocess.DEVNULL)
    while not (tmp_path / "a.csv.checkpoint").exists() and run.poll() is None:
        time.sleep(0.01)
    run.send_signal(signal.SIGINT)
    said = run.communicate()[1]
    assert run.returncode == 128 + signal.SIGINT, said
    assert said.endswith(f"continue with: {site}/bin/polhode run long.toml --out a.csv --resume\n")


def test_what_is_left_of_the_distribution_is_seen(wheel, root, tmp_path):
    """`make wheel` refuses a wheel that needs a library of the machine; this one does."""
    sys.path.insert(0, str(root / "tools/wheel"))
    try:
        import own_libraries
    finally:
        sys.path.remove(str(root / "tools/wheel"))
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    with pytest.raises(SystemExit, match=r"_core.* needs lib.*, which the wheel does not have"):
        own_libraries.check(tmp_path)
    (module,) = (tmp_path / "polhode").glob("_core*.so")
    own_libraries.add_promised_ones(tmp_path)
    assert {"libhdf5_serial", "libtbb", "libudunits2"} <= {
        path.name.split("-")[0] for path in (tmp_path / "polhode.libs").iterdir()}
    own_libraries.check(tmp_path)
    (tmp_path / "polhode.libs/libextra.so").write_bytes(module.read_bytes())
    with pytest.raises(SystemExit, match="nothing needs libextra.so"):
        own_libraries.check(tmp_path)


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
    (entry,) = (name for name in names if name.endswith("entry_points.txt"))
    assert entry.startswith("polhode-")


def test_a_source_distribution_holds_what_a_build_needs(root, tmp_path):
    with contextlib.chdir(root):
        name = build_sdist(str(tmp_path))
    with tarfile.open(tmp_path / name) as archive:
        files = {path.split("/", 1)[1] for path in archive.getnames() if "/" in path}
    assert {"pyproject.toml", "CMakeLists.txt", "python/CMakeLists.txt", "src/CMakeLists.txt",
            "include/polhode/version.hpp", "cmake/io-dependencies.cmake", "cmake/needs.cmake",
            "cli/completion.cpp", "LICENSE"} <= files
    assert not [path for path in files if path.startswith((".venv", "build/"))]
