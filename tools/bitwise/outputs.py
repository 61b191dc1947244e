# SPDX-License-Identifier: MIT
"""What each group of outputs is, and how one side makes it: files in a folder."""

import concurrent.futures
import hashlib
import os
import re
import shutil
import signal
import subprocess

from bitwise import messages, revision
from bitwise.revision import HOME, ROOT, Failed, files_of

# A scenario that takes more processor time is skipped, and said to be.
SECONDS = 300
# The soft limit alone: at the hard one the signal is SIGKILL, as where memory ends.
LIMITED = ["sh", "-c", 'ulimit -S -t "$0"; exec "$@"']
PROBES = ("free", "charts", "w1")
COMMANDS = "tools/bitwise/commands.toml"
MESSAGES = "tools/bitwise/messages.toml"
CALLS = "tools/bitwise/calls.py"


def scenarios_of(pattern, maps):
    """Those that are maps, or those that are not."""
    return [path for path in sorted(ROOT.glob(pattern))
            if maps == ("\n[map]" in path.read_text(encoding="utf-8"))]


SCENARIOS = {
    "events": lambda: scenarios_of("tools/bitwise/scenarios/events-*.toml", maps=False),
    "examples": lambda: scenarios_of("examples/*.toml", maps=False),
    "maps": lambda: scenarios_of("examples/*.toml", maps=True),
}
PYTHON_TESTS = "python/tests"
GROUPS = (*PROBES, *SCENARIOS, "golden", *revision.table_of(ROOT / COMMANDS), "messages", "python")


def inputs_of(group):
    """Files and folders of the checkout that a group reads."""
    if group in PROBES:
        return [f"tools/bitwise/{name}" for name in (f"{group}.cpp", "cases.hpp", "record.hpp")]
    return {"golden": [], "messages": [MESSAGES],
            "python": [CALLS, PYTHON_TESTS, "tests/slowdown.py", "examples"]}.get(
                group, ["examples", "tools/bitwise/scenarios", COMMANDS])


class TooLong(Failed):
    """Of a scenario it is no failure: it is skipped."""


def printed(command, path, **options):
    """Standard output into a file; the status, and what was said, into another one."""
    words = [str(word) for word in command]
    with path.open("wb") as out:
        done = subprocess.run([*LIMITED, str(SECONDS), *words], stdout=out, cwd=path.parent,
                              stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, **options)
    if done.returncode == -signal.SIGXCPU:
        raise TooLong(f"{' '.join(words)}: takes more than {SECONDS} s of processor time")
    if done.returncode == -signal.SIGKILL:
        raise Failed(f"{' '.join(words)}: was killed; did the memory end?")
    if done.returncode != 0:
        said = done.stderr.decode(errors="replace").strip()
        path.with_suffix(".failed.txt").write_text(f"status {done.returncode}\n{said}\n")


def require_success(name, side, path):
    """For our own programs; a failure of the command line is an output."""
    failed = path.with_suffix(".failed.txt")
    if failed.exists():
        raise Failed(f"{name}: the program of {side.name} failed: {failed.read_text()}")


def run_probe(side, name, folder):
    program = folder.with_suffix(".program")
    side.compile(side.inputs / f"tools/bitwise/{name}.cpp", program)
    printed([program], folder / f"{name}.tsv")
    require_success(name, side, folder / f"{name}.tsv")


def run_calls(side, folder):
    """Calls of the Python package of this side."""
    environment = {**os.environ, "PYTHONPATH": str(side.build / "python"), "MPLBACKEND": "agg",
                   "PYTHONHASHSEED": "0", "PYTHONDONTWRITEBYTECODE": "1"}
    printed([revision.PYTHON, side.inputs / CALLS], folder / "python.tsv", env=environment)
    require_success("python", side, folder / "python.tsv")


