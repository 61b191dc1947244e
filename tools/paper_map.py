#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes docs/theory/paper_map.md: equation of the paper -> library, Python, library test, proof.

Usage: tools/paper_map.py [--check]

The page is made of the tags [SA (84)], [SA (2)-(31)], [SA "kinetic"] and [SA "Hamilton" in section
5]. A tag in a comment of include/ or src/ belongs to the declarations that the comment belongs to
(tools/declarations.py); a public header is a link to its page. Python names are those of the
reference that a tagged declaration declares, and the functions of python/polhode with the tag in
their source. A tag in front of a test of tests/paper, tests/unit or tests/property says that the
test fails if the equation is wrong: in the library if the name of the test starts with Library or
the test is in another folder than tests/paper, else in the formulas that the test writes out.
Results of proofs are those of docs/theory/proofs.md.

With --check nothing is written, and the exit status is 1 if
- the page is not what the sources say, or a tag names no equation of the paper,
- an equation of the paper has no proof, or neither a test nor a proof (a definition needs a test),
- the library uses an equation that no library test checks, or the other way round,
- a library test does not name a declaration of its row,
- docs/theory/errata.md and the tests of the suite PaperErrata do not name each other.
"""

import ast
import functools
import itertools
import pathlib
import re
import sys
from collections import defaultdict
from typing import NamedTuple

from declarations import Source

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/theory/paper_map.md"
PROOFS = ROOT / "docs/theory/proofs.md"
ERRATA = ROOT / "docs/theory/errata.md"

# Every label of the paper's source, in its order; equations without one have a word. Further words
# are those of the proofs, for statements of the text.
PAPER = {
    "2": "1-15 16-27 symplecticRB 28-31 firstg1 firstg3 sphere kinetic 32-35",
    "3.1": "36-51 dimensionless 52 54-62",
    "3.2": "Rnew v1 v2 v3 cantran2 dr1 72 73 dr2 74-76 84 78-80 Theta newhamil 1490-1492 "
           "constraint hge0 dot_g dot_h dot_l dot_G dot_H dot_L",
    "4": "96-122 128 123 124 4448 125-127",
    "5": "HJ U2 abcd SerTointerm Haminterm SadovPar LSadov ActioTransf actions changeAction "
         "IellSadov SadovH transf.~eqs dI_l/dlambda partialPhiU phiSadovProv dL/dlambda "
         "quad~dL/dlambda quad~L~dl phiSadov inversion",
    "A.1-A.3": "A1-A30 A33-A48 A51-A66",
    "A.4-A.5": "9995-9997 A.4 eqHam linear defJ H' conditionJ dH'/dq_k p~and~q* J_alpha 2T J_l",
}
MOST = 3  # names in a cell

TAG = re.compile(r"\[SA\s((?:\"[^\"]*\"|[^\]\"])*)\]")
PART = re.compile(r"\(([^)]+)\)\s*(?:-|to)\s*\(([^)]+)\)|\(([^)]+)\)"
                  r"|\"([^\"]+)\"(?:\s+in\s+section\s+([\w.]+))?")
TESTS = ("tests/paper", "tests/unit", "tests/property")


class Cited(NamedTuple):
    """What cites an equation: a declaration or a test, and with how many others in one tag."""

    file: str
    name: str  # empty: the file
    others: int


# --- labels


def split_number(label):
    match = re.fullmatch(r"(A?)(\d+)", label)
    return (match[1], int(match[2])) if match else None


def span(first, last):
    (prefix, a), (_, b) = split_number(first), split_number(last)
    return [f"{prefix}{n}" for n in range(a, b + 1)]


def paper_labels():
    """{label: (section, rank)} of every equation that the paper's source labels."""
    known = {}
    for section, words in PAPER.items():
        for word in words.split():
            ends = word.split("-")
            is_span = len(ends) == 2 and split_number(ends[0])
            for label in span(*ends) if is_span else [word.replace("~", " ")]:
                known[label] = (section, len(known))
    return known


def proofs():
    """{section: (title, {label: result})} of the page of proofs."""
    found = {}
    for line in PROOFS.read_text(encoding="utf-8").splitlines():
        if match := re.match(r"## (?:Section|Appendix) ([\w.-]+): (.*)", line):
            rows = found.setdefault(match[1], (match[2], {}))[1]
        elif found and (match := re.match(r"\| (.*?) \| `.*?` \| (\w+) \|", line)):
            label = re.sub(r"\\([\W_])", r"\1", match[1])
            number = re.fullmatch(r"\((A?\d+)\)", label)
            rows[number[1] if number else label] = match[2]
    return found


