# SPDX-License-Identifier: MIT
# The library and the command line for Spack; packaging/filled.py puts in what a release decides.
from spack.package import *

# ruff: noqa: F403, F405
from spack_repo.builtin.build_systems.cmake import CMakePackage


class Polhode(CMakePackage):
    """Rotation of rigid bodies, exact when nothing acts on them, accurate under any torque, in
    Serret-Andoyer and every related variable set: C++20 library and command line."""

    homepage = "@HOMEPAGE@"
    url = "@URL@"

    maintainers("@MAINTAINER@")
    license("MIT")

    version("@VERSION@", sha256="@SHA256@")

    variant("io", default=True, description="Scenarios, units, files, maps, the command line")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("eigen@3.4:", type="build")
    depends_on("boost@1.74:", type="build")
    with when("+io"):
        depends_on("pkgconfig", type=("build", "link"))
        depends_on("erfa")
        depends_on("tbb")
        depends_on("random123", type="build")
        depends_on("fmt")
        depends_on("zlib-api")
        depends_on("hdf5+threadsafe~mpi")
        depends_on("tomlplusplus", type="build")
        depends_on("udunits")
        depends_on("cli11", type="build")

    conflicts("%gcc@:11", msg="C++20 as of g++ 12")
    conflicts("%clang@:15", msg="C++20 as of clang 16")

    def cmake_args(self):
        args = [
            self.define("POLHODE_TESTS", False),
            self.define("POLHODE_WERROR", False),
        ]
        for part in ("IO", "EPHEMERIS", "ENSEMBLE", "CLI"):
            args.append(self.define_from_variant(f"POLHODE_{part}", "io"))
        return args
