# SPDX-License-Identifier: MIT
"""A root directory with a Python and the C and C++ run-time libraries, and nothing else: none of
the libraries that polhode is built with can be found in it, nor a compiler, nor a network."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import time

# What a wheel may expect of any machine: the C and C++ run-time libraries. PEP 600 allows more,
# such as zlib and expat; ours needs none of that.
PROMISED = re.compile(r"(ld-linux-x86-64|libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s)"
                      r"\.so\.\d+$")
RUN_TIMES = ("libc.so.6", "libm.so.6", "libdl.so.2", "librt.so.1", "libpthread.so.0",
             "libstdc++.so.6", "libgcc_s.so.1")
# Python's own modules may bring these; a module that needs anything else is left out.
PYTHONS = re.compile(r"(libz|libexpat|libffi|libutil|libpython3\.\d+)\.so\.[\d.]+$")
WHERE = """
import json, sys, sysconfig
print(json.dumps([sys.base_prefix, sysconfig.get_path("stdlib"),
                  "%d.%d" % sys.version_info[:2]]))
"""
MOUNTS = ('mount --bind /dev "$1/dev" && mount -t proc proc "$1/proc" && root=$1 && shift && '
          'exec chroot "$root" "$@"')


class Missing(Exception):
    """What ldd cannot find."""


def shared_libraries(path):
    """soname -> path of all that a file loads."""
    said = subprocess.run(["ldd", path], text=True, capture_output=True).stdout
    found = {}
    for line in said.splitlines():
        words = line.split()
        if "not found" in line:
            raise Missing(f"{path}: {words[0]}")
        if "=>" in words:
            found[words[0]] = pathlib.Path(words[2])
        elif words and words[0].startswith("/"):
            found[pathlib.Path(words[0]).name] = pathlib.Path(words[0])
    return found


class BareRoot:
    def __init__(self, root, python):
        """Made of the installation that this interpreter belongs to."""
        self.root = root
        shutil.rmtree(root, ignore_errors=True)
        for name in ("dev", "proc", "tmp", "home", "usr/bin", "lib", "lib64", "etc"):
            (root / name).mkdir(parents=True)
        prefix, stdlib, version = json.loads(
            subprocess.run([python, "-c", WHERE], text=True, stdout=subprocess.PIPE,
                           check=True).stdout)
        self.python = pathlib.Path(prefix, "bin", f"python{version}").resolve()
        self.libraries = {}
        # all of the C library, and the C++ one: other wheels ask for what Python does not
        for name in RUN_TIMES:
            self.add_library(name, shared_library(name))
        self.add_file(self.python)
        for name, path in shared_libraries(self.python).items():
            self.add_library(name, path)
        self.add_standard_library(pathlib.Path(stdlib))
        bundled = pathlib.Path("/usr/share/python-wheels")  # Debian's pip for new environments
        if bundled.exists():
            shutil.copytree(bundled, root / bundled.relative_to("/"))

    def add_file(self, path):
        target = self.root / path.relative_to("/")
        target.parent.mkdir(parents=True, exist_ok=True)
        if not target.exists():
            shutil.copy(path, target)

    def add_library(self, name, path):
        if not (PROMISED.match(name) or PYTHONS.match(name)):
            raise Missing(name)
        self.libraries[name] = path
        folder = "lib64" if name.startswith("ld-linux") else "lib"
        if PYTHONS.match(name) and "libpython" in name:
            self.add_file(path.resolve())  # found by its rpath
        shutil.copy(path.resolve(), self.root / folder / name)

    def add_standard_library(self, stdlib):
        def left_out(folder, names):
            return {name for name in names
                    if name in ("site-packages", "dist-packages", "test", "__pycache__")
                    or name.startswith("config-")}

        target = self.root / stdlib.relative_to("/")
        shutil.copytree(stdlib, target, ignore=left_out, symlinks=False)
        for module in (target / "lib-dynload").glob("*.so"):
            try:
                for name, path in shared_libraries(module).items():
                    self.add_library(name, path)
            except Missing:
                module.unlink()

    def path(self, inside):
        return self.root / str(inside).lstrip("/")

    def run(self, *command, status=0):
        """Output and seconds of a command inside: no network, an environment of its own."""
        unshare = ["unshare", "--mount", "--net", "--pid", "--fork"]
        if os.getuid() != 0:
            unshare.append("--map-root-user")
        begin = time.perf_counter()
        done = subprocess.run(
            [*unshare, "sh", "-c", MOUNTS, "sh", str(self.root), *map(str, command)], text=True,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            env={"HOME": "/home", "PATH": "/usr/bin:/bin:/usr/sbin:/sbin", "LANG": "C.UTF-8",
                 "TMPDIR": "/tmp", "PIP_DISABLE_PIP_VERSION_CHECK": "1"})
        seconds = time.perf_counter() - begin
        if (done.returncode == 0) != (status == 0):
            raise SystemExit(f"wheel: in the bare root: {' '.join(map(str, command))}: exit status "
                             f"{done.returncode}\n{done.stdout}")
        return done.stdout, seconds


def shared_library(name):
    """Where the dynamic linker finds one."""
    listed = subprocess.run(["/sbin/ldconfig", "-p"], text=True, capture_output=True).stdout
    for line in listed.splitlines():
        if line.split()[:1] == [name] and "x86-64" in line:
            return pathlib.Path(line.split()[-1])
    raise Missing(name)
