# SPDX-License-Identifier: MIT
"""The recipes of packaging/: their syntax, that they need what CMake looks for, and that the
options they give exist and configure a source distribution."""

import ast
import contextlib
import importlib.util
import pathlib
import re
import shutil
import subprocess
import tarfile

import pytest
import yaml
from scikit_build_core.build import build_sdist
from shell import sh

# What cmake/needs.cmake calls by Debian's names, elsewhere.
CONDA = {"libeigen3-dev": "eigen", "libboost-dev": "libboost-headers", "liberfa-dev": "erfa",
         "libtbb-dev": "tbb-devel", "librandom123-dev": "random123", "libfmt-dev": "fmt",
         "zlib1g-dev": "zlib", "libhdf5-dev": "hdf5", "libtomlplusplus-dev": "tomlplusplus",
         "libudunits2-dev": "udunits2", "libcli11-dev": "cli11", "python3-dev": "python",
         "pkg-config": "pkg-config", "g++": '${{ compiler("cxx") }}'}
SPACK = CONDA | {"libboost-dev": "boost", "libtbb-dev": "tbb", "zlib1g-dev": "zlib-api",
                 "libudunits2-dev": "udunits", "pkg-config": "pkgconfig", "g++": "cxx"}
SECTIONS = {"schema_version", "context", "package", "source", "build", "requirements", "tests",
            "about", "extra"}
VALUES = {"VERSION": "0.1.0", "URL": "https://example.org/polhode-0.1.0.tar.gz",
          "HOMEPAGE": "https://example.org", "MAINTAINER": "somebody", "SHA256": "0" * 64}


