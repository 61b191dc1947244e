# SPDX-License-Identifier: MIT
"""What polhode is built with: CMake names all that is missing at once, the page lists what is
installed, and its CMake lines link."""

import os
import re
import shutil
import subprocess

import pytest
from shell import sh

LISTS = ("-DPOLHODE_TESTS=OFF", "-DPOLHODE_PYTHON=ON")
# CMake finds nothing in /usr, not even by way of PATH
NO_SYSTEM = ("-DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF",
             "-DCMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH=OFF")
# small programs, one with polhode::io: what is tested is that they link
SOURCES = {
    "core": '#include <cstdio>\n#include "polhode/version.hpp"\n'
            "int main() { std::puts(polhode::version()); }\n",
    "io": '#include <cstdio>\n#include "polhode/text/units.hpp"\n'
          'int main() { std::puts(polhode::io::Units("h").time().c_str()); }\n',
}


def configured(root, folder, *options, status=0, **variables):
    done = subprocess.run(["cmake", "-S", root, "-B", folder, "-G", "Ninja", *options], text=True,
                          env=dict(os.environ, **variables), stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert (done.returncode == 0) == (status == 0), done.stdout
    return done.stdout


def to_install(said):
    (line,) = re.findall(r"To install: sudo apt-get install (.*)", said)
    return line.split()


def page(root):
    return (root / "docs/start/install.md").read_text()


def packages_of_script(root):
    text = (root / "tools/install-deps").read_text()
    return re.search(r'(?s)packages="(.*?)"', text).group(1).split()


def packages_of_page(root):
    """Those of the command that installs what the package needs, and those of the table."""
    command = re.search(r"(?s)sudo apt-get install (.*?)\n```", page(root)).group(1)
    table = page(root).split("| packages |")[1].split("\n\n")[0]
    listed = [name for row in table.splitlines()[2:]
              for name in re.findall(r"`([^`]+)`", row.split("|")[1])]
    return command.replace("\\", " ").split(), listed


@pytest.fixture(scope="module")
def said_on_a_bare_machine(root, tmp_path_factory):
    """With a compiler, but with none of the system's libraries."""
    return configured(root, tmp_path_factory.mktemp("bare"), *LISTS, "-DPOLHODE_CLI=ON",
                      *NO_SYSTEM, f"-DCMAKE_MAKE_PROGRAM={shutil.which('ninja')}", status=1,
                      CXX=shutil.which("c++"), PKG_CONFIG=shutil.which("pkg-config"),
                      PKG_CONFIG_LIBDIR="/nonexistent", PKG_CONFIG_PATH="")


def test_all_that_is_missing_is_named_at_once(said_on_a_bare_machine):
    said = said_on_a_bare_machine
    missing = to_install(said)
    assert {"libeigen3-dev", "libboost-dev", "liberfa-dev", "libtbb-dev", "librandom123-dev",
            "libfmt-dev", "zlib1g-dev", "libtomlplusplus-dev", "libhdf5-dev", "libudunits2-dev",
            "libcli11-dev"} <= set(missing)
    assert f"polhode: {len(missing)} missing" in said and "make deps" in said
    for package in missing:
        assert re.search(rf"(?m)^  \S.*: {re.escape(package)}$", said), package
    assert "g++" not in missing and "pkg-config" not in missing


def test_a_library_that_is_there_is_not_named(root, tmp_path):
    said = configured(root, tmp_path, *LISTS, "-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON",
                      "-DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON", status=1)
    assert to_install(said) == ["libtbb-dev", "libfmt-dev"]


def test_a_compiler_and_pkg_config_are_named_with_the_rest(root, tmp_path):
    (tmp_path / "bin").mkdir()
    for tool in ("cmake", "ninja", "sh"):
        (tmp_path / "bin" / tool).symlink_to(shutil.which(tool))
    said = configured(root, tmp_path / "build", "-DPOLHODE_TESTS=OFF",
                      NO_SYSTEM[0], status=1, PATH=str(tmp_path / "bin"), CXX="", CC="",
                      PKG_CONFIG="")
    missing = to_install(said)
    assert missing[0] == "g++" and "pkg-config" in missing and "libhdf5-dev" in missing
    assert "libeigen3-dev" in missing and "CMAKE_CXX_COMPILER-NOTFOUND" not in said


def test_the_page_lists_what_is_needed_and_what_is_installed(root, said_on_a_bare_machine):
    command, table = packages_of_page(root)
    installed = packages_of_script(root)
    assert sorted(table) == sorted(installed)  # the table of the page, tools/install-deps
    assert len(set(table)) == len(table)
    assert set(to_install(said_on_a_bare_machine)) <= set(command) <= set(installed)
    needs = (root / "cmake/needs.cmake").read_text()
    named = {name for name in installed if re.search(rf"[ (]{re.escape(name)}[ )\n]", needs)}
    # and what turns sources into a package: pip brings CMake and Ninja where they are missing
    assert named - {"libopenmpi-dev"} | {"cmake", "ninja-build", "python3-venv"} == set(command)


BLOCKS = [("docs/start/install.md", "core", 0), ("docs/start/install.md", "io", 1)]


@pytest.mark.parametrize("name, source, number", BLOCKS)
def test_the_cmake_lines_of_a_page_link(root, prefix, tmp_path, name, source, number):
    blocks = re.findall(r"(?s)```cmake\n(.*?)```", (root / name).read_text())
    assert len(blocks) == sum(one == name for one, _, _ in BLOCKS)
    (tmp_path / "main.cpp").write_text(SOURCES[source])
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(yours LANGUAGES CXX)\n"
        f"add_executable(yours main.cpp)\n{blocks[number]}")
    sh("cmake", "-S", tmp_path, "-B", tmp_path / "build", "-G", "Ninja",
       f"-DCMAKE_PREFIX_PATH={prefix}")
    sh("cmake", "--build", tmp_path / "build")
    assert sh(tmp_path / "build/yours").strip()