def run_scenario(side, command, path, folder):
    within = folder / path.stem
    within.mkdir()
    scenario = f"../in/{path.name}"
    options = ["--out", "out.csv", "--out", "out.h5"]
    if "[[event]]" in (folder / "in" / path.name).read_text(encoding="utf-8"):
        options += ["--events", "events.csv"]
    try:
        printed(side.command(command, scenario, *options), within / "stdout.txt")
        if command == "run":
            printed(side.command("info", scenario, "--json"), within / "info.json")
    except TooLong:
        shutil.rmtree(within)
        return [path.stem]
    return []


# For the scripts of commands.toml: `killed` kills a command soon after its first checkpoint.
FUNCTIONS = """
killed() {
  "$@" > /dev/null 2>&1 &
  while kill -0 $! 2> /dev/null && ! ls *.checkpoint > /dev/null 2>&1; do sleep 0.01; done
  sleep 0.05
  { kill -KILL $!; wait $!; } 2> /dev/null || true
}
trap 'echo "status $?"' ERR
"""
# Lines that depend on timing: speeds, remaining times, where a killed command continues.
PACE = re.compile(r"^.*(?: a second|\d s| left|continues (?:at|after) .*)\n", re.MULTILINE)


def run_script(side, script, folder):
    """One case of commands.toml: the files that the script leaves, standard output and errors."""
    folder.mkdir()
    environment = {**os.environ, "PATH": f"{side.polhode.parent}:{os.environ['PATH']}"}
    done = subprocess.run(["bash", "-c", FUNCTIONS + script], cwd=folder, env=environment,
                          stdin=subprocess.DEVNULL, capture_output=True)
    for name, data in (("stdout", done.stdout), ("stderr", done.stderr)):
        (folder / f"{name}.txt").write_text(PACE.sub("", data.decode(errors="replace")))


def with_inputs(side, folder):
    """Examples and scenarios in one folder, so that paths in outputs are the same on both sides."""
    for name in ("examples", "tools/bitwise/scenarios"):
        shutil.copytree(side.inputs / name, folder / "in", dirs_exist_ok=True)


def run_group(side, group, folder):
    """The names that were skipped."""
    if group in PROBES:
        run_probe(side, group, folder)
    elif group == "golden":
        printed(side.command("golden", folder / "golden"), folder / "stdout.txt")
        (folder / "stdout.txt").unlink()  # it names the folder
    elif group == "python":
        run_calls(side, folder)
    elif group == "messages":
        messages.run(side, side.table(MESSAGES), folder / "messages.tsv")
    else:
        with_inputs(side, folder)
        # a map takes every processor
        with concurrent.futures.ThreadPoolExecutor(1 if group == "maps" else None) as pool:
            if group in SCENARIOS:
                command = "map" if group == "maps" else "run"
                made = pool.map(lambda path: run_scenario(side, command, path, folder),
                                SCENARIOS[group]())
                skipped = [name for names in made for name in names]
            else:
                scripts = side.table(COMMANDS)[group]
                skipped = []
                list(pool.map(lambda name: run_script(side, scripts[name], folder / name), scripts))
        shutil.rmtree(folder / "in")
        return skipped
    return []


def digest(side, group):
    """Of all that the outputs of a revision depend on in addition to the revision."""
    text = hashlib.sha256()
    paths = [file for name in inputs_of(group) for file in files_of(side.inputs / name)]
    paths += [ROOT / "tools/bitwise" / name
              for name in ("outputs.py", "messages.py", "revision.py", "names.tsv")]
    for path in paths:
        text.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return text.hexdigest()[:12]


def outputs(side, group):
    """(folder, names that were skipped); those of a revision are kept for the next time."""
    name = f"{side.folder}-{digest(side, group)}" if side.keep else side.folder
    folder = HOME / "outputs" / group / name
    complete = folder.with_suffix(".whole")
    if side.keep and complete.exists():
        return folder, []
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    names = run_group(side, group, folder)
    if side.keep and not names:
        complete.touch()
    return folder, names
