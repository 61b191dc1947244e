#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the proofs of the paper's equations and writes docs/theory/proofs.md.

Usage: docs/theory/proofs/run.py [--quick] [--fresh] [--table FILE | --check]

Prints one line per equation: label, result, seconds, and the right form of a misprint. The exit
status is 1 if a proof fails. Results are kept in build/proofs and used again while the scripts,
SymPy and mpmath are the same. With --quick the few equations that are shown by slow numbers are
left out; --fresh uses no kept result; --table writes the page; --check compares the page with the
results and with the labels of tools/paper_map.py.
"""

import argparse
import hashlib
import importlib
import importlib.metadata
import json
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
PAGE = ROOT / "docs/theory/proofs.md"
KEPT = ROOT / "build/proofs"
SCRIPTS = ["section2", "section3_1", "section3_2", "section4", "section5", "appendix_a1_a3",
           "appendix_a4_a5"]
RESULTS = ("proven", "numeric", "misprinted", "definition")

sys.path[:0] = [str(HERE), str(ROOT / "tools")]


def sources(script):
    """The script and the modules of this folder that it imports, directly or not."""
    found, todo = {}, [script]
    while todo:
        name = todo.pop()
        if name not in found and (HERE / f"{name}.py").exists():
            found[name] = (HERE / f"{name}.py").read_bytes()
            todo += re.findall(r"^from (\w+) import", found[name].decode(), re.MULTILINE)
    return found


def key(script):
    """Hash of all that a result depends on."""
    versions = [importlib.metadata.version(package) for package in ("sympy", "mpmath")]
    digest = hashlib.sha256(repr((sys.version_info[:2], versions)).encode())
    for name, text in sorted(sources(script).items()):
        digest.update(name.encode() + text)
    return digest.hexdigest()


def kept_results(script):
    path = KEPT / f"{script}.json"
    if path.exists():
        kept = json.loads(path.read_text(encoding="utf-8"))
        if kept["key"] == key(script):
            return kept
    return {"key": key(script), "equations": None}


def results(script, quick=False, fresh=False):
    """A dict with name, title and equations of a section; each equation is a dict."""
    kept = kept_results(script)
    rows = [] if fresh or kept["equations"] is None else kept["equations"]
    good = {*RESULTS, "not run"} if quick else {*RESULTS}
    if rows and all(row["result"] in good for row in rows):
        return kept
    done = {row["label"]: row for row in rows if row["result"] in RESULTS}
    section = importlib.import_module(script).section
    rows = [done.get(equation.label) or checked(equation, quick) for equation in section.equations]
    kept.update(name=section.name, title=section.title, equations=rows)
    KEPT.mkdir(parents=True, exist_ok=True)
    (KEPT / f"{script}.json").write_text(json.dumps(kept, indent=1), encoding="utf-8")
    return kept


def checked(equation, quick):
    row = {"label": equation.label, "text": equation.text, "right": equation.right,
           "how": equation.how, "error": None, "seconds": 0.0, "result": "not run"}
    if not (quick and equation.slow):
        row["result"], row["error"], row["seconds"] = equation.run()
    return row


def all_results(quick=False, fresh=False):
    return {script: results(script, quick, fresh) for script in SCRIPTS}


def rows_of(found):
    return [row for section in found.values() for row in section["equations"]]


def counts(found):
    rows = rows_of(found)
    return {result: sum(row["result"] == result for row in rows)
            for result in (*RESULTS, "failed", "not run")}


# --- the page


DEFAULT = {
    "proven": "The remainder is zero.",
    "misprinted": "The remainder of the printed form is not zero; that of the right form is.",
    "numeric": "The numbers agree.",
    "definition": "",
}


def escaped(text):
    return re.sub(r"([*_\[\]<>|$])", r"\\\1", text)


def code(text):
    return f"`{text}`" if text else ""


def table(section):
    yield "| equation | statement | result | right form | how |"
    yield "|---|---|---|---|---|"
    for row in section["equations"]:
        yield (f"| {escaped(row['label'])} | {code(row['text'])} | {row['result']} | "
               f"{code(row['right'])} | {escaped(row['how'] or DEFAULT.get(row['result'], ''))} |")


def page(found):
    number = counts(found)
    total = sum(number.values())
    lines = [
        "# Proofs that run",
        "",
        "Written by `docs/theory/proofs/run.py` from its scripts; do not edit.",
        "",
        f"These are the {total} numbered and named equations of the paper. A computer proves them",
        "again whenever this documentation is built, and a proof that fails stops the build.",
        "",
        "| result | equations | meaning |",
        "|---|---|---|",
        f"| proven | {number['proven']} | both sides are identical, by SymPy |",
        f"| misprinted | {number['misprinted']} | the printed form is proven false, the right form"
        " proven |",
        f"| numeric | {number['numeric']} | both sides agree to 30 digits, computed with 50 by"
        " mpmath |",
        f"| definition | {number['definition']} | a name, an assumption or a definition |",
        "",
        "**Identities.** Sines, cosines and square roots become symbols that obey `s^2 = 1 - c^2`",
        "or `r^2 = x`. Then both sides are quotients of polynomials. They are identical if the",
        "numerator of their difference leaves no remainder on division by these relations. A",
        "misprint leaves one, and its two sides differ by more than 0.01 at a random state.",
        "",
        "**Integrals.** A line or elliptic integral is not evaluated. Its derivative by a limit or",
        "by a parameter is taken under the integral sign, and the integrands are proven identical.",
        "",
        "Numbers are those of the paper's source; a word stands for an equation that has none, as",
        "in the [map](paper_map.md). `sX` and `cX` are the sine and cosine of X, and `f_x` is the",
        "derivative of f by x. The [errata](errata.md) discuss the misprints. Run the proofs with",
        "`python docs/theory/proofs/run.py`; the [scripts](proof_scripts.md) are short, and",
        "[proof.py](proofs/proof.py) holds the method.",
    ]
    for script, section in found.items():
        part = "Appendix" if section["name"][0] == "A" else "Section"
        lines += ["", f"## {part} {section['name']}: {section['title']}", "",
                  f"Script: [{script}.py](proofs/{script}.py).", "", *table(section)]
    return "\n".join(lines) + "\n"


def missing_labels(found):
    """Labels of the paper that no proof has."""
    import paper_map

    here = {row["label"] for row in rows_of(found)}
    for label in paper_map.paper_labels():
        shown = f"({label})" if paper_map.split_number(label) else label
        if shown not in here and not label.startswith("section "):
            yield shown


def page_errors(found):
    yield from (f"docs/theory/proofs: no proof of {label}" for label in missing_labels(found))
    if not PAGE.is_file() or PAGE.read_text(encoding="utf-8") != page(found):
        yield "docs/theory/proofs.md is stale; run make docs-tables"


# --- the command


def report(found):
    for section in found.values():
        print(f"\nSection {section['name']}: {section['title']}")
        for row in section["equations"]:
            note = row["error"] or (row["right"] and f"right: {row['right']}") or ""
            line = f"  {row['label']:25} {row['result']:11} {row['seconds']:7.3f} s  {note}"
            print(line.rstrip())
    number = counts(found)
    seconds = sum(row["seconds"] for row in rows_of(found))
    shown = ", ".join(f"{n} {result}" for result, n in number.items() if n)
    print(f"\n{sum(number.values())} equations: {shown}; {seconds:.1f} s")


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Runs the proofs of the paper's equations.")
    parser.add_argument("--quick", action="store_true", help="leave out slow numbers")
    parser.add_argument("--fresh", action="store_true", help="use no kept result")
    parser.add_argument("--table", metavar="FILE", help="write the page of results to FILE")
    parser.add_argument("--check", action="store_true",
                        help="fail if docs/theory/proofs.md is stale")
    options = parser.parse_args(arguments)
    if options.quick and (options.table or options.check):
        parser.error("the page needs all results: leave out --quick")
    found = all_results(options.quick, options.fresh)
    errors = [f"{row['label']}: {row['error']}" for row in rows_of(found)
              if row["result"] == "failed"]
    if options.table:
        pathlib.Path(options.table).write_text(page(found), encoding="utf-8")
    elif options.check:
        errors += page_errors(found)
    if not options.check:
        report(found)
    print("\n".join(errors), end="\n" if errors else "")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
