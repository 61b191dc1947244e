#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes docs/theory/paper_map.md: equation of the paper -> code that cites it, in C++ and Python,
and its tests.

The page is made of the tags [SA (84)], [SA (2)-(31)], [SA "kinetic"], [SA section 3.2] in the
comments of include/, src/ and tests/paper/ and in the docstrings of python/polhode. A public header
is a link to its page; Python names are those of the reference that a header declares, or whose
function has the tag. With --check nothing is written: exit status 1 if the
page is not what the sources say, if a tag names no equation of the paper, or if
docs/theory/errata.md and the tests of the suite PaperErrata do not name each other.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/theory/paper_map.md"
ERRATA = ROOT / "docs/theory/errata.md"

# Every label of the paper, in the order of the paper. Numbers are those of its source; equations
# without one have a word.
PAPER = [
    ("2", "Eulerian variables",
     "1-15 16-27 symplecticRB 28-31 firstg1 firstg3 sphere kinetic 32-35"),
    ("3.1", "Richelot, Serret, Radau, Tisserand", "36-51 dimensionless 52 54-62"),
    ("3.2", "Andoyer, Deprit and Elipe",
     "Rnew v1 v2 v3 cantran2 dr1 72 73 dr2 74-76 84 78-80 Theta newhamil 1490-1492 constraint hge0 "
     "dot_g dot_h dot_l dot_G dot_H dot_L"),
    ("4", "Perturbations and precessing frames", "96-124 4448 125-127"),
    ("5", "Sadov's variables",
     "HJ U2 abcd SerTointerm Haminterm SadovPar LSadov ActioTransf actions changeAction IellSadov "
     "SadovH transf.~eqs dI_l/dlambda partialPhiU phiSadovProv dL/dlambda quad~dL/dlambda "
     "quad~L~dl phiSadov inversion"),
    ("A.1-A.3", "Spherical triangle, elliptic solution, variations of S",
     "A1-A30 A33-A48 A51-A66"),
    ("A.4-A.5", "Rates of the node, Andoyer's method",
     "9995-9997 A.4 eqHam linear defJ H' dH'/dq_k p~and~q* J_alpha 2T J_l"),
]

TAG = re.compile(r"\[SA\s([^\]]*)\]")
PART = re.compile(r"\(([^)]+)\)\s*-\s*\(([^)]+)\)|\(([^)]+)\)|\"([^\"]+)\"|section ([\w.]+)")


def split_number(label):
    match = re.fullmatch(r"(A?)(\d+)", label)
    return (match[1], int(match[2])) if match else None


def span(first, last):
    (prefix, a), (_, b) = split_number(first), split_number(last)
    return [f"{prefix}{n}" for n in range(a, b + 1)]


def paper_labels():
    """{label: (section, rank)} of every equation."""
    known = {}
    for section, _, words in PAPER:
        known["section " + section] = (section, len(known))
        for word in words.split():
            ends = word.split("-")
            is_span = len(ends) == 2 and split_number(ends[0])
            for label in span(*ends) if is_span else [word.replace("~", " ")]:
                known[label] = (section, len(known))
    return known


def labels_of(tag, known):
    """The equations that one tag names; a label that is not the paper's comes back as it is."""
    for first, last, single, word, section in PART.findall(re.sub(r"\s*\n\s*//\s*", " ", tag)):
        if first and split_number(first) and split_number(last):
            yield from (label for label in span(first, last) if label in known)
        elif section:
            yield "section " + section
        else:
            yield single or word or first


def name_of(declaration):
    declaration = declaration.split("//")[0]
    test = re.match(r"TEST(?:_[FP])?\((\w+),\s*(\w+)\)", declaration)
    if test:
        return f"{test[1]}.{test[2]}"
    kind = re.search(r"\b(?:class|struct|concept)\s+(\w+)", declaration)
    if kind and "(" not in declaration[:kind.start()]:
        return kind[1]
    call = re.search(r"([\w~]+|operator\W+?)\s*\(", declaration)
    value = re.search(r"(\w+)\s*(?:=|\{|;|$)", declaration)
    found = call or value
    return found[1] if found else None


def is_code(line):
    return bool(line.strip()) and not line.lstrip().startswith("//")


def enclosing(lines, i):
    """Index of the declaration at column 0 whose block holds line i."""
    for k in range(i - 1, -1, -1):
        line = lines[k]
        if line.startswith("}"):
            return None
        if not is_code(line) or line[0] in " #":
            continue
        if re.match(r"(inline )?namespace|template|using", line):
            continue
        head = line
        for follow in lines[k + 1:i]:
            if head.rstrip().endswith(("{", "}", ";")):
                break
            head += follow
        return k if head.rstrip().endswith("{") else None
    return None


def symbol(lines, i):
    """What the tag on line i belongs to: the declaration after or around it; None: the file."""
    if not any(map(is_code, lines[:i + 1])):
        return None
    j = i
    while j < len(lines) and not (is_code(lines[j]) and not lines[j].startswith("template")):
        j += 1
    if j == len(lines):
        return None
    if j > i and not lines[j].startswith((" ", "}")):
        return name_of(lines[j])
    holder = enclosing(lines, j)
    if holder is None:
        return name_of(lines[j].strip())
    outer = name_of(lines[holder])
    member = re.match(r"  [\w:<&*]", lines[j]) and re.match(r"(class|struct)\b", lines[holder])
    inner = name_of(lines[j].strip()) if member else None
    return f"{outer}::{inner}" if inner else outer


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