class Labels:
    """The equations by section: those of the proofs, and those of the paper that have no proof."""

    def __init__(self):
        self.sections = proofs()
        self.unproven = []
        for label, (section, _) in paper_labels().items():
            rows = self.sections[section][1]
            if label not in rows:
                self.unproven.append((section, label))
                rows[label] = ""
        self.keys = [(section, label) for section, (_, rows) in self.sections.items()
                     for label in rows]
        self.of_word = defaultdict(list)
        for key in self.keys:
            self.of_word[key[1]].append(key)

    def result(self, key):
        return self.sections[key[0]][1][key[1]]

    def of_tag(self, tag):
        """The equations that a tag names, and the words that name none or more than one."""
        found, wrong = [], []
        for first, last, single, word, section in PART.findall(tag):
            if first and split_number(first) and split_number(last):
                found += [key for label in span(first, last) for key in self.of_word[label]]
                continue
            label = word or single or first
            keys = [key for key in self.of_word[label] if not section or key[0] == section]
            if len(keys) == 1:
                found += keys
            else:
                wrong.append(label)
        return found, wrong


# --- tags


def tags_of(text):
    """(offset, tag) of every tag, comment signs taken out."""
    for match in TAG.finditer(text):
        yield match.start(), re.sub(r"\s*\n\s*(?://)?\s*", " ", match[1])


@functools.cache
def source(path):
    return Source(path.read_text(encoding="utf-8"))


def test_of(code, item):
    """Suite.Name of a test, else None."""
    match = re.match(r"(?:TYPED_)?TEST(?:_[FP])?\s*\(\s*(\w+),\s*(\w+)\s*\)",
                     code[item.first:item.last])
    return f"{match[1]}.{match[2]}" if match else None


def words_of(parsed, test=None):
    """The names in a test and in the helpers of its file that it uses, or in the whole file."""
    if test is None:
        return set(re.findall(r"\w+", parsed.code))
    bodies = {i.name: parsed.code[i.first:i.last] for i in parsed.items if i.name != "TEST"}
    found, todo = set(), [parsed.code[test.first:test.last]]
    while todo:
        new = set(re.findall(r"\w+", todo.pop())) - found
        found |= new
        todo += [bodies[word] for word in new if word in bodies]
    return found


def cpp_files(folder):
    return sorted((ROOT / folder).rglob("*.[hc]pp"))


