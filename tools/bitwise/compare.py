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


def probe_cases(name, text):
    """What a probe prints: case, field, value."""
    cases = {}
    for line in text.splitlines():
        case, field, value = line.split("\t", 2)
        put(cases.setdefault(case, {}), field, value)
    return cases


def csv_cases(name, text):
    """Rows and columns, and the lines of the comment before them."""
    lines = text.splitlines()
    comment = [line for line in lines if line.startswith("#")]
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    fields = {f"comment {k}": line for k, line in enumerate(comment)}
    names = rows[0] if rows else []
    put(fields, "columns", ",".join(names))
    for k, row in enumerate(rows[1:]):
        for column, value in enumerate(row):
            of = names[column] if column < len(names) else column
            fields[f"row {k} {of}"] = value
    return {name: fields}


def json_cases(name, text):
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

    walk("", json.loads(text, parse_float=str, parse_int=str))
    return {name: fields}


def text_cases(name, text):
    return {name: {f"line {k}": line for k, line in enumerate(text.splitlines())}}


READERS = {".tsv": probe_cases, ".csv": csv_cases, ".json": json_cases}


def read_text(path, rename):
    """The text with the new names, and its cases."""
    text = rename(path.read_bytes().decode("utf-8", "backslashreplace"))
    try:
        return text, READERS.get(path.suffix, text_cases)(path.name, text)
    except ValueError:  # of a command that failed
        return text, text_cases(path.name, text)


def read_hdf5(path, rename):
    """Names, attributes and values of every dataset; numbers with all their bits."""
    import h5py
    fields = {}

    def keep(name, values):
        for k, value in enumerate(values):
            of = name if len(values) == 1 else f"{name}[{k}]"
            text = value.decode() if isinstance(value, bytes) else value
            fields[of] = text.hex() if isinstance(text, float) else rename(str(text))

    def visit(name, item):
        for key, value in item.attrs.items():
            keep(rename(f"{name}@{key}"), numbers_of(value))
        if isinstance(item, h5py.Dataset):
            fields[rename(name)] = f"{item.dtype} {item.shape}"
            keep(rename(name) + " ", numbers_of(item[()]))

    def numbers_of(value):
        flat = getattr(value, "ravel", lambda: None)()
        return [value] if flat is None else flat.tolist()

    with h5py.File(path) as file:
        visit("/", file)
        file.visititems(visit)
    return fields, {path.name: fields}


def compare_files(old, new, rename=str):
    """Differences of values; if there are none, differences of bytes that names do not explain."""
    if not old.exists() or not new.exists():
        there = [MISSING if not path.exists() else "there" for path in (old, new)]
        return Comparison(1, [Difference(new.name, "file", *there, None)])
    read = read_hdf5 if new.suffix == ".h5" else read_text
    after, cases = read(new, str)
    if old.read_bytes() == new.read_bytes():
        return compare_cases(cases, cases)
    before, own = read(old, rename)
    found = compare_cases(own, cases)
    same = before == after and read(old, str)[0] != after  # but for names
    if not found.differences and not same:
        found.differences.append(Difference(new.name, "bytes", MISSING, "other bytes", None))
    return found


def compare_folders(old: pathlib.Path, new: pathlib.Path, without=(), rename=str):
    """All files of both; `without` names folders in them that are left out, `rename` gives a text
    of the old side the names of the new one."""
    found = Comparison()
    names = sorted({path.relative_to(folder) for folder in (old, new)
                    for path in folder.rglob("*") if path.is_file()})
    for name in names:
        if name.parts[0] in without:
            continue
        of_file = compare_files(old / name, new / name, rename)
        within = str(name.parent)
        if within != ".":
            for difference in of_file.differences:
                difference.case = f"{within}/{difference.case}"
        found.add(of_file)
    return found
