# SPDX-License-Identifier: MIT
"""Runs every code block of README.md and docs/, and compares its output with what is printed there.

The convention is in CONTRIBUTING.md. The blocks of one document run in order in one scratch
directory that looks like the checkout, so that a block can read what an earlier one wrote; its
Python blocks run in one interpreter, so that a block sees the names of those before it."""

import os
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import budgets
import pytest
from python_session import PythonSession

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
# What a program includes that needs polhode::io.
OF_IO = re.compile("polhode/(text|tables|output|scenario|run)/")
RELATIVE = budgets.documents
SECONDS = 300

# A language, or a directive of the site with its arguments: ```{toctree}
FENCE = re.compile(r"^(`{3,}|~{3,})\s*([\w+-]*|\{[\w:-]+\}.*)\s*$")
# How far it is, in members or times a second, or the parts of a fit with their size before.
PROGRESS = re.compile(r"^( *\d+ %, .* per second.*|[a-z ]+: \d+ %(, .* left)?"
                      r"|[a-z ]+: \d.*, about [\d.]+ (s|min|h|d))\n", re.MULTILINE)
DIRECTIVE = re.compile(r"^<!--\s*(file|skip|exit):\s*(.*?)\s*-->$")
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


@dataclass
class Block:
    language: str
    line: int
    text: str
    directives: dict = field(default_factory=dict)
    output: str | None = None


def blocks(markdown):
    """The fenced blocks of a document; each `text` block is the output of the block before it.

    A block may be indented, as in a list or a tab: its lines lose the indent of its fence."""
    found, directives, fence = [], {}, None
    for number, line in enumerate(markdown.splitlines(), 1):
        match = FENCE.match(line.strip())
        if fence is None:
            comment = DIRECTIVE.match(line.strip())
            if comment:
                directives[comment[1]] = comment[2]
            elif match:
                fence, indent = match[1], len(line) - len(line.lstrip())
                block = Block(match[2], number, "", directives)
                directives = {}
            elif line.strip():
                directives = {}
        elif match and match[1] == fence and not match[2]:
            fence = None
            if block.language == "text":
                assert found, f"line {block.line}: an output without a block"
                assert found[-1].output is None, f"line {block.line}: a second output"
                found[-1].output = block.text
            else:
                found.append(block)
        else:
            assert not line[:indent].strip(), f"line {number}: less indented than its fence"
            block.text += line[indent:] + "\n"
    assert fence is None, "a fence is not closed"
    return found


def same_token(printed, expected):
    """Equal, `<any>`, or the same but for numbers within RELATIVE of each other."""
    if printed == expected or expected == "<any>":
        return True
    if NUMBER.sub("#", printed) != NUMBER.sub("#", expected):
        return False
    pairs = zip(NUMBER.findall(printed), NUMBER.findall(expected), strict=True)
    return all(abs(float(p) - float(e)) <= RELATIVE * abs(float(e)) for p, e in pairs)


def same_line(printed, expected):
    p, e = printed.split(), expected.split()
    return len(p) == len(e) and all(map(same_token, p, e))


def difference(printed, expected):
    """The first expected line that is not there, or None. A line `...` stands for any lines."""
    p = [line for line in printed.splitlines() if line.strip()]
    e = [line for line in expected.splitlines() if line.strip()]

    def matches(i, j):
        while j < len(e) and e[j].strip() != "...":
            if i >= len(p) or not same_line(p[i], e[j]):
                return False, j
            i, j = i + 1, j + 1
        if j == len(e):
            return i == len(p), j
        furthest = j
        for k in range(i, len(p) + 1):
            good, reached = matches(k, j + 1)
            if good:
                return True, reached
            furthest = max(furthest, reached)  # NaN: none among counts
        return False, furthest

    good, at = matches(0, 0)
    if good:
        return None
    return e[at] if at < len(e) else "(nothing more)"


def program(text):
    """A C++ block as a program: one without main() is put into one, behind its #include lines."""
    if re.search(r"\bint main\(", text):
        return text
    lines = text.splitlines()
    head = [line for line in lines if line.startswith("#include")]
    body = [line for line in lines if not line.startswith("#include")]
    return "\n".join([*head, "int main() {", *body, "}", ""])


def compile_command(build, source, executable):
    libraries = [build / "src/libpolhode.a"]
    if OF_IO.search(Path(source).read_text(encoding="utf-8")):
        flags = subprocess.run(["pkg-config", "--libs", "hdf5-serial", "udunits", "fmt"],
                               stdout=subprocess.PIPE, text=True, check=True).stdout
        libraries = [build / "src/libpolhode_io.a", build / "src/libpolhode_fit.a",
                     build / "src/libpolhode_ensemble.a", *libraries, *flags.split()]
    return [os.environ.get("CXX", "g++"), "-std=c++20", "-O1", "-ffp-contract=off",
            "-I", ROOT / "include", source, "-o", executable, *libraries]