class Map:
    """Who cites which equation."""

    def __init__(self):
        self.labels = Labels()
        self.errors = [f"docs/theory/proofs: no proof of {label}, section {section}"
                       for section, label in self.labels.unproven]
        self.code, self.tests, self.python = (defaultdict(list) for _ in range(3))
        self.words = {}  # test -> the names in it
        self.python_names = python_names()
        for folder in ("include", "src"):
            for path in cpp_files(folder):
                self.read_code(path)
        for folder in TESTS:
            for path in cpp_files(folder):
                self.read_tests(path)
        for path in sorted((ROOT / "python/polhode").rglob("*.py")):
            self.read_python(path)
        for path in cpp_files("python/bindings"):
            text = re.sub(r"\"\s*\n\s*\"", "", path.read_text(encoding="utf-8"))
            for _, tag in tags_of(text.replace('\\"', '"')):
                self.keys_of(path, tag)

    def keys_of(self, path, tag):
        keys, wrong = self.labels.of_tag(tag)
        self.errors += [f"{path.relative_to(ROOT)}: [SA {tag}] names no equation of the paper, or "
                        f"more than one: {word}" for word in wrong]
        return keys

    def read_code(self, path):
        name = path.relative_to(ROOT).as_posix()
        for offset, tag in tags_of(path.read_text(encoding="utf-8")):
            keys = self.keys_of(path, tag)
            for owner in source(path).owners(offset) or [""]:
                for key in keys:
                    self.code[key].append(Cited(name, plain(owner), len(keys)))

    def read_tests(self, path):
        name = path.relative_to(ROOT).as_posix()
        text = path.read_text(encoding="utf-8")
        if not TAG.search(text):
            return
        parsed = source(path)
        own = name.startswith("tests/paper/")
        for item in parsed.items:
            if test := test_of(parsed.code, item):
                self.words[test] = words_of(parsed, item if own else None)
        for offset, tag in tags_of(text):
            keys = self.keys_of(path, tag)
            first, last, _ = next(block for block in parsed.blocks
                                  if block[0] <= offset < block[1])
            holder = [i for i in parsed.items if i.first <= first < i.last]
            for item in holder or parsed.following(parsed.items, last):
                if test := test_of(parsed.code, item):
                    for key in keys:
                        self.tests[key].append(Cited(name, test, len(keys)))

    def read_python(self, path):
        text = path.read_text(encoding="utf-8")
        tree = ast.parse(text)
        for offset, tag in tags_of(text):
            line = text.count("\n", 0, offset) + 1
            holder = next((node.name for node in tree.body if hasattr(node, "name") and
                           node.lineno <= line <= node.end_lineno), None)
            for key in self.keys_of(path, tag):
                if holder in self.python_names:
                    self.python[key].append(self.python_names[holder])

    def library(self, key):
        """The declarations that use an equation, the most direct first; files if there are none."""
        cited = self.code[key]
        named = [c for c in cited if c.name] or cited

        def rank(c):
            return not c.file.startswith("include/"), "/detail/" in c.file, c.others, c.name, c.file

        return sorted(set(named), key=rank)

    def names(self, key):
        """Python names: of the declarations, then of the functions that cite the equation."""
        found = []
        for cited in self.library(key):
            word = cited.name.partition("::")[0]
            if cited.file.startswith("include/") and word in self.python_names:
                found.append(self.python_names[word])
        return list(dict.fromkeys(found + sorted(self.python[key])))

    def tested(self, key):
        """Library tests and tests of formulas alone, the most direct first."""
        def is_library(cited):
            return not cited.file.startswith("tests/paper/") or ".Library" in cited.name

        ranked = sorted(set(self.tests[key]), key=lambda c: (c.others, c.name))
        names = {True: [], False: []}
        for cited in ranked:
            if cited.name not in names[is_library(cited)]:
                names[is_library(cited)].append(cited.name)
        return names[True], names[False]


def plain(name):
    return re.sub(r"\bBasic(?=[A-Z])", "", name)


def python_names():
    """Every name of the Python reference -> its full name: those of blocks {names} MODULE."""
    found = {}
    for path in sorted((ROOT / "docs/reference/python").glob("*.md")):
        blocks = re.findall(r"^```\{names\} (\S+)\n(.*?)^```", path.read_text(encoding="utf-8"),
                            re.M | re.S)
        for module, names in blocks:
            if module == "polhode.vary":
                continue  # distributions, which are called like what they draw
            found.update((name, f"{module}.{name}") for name in names.split())
    return found


# --- the page


def place_text(cited):
    """A file, or a declaration with its file; a public header is a link to its page."""
    short = re.sub(r"^(include/polhode|src)/", "", cited.file)
    if cited.file.startswith("include/") and "/detail/" not in cited.file:
        short = f"[{short}](../../{cited.file})"
    return f"`{cited.name}` ({short})" if cited.name else short


def code_cell(places):
    """At most three places of different names, the file named once for neighbours of one file."""
    first = {c.name or c.file: (c.file, c.name) for c in reversed(places)}
    places = list(dict.fromkeys(first[c.name or c.file] for c in places))[:MOST]
    groups = []
    for file, name in places:
        if groups and groups[-1][0] == file and name:
            groups[-1][1].append(name)
        else:
            groups.append((file, [name]))
    texts = []
    for file, names in groups:
        *before, last = names
        texts += [f"`{name}`" for name in before] + [place_text(Cited(file, last, 0))]
    return ", ".join(texts) or "not used"


def proof_cell(labels, section, results):
    title = labels.sections[section][0]
    part = "appendix" if section[0] == "A" else "section"
    anchor = re.sub(r"[^\w\s-]", "", f"{part} {section} {title}".lower()).replace(" ", "-")
    shown = ", ".join(dict.fromkeys(filter(None, results)))
    return f"[{shown}](proofs.md#{anchor})" if shown else ""


def cells(found, key):
    """What a row shows of an equation, and whether it is misprinted."""
    tests, formulas = found.tested(key)
    shown = ", ".join(f"`{t}`" for t in (tests or formulas)[:MOST])
    return (code_cell(found.library(key)),
            ", ".join(f"[`{name.removeprefix('polhode.')}`](#{name})"
                      for name in found.names(key)[:MOST]),
            shown if tests or not shown else f"formula only: {shown}",
            found.labels.result(key) == "misprinted")


