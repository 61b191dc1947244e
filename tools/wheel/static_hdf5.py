# SPDX-License-Identifier: MIT
"""HDF5 as it stands in a wheel's module itself: static, compiled from the distribution's source
package without S3 and szip, which polhode does not use.

The distribution's shared library reads from S3 and so brings libcurl, Kerberos, LDAP and 27 more
along; its static one is not position independent. docs/design/0027-wheel.md has the sizes."""

import os
import pathlib
import re
import shutil
import subprocess
import tarfile

# Whose version is taken: what polhode is tested with.
INSTALLED = "libhdf5-dev"
OPTIONS = ("--quiet", "--disable-shared", "--with-pic", "--enable-build-mode=production",
           "--enable-threadsafe", "--with-zlib", "--without-szlib", "--disable-hl",
           "--disable-tests", "--disable-tools", "CFLAGS=-O2")


def run(*command, cwd=None, **variables):
    done = subprocess.run(list(map(str, command)), cwd=cwd, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          env=dict(os.environ, **variables))
    if done.returncode:
        raise SystemExit(f"wheel: {' '.join(map(str, command))}\n{done.stdout}")
    return done.stdout


def source_lists(folder):
    """The distribution's package sources, as this machine has them, for source packages."""
    lists = folder / "sources"
    lists.mkdir()
    etc = pathlib.Path("/etc/apt")
    for path in [etc / "sources.list", *sorted((etc / "sources.list.d").glob("*"))]:
        if path.suffix == ".sources":
            text = re.sub(r"(?m)^Types:.*$", "Types: deb-src", path.read_text())
        elif path.suffix == ".list" and path.exists():
            text = re.sub(r"(?m)^deb ", "deb-src ", path.read_text())
        else:
            continue
        (lists / path.name).write_text(text)
    return lists


def download(folder):
    """The archive of the sources; apt-get checks it by the distribution's signature."""
    (folder / "lists/partial").mkdir(parents=True)
    apt = ["-q", "-o", "Dir::Etc::sourcelist=/dev/null",
           "-o", f"Dir::Etc::sourceparts={source_lists(folder)}",
           "-o", f"Dir::State::lists={folder / 'lists'}",
           "-o", "APT::Sandbox::User=", "-o", "Acquire::Retries=3"]
    run("apt-get", *apt, "update")
    version = run("dpkg-query", "-W", "-f", "${source:Version}", INSTALLED)
    run("apt-get", *apt, "source", "--download-only", f"hdf5={version}", cwd=folder)
    (archive,) = folder.glob("hdf5_*.orig.tar.*")
    return archive


def static_hdf5(folder):
    """The prefix in which it is installed, with what pkg-config needs; made once."""
    prefix, complete = folder / "prefix", folder / "complete"
    if complete.exists():
        return prefix
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    with tarfile.open(download(folder)) as tar:
        tar.extractall(folder)
    (source,) = (path for path in folder.glob("hdf5-*") if path.is_dir())
    version = re.match(r"hdf5-([\d.]*\d)", source.name).group(1)
    print(f"wheel: HDF5 {version}, static, from the distribution's source package", flush=True)
    run(source / "configure", f"--prefix={prefix}", *OPTIONS, cwd=source)
    run("make", "-C", source / "src", "-j", os.cpu_count(), "install")
    shutil.copy(source / "COPYING", prefix)
    (prefix / "lib/pkgconfig").mkdir(exist_ok=True)
    (prefix / "lib/pkgconfig/hdf5-serial.pc").write_text(
        f"Name: hdf5-serial\nDescription: static, for wheels\nVersion: {version}\n"
        f"Libs: -L{prefix}/lib -lhdf5 -lz -ldl -lm -lpthread\nCflags: -I{prefix}/include\n")
    complete.touch()
    return prefix
