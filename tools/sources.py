#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Rules for the text of every source: licence line, ASCII, sizes, and words with no place there."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
SPDX = "SPDX-License-Identifier: MIT"
CODE = {".cpp", ".hpp", ".py", ".cmake", ".sh", ".ts", ".mjs"}
LINES = {".hpp": 500, ".cpp": 700}
# What a browser shows has signs of its own, degrees and Greek letters.
SHOWN = {".ts", ".mjs"}
COLUMNS = 100
# The library never prints, exits, or reads the environment.
FORBIDDEN_IN_LIBRARY = re.compile(
    r"std::(cout|cerr|clog|exit|abort|getenv|printf|puts|print)\b|\b(printf|puts|getenv|_exit)\s*\("
    r"|[^\w.:]exit\s*\(|\bfprintf\s*\(\s*std(out|err)\b|\b(catch\s*\(\.\.\.\)\s*\{\s*\})"
)
# A tolerance is a name in tests/budgets, never a number in a test.
TYPED = "tolerance typed in a test; name it in tests/budgets"
TYPED_TOLERANCE = re.compile(
    r"(?:EXPECT|ASSERT)_(?:NEAR|LT|LE)\s*\((?:(?!;\s*$).)*?,\s*"
    r"(?:\d*\.?\d+e-\d+|0?\.0+[1-9]\d*)\s*\)\s*(?:;|<<)",
    re.MULTILINE | re.DOTALL,
)
NEAR_LITERAL = re.compile(
    r"(?:EXPECT|ASSERT)_NEAR\s*\((?:(?!;\s*$).)*?,\s*[\d.]+(?:e[-+]?\d+)?\s*\)\s*(?:;|<<)",
    re.MULTILINE | re.DOTALL,
)
PYTHON_TOLERANCE = re.compile(
    r"(?:assert_allclose|approx)\s*\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*?"
    r"\b(?:atol|rtol|abs|rel)=(?:\d[\d.]*e-\d+|0?\.\d+|\d+ \* )"
    r"|\bassert [^\n]*<=? *\d[\d.]*e-\d+\s*(?:#|$)",
    re.MULTILINE,
)
# NumPy's own adds 1e-7 of the expected value to every atol.
LOOSE_COMPARISON = re.compile(r"testing(?:\.| import [^\n]*\b)assert_allclose")
COMMENT = re.compile(r"//[^\n]*")
# max(worst, NaN) is worst: what a test or a benchmark takes the largest of keeps NaN, by Worst,
# larger and smaller of tests/worst.hpp, largest and smallest of tests/closeness.py. Counts have a
# type: std::max<int>. A line of Python with a comment "NaN: ..." says why it may.
DROPS = "drops NaN; take "
BLIND_CPP = (
    (re.compile(
        r"\bstd::(?:ranges::)?(?:max|min|minmax|max_element|min_element|minmax_element|fmax|fmin"
        r"|clamp)\b(?!<(?:int|long|std::\w+|unsigned\b[^>]*)>)|(?<![\w.:>])fm(?:ax|in)l?f?\s*\("),
     DROPS + "Worst, larger or smaller of worst.hpp"),
    (re.compile(  # if (x > worst) worst = x; worst = x > worst ? x : worst
        r"\bif\s*\(\s*!?\(?([^;{}?\n]+?)\s*[<>]=?\s*([^;{}?\n]+?)\)?\)\s*\{?\s*"
        r"(?:\1\s*=\s*\2|\2\s*=\s*\1)\s*;"
        r"|=\s*([^;{}?\n]+?)\s[<>]=?\s([^;{}?\n]+?)\s*\?\s*(?:\3\s*:\s*\4|\4\s*:\s*\3)\s*;"),
     DROPS + "Worst of worst.hpp"),
    (re.compile(
        r"\b(?:EXPECT|ASSERT)_(?:FALSE\s*\(|TRUE\s*\(\s*!)(?:[^;\"]|\"[^\"]*\")*?\s(?:>=?|<=?)\s"),
     "passes when a number is NaN; say what must hold, by EXPECT_LE or its like"),
    (re.compile(r"\bif\s*\([^;{}]*!\s*(?:std::)?isfinite\([^;{}]*\)\s*\{?\s*continue\s*;"),
     "passes over a NaN; take std::isinf"),
)
BLIND_PYTHON = (
    (re.compile(r"(?<![\w.])(?:max|min)\((?!map\(len\b)|\bnp\.(?:nanmax|nanmin|fmax|fmin)\b"),
     DROPS + "largest or smallest of closeness"),
    (re.compile(
        r"\bif ([^\n:]+?) [<>]=? ([\w.\[\]]+):\s*(?:\1 = \2|\2 = \1)\b"
        r"|= ([^\n:]+?) if \3 [<>]=? ([^\n:]+?) else \4(?!\w)"),
     DROPS + "largest or smallest of closeness"),
    (re.compile(r"\bassert not (?:(?! and | or )[^\n#])*?\s[<>]=?\s"),
     "passes when a number is NaN; assert what must hold"),
    (re.compile(r"\bassert_allclose\([^\n]*equal_nan=True"),
     "passes when a number is NaN"),
)
MEANT = re.compile(r"#[^\n]*\bNaN: ")