def escaped(label):
    return re.sub(r"([*_\[\]<>|])", r"\\\1", label)


def table(found, section):
    """Rows of one section; neighbours with the same cells share a row."""
    keys = [key for key in found.labels.keys if key[0] == section]
    for row, run in itertools.groupby(keys, functools.partial(cells, found)):
        run = list(run)
        names = [label for _, label in run]
        proof = proof_cell(found.labels, section, map(found.labels.result, run))
        shown = [f"({name})" if split_number(name) else escaped(name) for name in names]
        numbers = [split_number(name) for name in names]
        if len(names) > 2 and all(numbers) and numbers == sorted(numbers):
            shown = [f"{shown[0]} to {shown[-1]}"]
        yield f"| {', '.join(shown)} | {' | '.join(row[:3])} | {proof} |"


def page(found):
    lines = [
        "# The paper, equation by equation",
        "",
        "Written by `tools/paper_map.py` from the `[SA ...]` tags in the sources; do not edit.",
        "",
        "SA is Gurfil, Elipe, Tangren and Efroimsky, *The Serret-Andoyer formalism in rigid-body",
        "dynamics: I*. Numbers are those of its source; a word stands for an equation that has",
        "none. Misprints are listed in the [errata](errata.md).",
        "",
        "| column | content |",
        "|---|---|",
        "| library | declarations that use the equation, at most three, the most direct first |",
        "| Python | their names in Python |",
        "| library test | tests that call the library and fail if it gets the equation wrong."
        " *Formula only*: the library does not use the equation; the test evaluates both sides"
        " with 50 digits at random states |",
        "| proof | result of the [proof](proofs.md): proven, misprinted (the right form is"
        " proven), numeric, or a definition |",
        "",
        "The equations come with no numerical results to compare with. Published numbers that",
        "polhode reproduces are those of [real bodies](../examples/index.md), each with its",
        "source.",
    ]
    for section, (title, _) in found.labels.sections.items():
        part = "Appendix" if section[0] == "A" else "Section"
        lines += ["", f"## {part} {section}: {title}", ""]
        lines += ["| equation | library | Python | library test | proof |", "|---|---|---|---|---|"]
        lines += table(found, section)
    return "\n".join(lines) + "\n"


# --- the command


def row_errors(found):
    for key in found.labels.keys:
        label = f"{key[1]} of section {key[0]}"
        library = found.library(key)
        tests, formulas = found.tested(key)
        if not (tests or formulas) and found.labels.result(key) in ("", "definition"):
            yield f"{label}: neither a test nor a proof"
        if library and not tests:
            yield f"{label}: no library test, but {library[0].file} uses it"
        if tests and not library:
            yield f"{label}: tested by {tests[0]}, but no declaration has the tag"
        words = {word for cited in library for word in re.findall(r"\w+", cited.name)}
        for test in tests[:MOST]:
            if words and not words & found.words[test]:
                yield f"{label}: {test} names none of {', '.join(sorted(words))}"


def errata_errors():
    named = set(re.findall(r"`(PaperErrata\.\w+)`", ERRATA.read_text(encoding="utf-8")))
    tests = set()
    for path in sorted((ROOT / "tests/paper").glob("*.cpp")):
        text = path.read_text(encoding="utf-8")
        for name in re.findall(r"^TEST\(PaperErrata, (\w+)\)", text, re.M):
            tests.add("PaperErrata." + name)
    yield from (f"docs/theory/errata.md: no test {name}" for name in sorted(named - tests))
    yield from (f"docs/theory/errata.md: does not name {name}" for name in sorted(tests - named))


def main(arguments):
    found = Map()
    text = page(found)
    errors = found.errors
    if arguments == ["--check"]:
        errors += [*row_errors(found), *errata_errors()]
        if not PAGE.is_file() or PAGE.read_text(encoding="utf-8") != text:
            errors.append("docs/theory/paper_map.md is stale; run tools/paper_map.py")
    elif arguments:
        sys.exit(f"usage: {sys.argv[0]} [--check]")
    else:
        PAGE.write_text(text, encoding="utf-8")
    print("\n".join(errors), end="\n" if errors else "")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