def found(prefix, folder, call, status=0):
    folder.mkdir()
    (folder / "CMakeLists.txt").write_text(
        f"cmake_minimum_required(VERSION 3.25)\nproject(yours LANGUAGES CXX)\n{call}\n"
        "message(STATUS \"found: ${polhode_FOUND}\")\n")
    said = sh("cmake", "-S", folder, "-B", folder / "build", "-G", "Ninja",
              f"-DCMAKE_PREFIX_PATH={prefix}", status=status)
    return " ".join(said.split())


def test_an_unknown_component_says_which_there_are(prefix, tmp_path):
    said = found(prefix, tmp_path / "a", "find_package(polhode REQUIRED COMPONENTS io graphics)", 1)
    assert ('got component "graphics"; expected one of: core, ephemeris, ensemble, fit, mpi, io, '
            'cli') in said
    said = found(prefix, tmp_path / "b", "find_package(polhode OPTIONAL_COMPONENTS graphics)")
    assert "found: 1" in said
    said = found(prefix, tmp_path / "c", "find_package(polhode QUIET COMPONENTS graphics)")
    assert re.search("found: (0|FALSE)", said), said


def test_a_component_that_was_not_installed_says_which_were(root, tmp_path):
    """A library without files and units."""
    configured(root, tmp_path / "core", "-DPOLHODE_IO=OFF", "-DPOLHODE_CLI=OFF",
               "-DPOLHODE_TESTS=OFF", "-DPOLHODE_EPHEMERIS=OFF", "-DPOLHODE_ENSEMBLE=OFF",
               "-DPOLHODE_FIT=OFF")
    package = tmp_path / "prefix/lib/cmake/polhode"
    package.mkdir(parents=True)
    for name in ("polhode-config.cmake", "polhode-config-version.cmake"):
        (package / name).write_text((tmp_path / "core" / name).read_text())
    (package / "polhode-core.cmake").write_text("add_library(polhode::polhode IMPORTED STATIC)\n")
    said = found(tmp_path / "prefix", tmp_path / "a",
                 "find_package(polhode COMPONENTS io REQUIRED)", 1)
    assert 'component "io" is not part of this installation, which has: core' in said
