# SPDX-License-Identifier: MIT
"""Where and with what the numbers were measured."""

import importlib.metadata
import os
import pathlib
import platform
import subprocess

PACKAGES = ("libboost-dev", "libgsl-dev", "libgeographiclib-dev", "libhdf5-dev")
PYTHON = ("numpy", "scipy", "heyoka", "rebound")


def _said(*command):
    try:
        return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def _cpu():
    text = pathlib.Path("/proc/cpuinfo")
    lines = text.read_text().splitlines() if text.exists() else []
    facts = dict(line.split("\t: ", 1) for line in lines if "\t: " in line)
    facts = {name.strip(): value for name, value in facts.items()}
    sets = facts.get("flags", "").split()
    return {"model": facts.get("model name", platform.processor()),
            "sets": [s for s in ("avx2", "fma", "avx512f") if s in sets]}


def description():
    versions = {}
    for name in PYTHON:
        try:
            versions[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            versions[name] = None
    for name in PACKAGES:
        versions[name] = _said("dpkg-query", "-W", "-f", "${Version}", name) or None
    release = pathlib.Path("/etc/os-release").read_text().splitlines()
    system = dict(line.split("=", 1) for line in release if "=" in line)
    return {"cpu": _cpu(), "cores": os.cpu_count(), "load": os.getloadavg()[0],
            "system": system.get("PRETTY_NAME", "").strip('"'),
            "compiler": (_said("g++", "--version").splitlines() or [""])[0],
            "python": platform.python_version(), "versions": versions}


def revision(root):
    name = _said("git", "-C", str(root), "rev-parse", "--short=10", "HEAD")
    changed = _said("git", "-C", str(root), "status", "--porcelain", "--untracked-files=no")
    return name + ("+" if changed else "")
