# SPDX-License-Identifier: MIT
"""What each group of outputs is, and how one side makes it: files in a folder."""

import concurrent.futures
import hashlib
import os
import shutil
import signal
import subprocess

from bitwise.revision import HOME, ROOT, Failed

PROBES = ROOT / "tools/bitwise"
EXAMPLES = ROOT / "examples"
# A scenario that takes more processor time is skipped, and said to be.
SECONDS = 300
# The soft limit alone: at the hard one the signal is SIGKILL, as where memory ends.
LIMITED = ["sh", "-c", 'ulimit -S -t "$0"; exec "$@"']


def probe_sources(name):
    return [PROBES / f"{name}.cpp", PROBES / "cases.hpp", PROBES / "record.hpp"]


def scenarios_of(folder, maps):
    """Those that are maps, or those that are not."""
    return [path for path in sorted(folder.glob("*.toml"))
            if maps == ("\n[map]" in path.read_text(encoding="utf-8"))]


GROUPS = {
    "free": lambda: probe_sources("free"),
    "charts": lambda: probe_sources("charts"),
    "w1": lambda: probe_sources("w1"),
    "events": lambda: scenarios_of(PROBES / "scenarios", maps=False),
    "examples": lambda: scenarios_of(EXAMPLES, maps=False),
    "maps": lambda: scenarios_of(EXAMPLES, maps=True),
    "golden": lambda: [],
}


class TooLong(Failed):
    """Of a scenario it is no failure: it is skipped."""


def printed(command, path):
    """Standard output into a file; the status, and what was said, into another one."""
    words = [str(word) for word in command]
    with path.open("wb") as out:
        done = subprocess.run([*LIMITED, str(SECONDS), *words], stdout=out, cwd=path.parent,
                              stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
    if done.returncode == -signal.SIGXCPU:
        raise TooLong(f"{' '.join(words)}: takes more than {SECONDS} s of processor time")
    if done.returncode == -signal.SIGKILL:
        raise Failed(f"{' '.join(words)}: was killed; did the memory end?")
    if done.returncode != 0:
        said = done.stderr.decode(errors="replace").strip()
        path.with_suffix(".failed.txt").write_text(f"status {done.returncode}\n{said}\n")


def run_probe(side, name, folder):
    program = folder.with_suffix(".program")
    side.compile(PROBES / f"{name}.cpp", program)
    printed([program], folder / f"{name}.tsv")
    if (folder / f"{name}.failed.txt").exists():
        raise Failed(f"{name}: the probe of {side.name} failed: "
                     + (folder / f"{name}.failed.txt").read_text())


def run_scenario(side, command, path, folder):
    within = folder / path.stem
    within.mkdir()
    options = ["--out", "out.csv", "--out", "out.h5"]
    if "[[event]]" in path.read_text(encoding="utf-8"):
        options += ["--events", "events.csv"]
    try:
        printed([side.polhode, command, path, *options], within / "stdout.txt")
        if command == "run":
            printed([side.polhode, "info", path, "--json"], within / "info.json")
    except TooLong:
        shutil.rmtree(within)
        return [path.stem]
    return []


def run_group(side, group, folder):
    """The names that were skipped."""
    if group in ("free", "charts", "w1"):
        run_probe(side, group, folder)
    elif group == "golden":
        printed([side.polhode, "golden", folder / "golden"], folder / "stdout.txt")
        (folder / "stdout.txt").unlink()  # it names the folder
    elif group == "maps":  # which take every processor
        return [name for path in GROUPS[group]()
                for name in run_scenario(side, "map", path, folder)]
    else:
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            made = pool.map(lambda path: run_scenario(side, "run", path, folder), GROUPS[group]())
            return [name for names in made for name in names]
    return []


def digest(group):
    """Of all that the outputs of a revision depend on in addition to the revision."""
    text = hashlib.sha256()
    inputs = [PROBES / "outputs.py", PROBES / "revision.py", *GROUPS[group]()]
    if group in ("examples", "maps"):
        inputs += [path for path in sorted(EXAMPLES.rglob("*")) if path.is_file()]
    for path in inputs:
        text.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return text.hexdigest()[:12]


def outputs(side, group):
    """(folder, names that were skipped); those of a revision are kept for the next time."""
    keep = side.tree != ROOT
    name = f"{side.tree.name}-{digest(group)}" if keep else "working"
    folder = HOME / "outputs" / group / name
    whole = folder.with_suffix(".whole")
    if keep and whole.exists():
        return folder, []
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    names = run_group(side, group, folder)
    if keep and not names:
        whole.touch()
    return folder, names