def declared_in(text, what):
    """What of a header has the tag: a class or function, or all that the header declares."""
    if what:
        return {what.partition("::")[0].removeprefix("Basic")}
    found = re.findall(r"^(?:class|struct) (\w+)|^[\w:<>, *&\[\]]* (\w+)\(", text, re.M)
    return {kind.removeprefix("Basic") or function for kind, function in found}


def function_of(text, at):
    """The function or class at column 0 of a Python file that holds an offset."""
    before = re.findall(r"^(?:def|class) (\w+)", text[:at], re.M)
    return before[-1] if before else None


def python_citations(known, names):
    """{label: names of Python functions whose docstrings or comments cite it}."""
    found = {}
    for path in sorted((ROOT / "python/polhode").rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        for match in TAG.finditer(text):
            name = function_of(text, match.start())
            for label in labels_of(match[1], known):
                if label in known and name in names:
                    found.setdefault(label, set()).add(names[name])
    return found


def citations(known):
    """{label: (code places, tests, Python names), each a set} and a list of tags that name
    nothing."""
    found, unknown, names = {}, [], python_names()
    for label, cited in python_citations(known, names).items():
        found[label] = (set(), set(), cited)
    files = [p for d in ("include", "src", "tests/paper")
             for p in sorted((ROOT / d).rglob("*.[hc]pp"))]
    for path in files:
        text, name = path.read_text(encoding="utf-8"), path.relative_to(ROOT).as_posix()
        lines = text.splitlines()
        for match in TAG.finditer(text):
            what = symbol(lines, text.count("\n", 0, match.end()))
            for label in labels_of(match[1], known):
                if label not in known:
                    unknown.append(f"{name}: [SA {match[1]}] names no equation of the paper: "
                                   f"{label}")
                    continue
                code, tests, python = found.setdefault(label, (set(), set(), set()))
                if name.startswith("tests/"):
                    if what and "." in what:
                        tests.add(what)
                else:
                    code.add((name, what or ""))
                    declared = declared_in(text, what) if name.startswith("include/") else {what}
                    python.update(names[word] for word in declared if word in names)
    return found, unknown


def place_text(name, what):
    """A file, or a symbol with its file; a public header is a link to its page."""
    short = re.sub(r"^(include/polhode|src)/", "", name)
    if name.startswith("include/") and "/detail/" not in name:
        short = f"[{short}](../../{name})"
    return f"`{what}` ({short})" if what else short


def cells(places):
    code, tests, python = places
    symbols = {name for name, what in code if what}
    shown = sorted(place for place in code if place[1] or place[0] not in symbols)
    shown.sort(key=lambda place: (not place[1], place[1], place[0]))
    return (", ".join(place_text(*place) for place in shown),
            ", ".join(f"[`{name.removeprefix('polhode.')}`](#{name})" for name in sorted(python)),
            ", ".join(f"`{t}`" for t in sorted(tests)))


def table(labels, found):
    """Rows of one section; neighbours with the same cells share a row."""
    runs = []
    for rank, label in labels:
        if runs and runs[-1][2] == cells(found[label]) and runs[-1][0] + 1 == rank:
            runs[-1][0] = rank
            runs[-1][1].append(label)
        else:
            runs.append([rank, [label], cells(found[label])])
    for _, names, (code, python, tests) in runs:
        shown = [f"({name})" if split_number(name) else name for name in names]
        if len(names) > 2 and all(map(split_number, names)):
            shown = [f"{shown[0]} to {shown[-1]}"]
        yield f"| {', '.join(shown)} | {code} | {python} | {tests} |"


def page(known, found):
    lines = [
        "# The paper, equation by equation",
        "",
        "Written by `tools/paper_map.py` from the `[SA ...]` tags in the sources; do not edit.",
        "",
        "SA is Gurfil, Elipe, Tangren and Efroimsky, *The Serret-Andoyer formalism in rigid-body",
        "dynamics: I*. Numbers are those of its source; a word stands for an equation that has",
        "none. A file without a symbol cites the equation for all that it declares; Python names",
        "are those of what cites it. Tests are in `tests/paper`; those named `PaperErrata` show a",
        "misprint, listed in the [errata](errata.md). Every equation is also on the page of",
        "[proofs](proofs.md).",
        "",
        "The equations come with no numerical results to compare with: a test evaluates both sides",
        "with 50 digits at random states, or differentiates one. Published numbers that polhode",
        "reproduces are those of [real bodies](../examples/index.md), each with its source.",
    ]
    for section, title, _ in PAPER:
        rows = sorted((rank, label) for label, (of, rank) in known.items()
                      if of == section and label in found)
        if not rows:
            continue
        part = "Appendix" if section[0] == "A" else "Section"
        lines += ["", f"## {part} {section}: {title}", ""]
        lines += ["| equation | code | Python | tests |", "|---|---|---|---|"]
        lines += table(rows, found)
    return "\n".join(lines) + "\n"


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
    known = paper_labels()
    found, errors = citations(known)
    text = page(known, found)
    if arguments == ["--check"]:
        errors += errata_errors()
        if not PAGE.is_file() or PAGE.read_text(encoding="utf-8") != text:
            errors.append("docs/theory/paper_map.md is stale; run tools/paper_map.py")
    elif arguments:
        sys.exit(f"usage: {sys.argv[0]} [--check]")
    else:
        PAGE.parent.mkdir(parents=True, exist_ok=True)
        PAGE.write_text(text, encoding="utf-8")
    print("\n".join(errors), end="\n" if errors else "")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
