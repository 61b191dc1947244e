#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Layers: who may include whom. Fails on a forbidden include, an unknown folder, a cycle of headers
or of Python modules, a public header with a detail of its own, or a folder with too many sources.

A header of include/polhode/LAYER is for users. One of src/LAYER is for the other layers that may
include this one; if a public header needs it, it is in include/polhode/detail/LAYER and installed.
A header in a folder LAYER/detail, installed or not, is for its own layer only."""

import ast
import graphlib
import importlib.util
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]

# Layer -> layers it may include besides itself; "*" is every layer above it in this table. A layer
# names only layers above it, so the graph of layers has no cycle.
LAYERS = {
    "math": "",
    "elliptic": "math",
    "ode": "math",
    "series": "math",
    "orbit": "math",
    "rotor": "math",
    "free": "math elliptic rotor",
    "frame": "math orbit",
    "shape": "math rotor",
    "light": "math rotor shape",
    "perturb": "math rotor orbit frame shape",
    "system": "math rotor free orbit frame perturb",
    "trajectory": "math rotor system",
    "dynamics": "math ode rotor free orbit frame perturb system trajectory",
    "secular": "*",
    "analysis": "*",
    "ephemeris": "math orbit frame",
    "ensemble": "*",
    "fit": "*",
    "text": "*",
    "tables": "*",
    "output": "*",
    "scenario": "*",
    "run": "*",
    "mpi": "ensemble",
    "cli": "*",
}
# Those of polhode::io, which read and write files.
IO = {"text", "tables", "output", "scenario", "run"}
# Those that know public headers alone, and have headers of their own beside them.
PROGRAMS = {"cli", "web"}
# Installed for templates of public headers, not for users.
SHARED = "polhode/detail/"
# Those that wait for others, and have a clock to sleep by.
WAITS = {"mpi"}
# Headers that belong to no layer, for everybody.
TOP = {"polhode/error.hpp", "polhode/version.hpp"}
# Those whose headers in src/ are for their own layer alone: others use the public ones.
PRIVATE = {"scenario"}
# Other people's libraries, by the folder of src/ that may use them. Public headers use none.
THIRD_PARTY = {
    "series": r"boost/multiprecision/",
    "rotor": r"Eigen/",
    "perturb": r"Eigen/",
    "light": r"Eigen/",
    "analysis": r"(unsupported/)?Eigen/",
    "ephemeris": r"erfa\.h",
    "ensemble": r"tbb/|Random123/|Eigen/|boost/random/sobol\.hpp",
    "fit": r"(unsupported/)?Eigen/|boost/math/tools/",
    "mpi": r"mpi\.h|tbb/",
    "text": r"udunits2\.h",
    "tables": r"zlib\.h",
    "output": r"hdf5\.h|(unistd|fcntl)\.h|sys/(stat|uio)\.h",
    "scenario": r"toml\+\+/|fmt/",
    "run": r"fmt/|(unistd|fcntl)\.h|sys/stat\.h",
    "cli": r"CLI/|fmt/|(unistd|fcntl|signal)\.h|sys/",
}
# The one header with the instructions of a processor.
INSTRUCTIONS = "include/polhode/math/detail/registers.hpp"
# The library neither prints nor starts threads; only polhode::io reads and writes files.
NOT_IN_CORE = {"iostream", "fstream", "filesystem", "thread", "mutex", "future"}
NOT_IN_LIBRARY = {"iostream"}

# What namespace detail of a public header may hold: names that its classes point to.
DETAILS = re.compile(r"^namespace detail \{$(.*?)^\}  // namespace detail$",
                     re.MULTILINE | re.DOTALL)
DECLARATIONS = re.compile(r"(\s*(class|struct) \w+;)*\s*")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def allowed_layers():
    allowed, above = {}, []
    for layer, names in LAYERS.items():
        allowed[layer] = set(above if names == "*" else names.split())
        unknown = allowed[layer] - set(above)
        if unknown:
            sys.exit(f"tools/layers.py: {layer} names {unknown}, which is not above it")
        allowed[layer].add(layer)
        above.append(layer)
    allowed["cli"] = set(above)
    allowed["web"] = set(above) - {"mpi", "cli"}
    return allowed


def layer_of(path):
    """The layer of a source file; None for those that belong to no layer."""
    parts = path.relative_to(ROOT).parts
    if parts[0] in PROGRAMS:
        return parts[0]
    inner = parts[2:] if parts[0] == "include" else parts[1:]
    inner = inner[1:] if inner[0] == "detail" else inner  # include/polhode/detail/LAYER
    return inner[0] if len(inner) > 1 else None


def complaint(path, layer, bracket, name, allowed):
    """What is wrong with one include, or None."""
    public = path.is_relative_to(ROOT / "include")
    if bracket == "<":
        if "." not in name and "/" not in name:
            banned = NOT_IN_LIBRARY if layer in IO else NOT_IN_CORE - (
                {"thread"} if layer in WAITS else set())
            return f"<{name}> is not for this layer" if layer != "cli" and name in banned else None
        pattern = THIRD_PARTY.get(layer)
        if name.endswith(("mmintrin.h", "arm_neon.h")) and path == ROOT / INSTRUCTIONS:
            return None
        if not public and pattern and re.match(pattern, name):
            return None
        return f"<{name}> is not for this file"
    if name in TOP or (layer == "cli" and name == "polhode/polhode.hpp"):
        return None
    parts = name.removeprefix(SHARED).split("/")
    if name.startswith(SHARED):
        target = parts[0]
        if layer == "cli":
            return f'"{name}" is private to the library'
    elif parts[0] == "polhode" and len(parts) > 2:
        target = parts[1]
    elif layer in PROGRAMS:
        return None if len(parts) == 1 else f'"{name}" is private to the library'
    elif not public and len(parts) > 1:
        target = parts[0]
    else:
        return f'"{name}": write it from the root, "polhode/<layer>/..." or "<layer>/detail/..."'
    if target not in LAYERS:
        return f'"{name}": no such layer'
    if target not in allowed[layer]:
        return f'"{name}": {layer} may not include {target}'
    private = target in PRIVATE and not name.startswith("polhode/")
    if target != layer and ("detail" in parts or private):
        return f'"{name}" is for {target} alone'
    return None


def detail_complaint(path, layer, text):
    """Whether a public header holds what belongs into a header of detail/."""
    public = path.is_relative_to(ROOT / "include")
    if not public or "detail" in path.parts:
        return None
    if all(DECLARATIONS.fullmatch(body) for body in DETAILS.findall(text)):
        return None
    return f"what is in namespace detail belongs into include/polhode/{layer}/detail/"


def resolved(name):
    for base in ("include", "src", "cli", "web/core"):
        if (ROOT / base / name).exists():
            return ROOT / base / name
    return None


def python_imports():
    """Module of the Python package -> modules of it that it imports, also within functions and for
    type checkers alone."""
    base, graph = ROOT / "python", {}
    modules = {
        ".".join(path.relative_to(base).with_suffix("").parts).removesuffix(".__init__"): path
        for path in sorted((base / "polhode").rglob("*.py"))
    }
    inner = {*modules, "polhode._core"}  # the extension imports none of them
    for module, path in modules.items():
        package = module if path.name == "__init__.py" else module.rpartition(".")[0]
        found = graph[module] = set()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                found |= {alias.name for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                of = "." * node.level + (node.module or "")
                of = importlib.util.resolve_name(of, package)
                names = {f"{of}.{alias.name}" for alias in node.names}
                found |= names & inner
                if names - inner:
                    found.add(of)
        found &= modules.keys()
    return graph


def cycle_in(graph):
    """The nodes around a cycle, each followed by one that it names; empty without one."""
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as cycle:
        return cycle.args[1][::-1]
    return []


def main():
    allowed, errors, graph = allowed_layers(), [], {}
    files = [p for base in ("include", "src", "cli", "web/core")
             for p in sorted((ROOT / base).rglob("*.[ch]pp"))]
    for path in files:
        where, layer = path.relative_to(ROOT), layer_of(path)
        text = path.read_text(encoding="utf-8", errors="replace")
        includes = INCLUDE.findall(text)
        graph[path] = {r for b, n in includes if b == '"' and (r := resolved(n))}
        if layer is None:
            continue
        if layer not in allowed:
            errors.append(f"{where}: unknown layer {layer}")
            continue
        found = (complaint(path, layer, bracket, name, allowed) for bracket, name in includes)
        errors += [f"{where}: {message}" for message in found if message]
        if message := detail_complaint(path, layer, text):
            errors.append(f"{where}: {message}")
    headers = [str(path.relative_to(ROOT)) for path in cycle_in(graph)]
    for cycle in (headers, cycle_in(python_imports())):
        errors += ["cycle: " + " -> ".join(cycle)] if cycle else []
    print("\n".join(errors), end="\n" if errors else "")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
