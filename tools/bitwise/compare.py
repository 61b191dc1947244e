# SPDX-License-Identifier: MIT
"""Two files of outputs, value by value: equal to the last bit, or different by how much.

Every format becomes cases of (field, text of the value); a value that is a number in both files
differs by units in the last place, anything else by its text.
"""

import csv
import dataclasses
import json
import math
import pathlib
import struct
import subprocess

from bitwise.revision import Failed

MISSING = "-"


@dataclasses.dataclass
class Difference:
    case: str
    field: str
    old: str
    new: str
    ulps: "int | None"  # None: no numbers, or NaN


@dataclasses.dataclass
class Comparison:
    values: int = 0
    differences: "list[Difference]" = dataclasses.field(default_factory=list)

    def add(self, other):
        self.values += other.values
        self.differences += other.differences

    def worst(self):
        """The largest number of ulps; None where nothing differs, inf where a text does."""
        if not self.differences:
            return None
        return max(math.inf if d.ulps is None else d.ulps for d in self.differences)


def number(text):
    """The double of a decimal or hexadecimal number; None for any other text."""
    try:
        return float.fromhex(text) if "0x" in text.lower() else float(text)
    except ValueError:
        return None


def place(x):
    """Doubles in their order as integers: neighbours differ by 1, -0 and 0 too."""
    (bits,) = struct.unpack("<q", struct.pack("<d", x))
    return bits if bits >= 0 else -(bits & 0x7FFFFFFFFFFFFFFF) - 1


def ulps_between(old, new):
    a, b = number(old), number(new)
    if a is None or b is None or math.isnan(a) or math.isnan(b):
        return None
    return abs(place(a) - place(b))


def compare_cases(old, new):
    """Two dictionaries {case: {field: text}}."""
    found = Comparison()
    for case in {**old, **new}:
        before, after = old.get(case, {}), new.get(case, {})
        found.values += len(before.keys() | after.keys())
        if before == after:
            continue
        for field in {**before, **after}:
            a, b = before.get(field, MISSING), after.get(field, MISSING)
            if a != b:
                found.differences.append(Difference(case, field, a, b, ulps_between(a, b)))
    return found


def put(fields, name, text):
    """A field that is there already gets a number."""
    unique, count = name, 1
    while unique in fields:
        count += 1
        unique = f"{name} ({count})"
    fields[unique] = text


def probe_cases(path):
    """What a probe prints: case, field, value."""
    cases = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        case, field, text = line.split("\t", 2)
        put(cases.setdefault(case, {}), field, text)
    return cases


def csv_cases(path):
    """Rows and columns, and the lines of the comment before them."""
    lines = path.read_text(encoding="utf-8").splitlines()
    comment = [line for line in lines if line.startswith("#")]
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    fields = {f"comment {k}": line for k, line in enumerate(comment)}
    names = rows[0] if rows else []
    put(fields, "columns", ",".join(names))
    for k, row in enumerate(rows[1:]):
        for column, text in enumerate(row):
            name = names[column] if column < len(names) else column
            fields[f"row {k} {name}"] = text
    return {path.name: fields}


def json_cases(path):
    """Every number and word, by the path that leads to it."""
    fields = {}

    def walk(where, value):
        if isinstance(value, dict):
            for key, below in value.items():
                walk(f"{where}.{key}", below)
        elif isinstance(value, list):
            for k, below in enumerate(value):
                walk(f"{where}[{k}]", below)
        else:
            fields[where] = str(value)

    walk("", json.loads(path.read_text(encoding="utf-8"), parse_float=str, parse_int=str))
    return {path.name: fields}


def text_cases(path):
    text = path.read_text(encoding="utf-8", errors="replace")
    return {path.name: {f"line {k}": line for k, line in enumerate(text.splitlines())}}


READERS = {".tsv": probe_cases, ".csv": csv_cases, ".json": json_cases}


def compare_tables(old, new):
    """HDF5: the bytes, and where they differ what h5diff says of it."""
    try:
        done = subprocess.run(["h5diff", "--verbose", old, new], capture_output=True, text=True)
    except FileNotFoundError:
        raise Failed("h5diff is not there: it is in the package hdf5-tools") from None
    printed = (done.stdout + done.stderr).strip()
    if done.returncode != 0 and not printed:
        raise Failed(f"h5diff {old} {new}: status {done.returncode}, without a word")
    said, about = [], ""
    for line in printed.splitlines():
        if line.startswith(("dataset:", "attribute:", "group")):
            about = line.split(" and ")[0]
        elif line.endswith("differences found") and not line.startswith("0 "):
            said.append((about, line))
    if not said:
        said = [("bytes", "h5diff finds no other value" if done.returncode == 0 else
                 printed.splitlines()[-1])]
    return Comparison(1, [Difference(new.name, about, MISSING, text, None)
                          for about, text in said])


def compare_files(old, new):
    """Equal bytes are read only to count their values."""
    if not old.exists() or not new.exists():
        there = [MISSING if not path.exists() else "there" for path in (old, new)]
        return Comparison(1, [Difference(new.name, "file", *there, None)])
    equal = old.read_bytes() == new.read_bytes()
    if new.suffix == ".h5":
        return Comparison(1) if equal else compare_tables(old, new)
    read = READERS.get(new.suffix, text_cases)
    cases = read(new)
    found = compare_cases(cases if equal else read(old), cases)
    if not equal and not found.differences:
        found.differences.append(Difference(new.name, "bytes", MISSING, "other bytes", None))
    return found


def compare_folders(old: pathlib.Path, new: pathlib.Path, without=()):
    """All files of both; `without` names folders in them that are left out."""
    found = Comparison()
    names = sorted({path.relative_to(folder) for folder in (old, new)
                    for path in folder.rglob("*") if path.is_file()})
    for name in names:
        if name.parts[0] in without:
            continue
        of_file = compare_files(old / name, new / name)
        within = str(name.parent)
        if within != ".":
            for difference in of_file.differences:
                difference.case = f"{within}/{difference.case}"
        found.add(of_file)
    return found