@pytest.fixture(scope="module")
def recipes(root):
    """packaging/filled.py, imported."""
    spec = importlib.util.spec_from_file_location("filled", root / "packaging/filled.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def needed(root):
    """Debian's names of all that CMake looks for."""
    text = (root / "cmake/needs.cmake").read_text()
    return {name for name in CONDA if re.search(rf"[ (]{re.escape(name)}[ )\n]", text)}


@pytest.fixture(scope="module")
def source(root, tmp_path_factory):
    """A source distribution, unpacked."""
    folder = tmp_path_factory.mktemp("source")
    with contextlib.chdir(root):
        name = build_sdist(str(folder))
    with tarfile.open(folder / name) as archive:
        archive.extractall(folder)
    return folder / name, folder / name.removesuffix(".tar.gz")


def configures(source, folder, options):
    said = sh("cmake", "-S", source, "-B", folder, "-G", "Ninja", *options)
    assert "were not used by the project" not in said, said


def test_the_list_of_needs_is_whole(root, needed):
    text = (root / "cmake/needs.cmake").read_text()
    asked = {name for name in re.findall(r"polhode_need\(\S+ \"[^\"]*\" (\S+)", text)}
    assert asked - {"libopenmpi-dev"} <= needed == set(CONDA)  # of POLHODE_MPI, which no recipe has


def test_conda_forge(root, recipes, needed, source, tmp_path):
    text = recipes.filled((root / "packaging/conda-forge/recipe.yaml").read_text(), VALUES)
    recipe = yaml.safe_load(text)
    assert set(recipe) == SECTIONS and recipe["schema_version"] == 1
    assert recipe["context"]["version"] == "0.1.0" and recipe["source"]["sha256"] == "0" * 64
    asked = [one.split(" >=")[0] for part in ("build", "host")
             for one in recipe["requirements"][part]]
    assert {CONDA[name] for name in needed} <= set(asked) and len(set(asked)) == len(asked)
    assert set(asked) - set(CONDA.values()) == {
        '${{ stdlib("c") }}', "cmake", "ninja", "pip", "nanobind", "scikit-build-core"}
    project = (root / "pyproject.toml").read_text()
    for one in [*recipe["requirements"]["run"][1:], "nanobind >=2.4", "scikit-build-core >=0.10"]:
        assert f'"{one.replace(" ", "")}"' in project
    script = recipe["build"]["script"]
    configures(source[1], tmp_path / "b", re.findall(r"-D\w+=\w+", script[0]))
    installed = [path for line in recipe["tests"][0]["script"]
                 for path in re.findall(r"\$\{PREFIX\}/(\S+)", line)]
    assert installed == ["lib/cmake/polhode/polhode-config.cmake"]


class Spack:
    """A stand-in for the directives of a recipe, which writes down what they say."""

    def __init__(self):
        self.said = []

    def names(self):
        given = {name: lambda *a, name=name, **k: self.said.append((name, a, k))
                 for name in ("maintainers", "license", "version", "variant", "depends_on",
                              "conflicts")}
        return given | {"when": lambda spec: contextlib.nullcontext(), "CMakePackage": object}

    def of(self, name):
        return [arguments for said, arguments, _ in self.said if said == name]


def test_spack(root, recipes, needed, source, tmp_path):
    text = recipes.filled((root / "packaging/spack/package.py").read_text(), VALUES)
    tree = ast.parse(text)
    tree.body = [one for one in tree.body if not isinstance(one, ast.ImportFrom)]
    spack = Spack()
    names = spack.names()
    exec(compile(tree, "package.py", "exec"), names)  # noqa: S102
    asked = {re.split(r"[@+~]", spec)[0] for (spec,) in spack.of("depends_on")}
    assert asked == {SPACK[name] for name in needed - {"python3-dev"}} | {"cmake"}
    assert spack.of("version") == [("0.1.0",)]
    package = names["Polhode"]()
    package.define = lambda name, value: f"-D{name}={'ON' if value else 'OFF'}"
    for io in (True, False):
        package.define_from_variant = lambda name, variant, io=io: package.define(name, io)
        configures(source[1], tmp_path / str(io), package.cmake_args())


def test_container(root, needed, tmp_path, polhode):
    """Debian's packages of build and program, and that what is copied is enough to configure."""
    build, program = (root / "packaging/container/Containerfile").read_text().split("\nFROM ")[1:]
    installed = [set(part.split("--no-install-recommends")[1].split("&&")[0].split())
                 for part in (build, program)]
    assert needed - {"python3-dev"} | {"libopenmpi-dev", "cmake", "ninja-build"} <= installed[0]
    context = tmp_path / "polhode"
    context.mkdir()
    for names, to in re.findall(r"^COPY ([^-\n]+) /polhode/(\S*)$", build, re.MULTILINE):
        for name in names.split():
            copy = shutil.copytree if (root / name).is_dir() else shutil.copy
            copy(root / name, context / to)
    configures(context, tmp_path / "build", re.findall(r"-D\w+=\w+", build))
    if not pathlib.Path("/etc/debian_version").read_text().startswith("12"):
        return  # names of another Debian
    loaded = subprocess.run(["objdump", "-p", polhode], capture_output=True, text=True, check=True)
    for library in re.findall(r"NEEDED +(\S+)", loaded.stdout):
        said = subprocess.run(["dpkg", "-S", library], capture_output=True, text=True, check=True)
        owners = {line.split(":")[0] for line in said.stdout.splitlines()}
        assert owners & (installed[1] | {"libc6", "libgcc-s1"}), library  # of every Debian


def test_a_release_fills_everything_in(root, recipes, source, tmp_path):
    values = recipes.values_of(source[0], "URL", "HOMEPAGE", "SOMEBODY")
    assert len(values["SHA256"]) == 64 and values["VERSION"] in source[0].name
    for recipe in recipes.RECIPES:
        assert "@" not in re.sub(r"@[\d.:]+", "", recipes.filled(
            (root / "packaging" / recipe).read_text(), values))
        with pytest.raises(ValueError, match="@SHA256@ left"):
            recipes.filled("@SHA256@ @URL@", {"URL": "x"})
    other = tmp_path / "other.tar.gz"
    shutil.copy(source[0], other)
    with pytest.raises(ValueError, match="is no polhode-VERSION"):
        recipes.values_of(other, "", "", "")