def line_of(text, match):
    return text.count("\n", 0, match.start()) + 1


def errors_of(name, text):
    path = pathlib.PurePath(name)
    lines = text.splitlines()
    if SPDX not in "\n".join(lines[:2]) and path.suffix in CODE | {".txt"}:
        yield f"{name}:1: no line '{SPDX}'"
    for number, line in enumerate(lines, 1):
        if not line.isascii() and not (path.suffix in SHOWN and "page" in path.parts):
            yield f"{name}:{number}: not ASCII"
        if len(line) > COLUMNS and path.suffix in LINES:
            yield f"{name}:{number}: {len(line)} columns, at most {COLUMNS}"
    if path.parts[0] != "tests" and len(lines) > LINES.get(path.suffix, 10**9):
        yield f"{name}: {len(lines)} lines, at most {LINES[path.suffix]}"
    code = COMMENT.sub("", text)
    if path.parts[0] in ("include", "src"):
        for match in FORBIDDEN_IN_LIBRARY.finditer(code):
            yield f"{name}:{line_of(code, match)}: the library does not {match.group(0).strip()!r}"
    if "tests" in path.parts and path.match("test_*.py"):
        for match in PYTHON_TOLERANCE.finditer(text):
            yield f"{name}:{line_of(text, match)}: {TYPED}"
        for match in LOOSE_COMPARISON.finditer(text):
            yield f"{name}:{line_of(text, match)}: compare by closeness.assert_allclose"
    if path.parts[0] == "tests" and path.suffix == ".cpp":
        if path.stem.endswith("_test"):
            yield f"{name}: a test is named after what it tests: {path.stem[:-5]}.cpp"
        for pattern in (TYPED_TOLERANCE, NEAR_LITERAL):
            for match in pattern.finditer(code):
                yield f"{name}:{line_of(code, match)}: {TYPED}"


def blind_errors_of(name, text):
    """Where a test or a benchmark would not see a NaN."""
    path = pathlib.PurePath(name)
    judges = path.parts[0] == "benchmarks" or "tests" in path.parts
    keeps_or_quotes = ("worst.hpp", "closeness.py", "test_sources.py", "test_mutate.py")
    if not judges or path.name in keeps_or_quotes:
        return
    if path.suffix in (".cpp", ".hpp"):
        code, patterns = COMMENT.sub("", text), BLIND_CPP
    elif path.suffix == ".py":
        code, patterns = text, BLIND_PYTHON
    else:
        return
    lines = text.splitlines()
    for pattern, why in patterns:
        for match in pattern.finditer(code):
            line = line_of(code, match)
            if path.suffix != ".py" or not MEANT.search(lines[line - 1]):
                yield f"{name}:{line}: {' '.join(match.group(0).split())!r} {why}"


def version_errors():
    text = (ROOT / "include/polhode/version.hpp").read_text()
    version = ".".join(re.findall(r"#define POLHODE_VERSION_\w+ (\d+)", text))
    homes = (("CITATION.cff", r"^version: (\S+)"), ("CHANGELOG.md", r"^## \[?([\d.]+)"),
             ("web/package.json", r'^  "version": "([\d.]+)"'))
    for name, pattern in homes:
        found = re.search(pattern, (ROOT / name).read_text(), re.MULTILINE)
        if not found or found.group(1) != version:
            yield f"{name}: version is not {version} (include/polhode/version.hpp)"


def main():
    listed = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, text=True, check=True,
        stdout=subprocess.PIPE).stdout.split("\n")
    errors = list(version_errors())
    for name in sorted(set(filter(None, listed))):
        path = ROOT / name
        is_code = path.suffix in CODE or path.name == "CMakeLists.txt"
        if is_code and path.is_file():
            text = path.read_text(encoding="utf-8", errors="replace")
            errors += [*errors_of(name, text), *blind_errors_of(name, text)]
    print("\n".join(dict.fromkeys(errors)), end="\n" if errors else "")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