def command(block, scratch, build, polhode):
    """What runs a block: a list of commands, one after the other."""
    name = block.directives.get("file")
    if name:
        path = scratch / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.unlink(missing_ok=True)  # a link to a file of the checkout is not written through
        path.write_text(block.text, encoding="utf-8")
    if block.language == "sh":
        return [["bash", "-euo", "pipefail", "-c", block.text]]
    if block.language == "toml":
        path = scratch / (name or "block.toml")
        path.write_text(block.text, encoding="utf-8")
        return [[polhode, "info", path]]
    if block.language == "cpp" and not name:
        source = scratch / "block.cpp"
        source.write_text(program(block.text), encoding="utf-8")
        return [compile_command(build, source, scratch / "block"), [scratch / "block"]]
    return []


def environment_of(build):
    path = os.environ.get("PYTHONPATH")
    ours = f"{build}:{Path(sys.executable).parent}"  # `python` is the one of the tests
    return dict(os.environ, PATH=f"{ours}:{os.environ['PATH']}", COLUMNS="100", MPLBACKEND="agg",
                PYTHONPATH=f"{build / 'python'}" + (f":{path}" if path else ""))


class Page:
    """Where the blocks of one document run: a scratch directory, and a Python interpreter when the
    first block asks for it."""

    def __init__(self, scratch, build, polhode):
        self.scratch, self.build, self.polhode = scratch, build, polhode
        self.environment = environment_of(build)
        self.python = None

    def close(self):
        if self.python:
            self.python.close()

    def printed(self, block):
        """(what ran, exit code, what it printed) of the last command that a block needs."""
        done = (block.language, 0, "")
        if block.language == "python":
            command(block, self.scratch, self.build, self.polhode)  # writes its file, if it has one
            if self.python is None:
                self.python = PythonSession(self.scratch, self.environment, SECONDS)
            return "python", *self.python.run(block.text)
        for arguments in command(block, self.scratch, self.build, self.polhode):
            if done[1]:
                break
            ran = subprocess.run(arguments, cwd=self.scratch, env=self.environment, text=True,
                                 timeout=SECONDS, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT)
            shown = " ".join(shlex.quote(str(a)) for a in arguments)
            # how far a run is, a line a few seconds: none on a quick machine
            done = (shown, ran.returncode, PROGRESS.sub("", ran.stdout))
        return done

    def run(self, block):
        """Runs a block; returns what is wrong, or None."""
        if "skip" in block.directives:
            assert block.directives["skip"], "skip: needs a reason"
            return None
        shown, code, printed = self.printed(block)
        if code != int(block.directives.get("exit", "0")):
            return f"{shown}\nexit code {code}\n{printed}"
        missing = None if block.output is None else difference(printed, block.output)
        if missing is not None:
            return f"it printed\n{printed}\nbut the page says\n{block.output}\nfirst at: {missing}"
        return None


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda p: str(p.relative_to(ROOT)))
def test_every_block_does_what_the_page_says(document, tmp_path, build):
    found = blocks(document.read_text(encoding="utf-8"))
    for entry in ROOT.iterdir():
        if not entry.name.startswith("."):
            (tmp_path / entry.name).symlink_to(entry)
    page = Page(tmp_path, build, build / "polhode")
    try:
        for block in found:
            wrong = page.run(block)
            place = f"{document.relative_to(ROOT)}:{block.line} ({block.language})"
            assert wrong is None, f"{place}: {wrong}"
    finally:
        page.close()


def test_a_wrong_number_is_seen():
    assert difference("x = 1.0000000001 m", "x = 1 m") is None
    assert difference("x = 1.00000001 m", "x = 1 m") == "x = 1 m"
    assert difference("a\nb\nc", "a\n...\nc") is None
    assert difference("a\nb", "a\n...\nc") == "c"
    assert difference("a\nb", "a") == "(nothing more)"
    assert difference("took 3.1 s", "took <any> s") is None


def test_python_blocks_share_their_names_and_keep_their_errors(tmp_path, build):
    page = Page(tmp_path, build, build / "polhode")
    text = "```python\nx = 2\n```\n\n- Item\n\n    ```python\n    print(x + 1)\n    ```\n\n"
    text += "    ```text\n    3\n    ```\n\n<!-- exit: 1 -->\n```python\n1 / 0\n```\n"
    text += "```text\n...\nZeroDivisionError: division by zero\n```\n"
    try:
        assert [page.run(block) for block in blocks(text)] == [None, None, None]
        wrong = page.run(Block("python", 1, "print(x)", output="3"))
        assert wrong and "first at: 3" in wrong
        assert "exit code 1" in page.run(Block("python", 1, "raise ValueError('no')"))
    finally:
        page.close()
