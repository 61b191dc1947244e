# SPDX-License-Identifier: MIT
"""Messages for bad files and bad command lines: place, text and exit status.

messages.toml has [texts], lists of lines, and [rows]: [command line, standard input, files...]. A
file {name, of, from, to, put} is the text `of` with lines from to `to` - 1, counted from 0,
replaced by the lines `put`. Each character is one byte (Latin-1).
"""

import concurrent.futures
import pathlib
import re
import shlex
import subprocess
import tempfile

PLACE = re.compile(r"^([^:\s]*):(\d+):(\d+): ")
SECONDS = 60


def written(texts, file):
    lines = list(texts[file["of"]]) if "of" in file else []
    lines[file.get("from", 0):file.get("to", 0)] = file["put"]
    return "\n".join(lines)


def placed(side, line, files):
    """(file:line:column, text); the column is that of the line with the new names."""
    found = PLACE.match(line)
    if not found:
        return "", line
    name, row, column = found[1], int(found[2]), int(found[3])
    lines = files.get(name, "").split("\n")
    if side.names and row <= len(lines):
        column = len(side.names.to_new(lines[row - 1][:column - 1])) + 1
    return f"{name}:{row}:{column}", line[found.end():]


def said(side, name, row, texts):
    """Lines CASE TAB FIELD TAB VALUE."""
    command, stdin, *of_row = row
    files = {"<stdin>": stdin, **{file["name"]: written(texts, file) for file in of_row}}
    with tempfile.TemporaryDirectory() as folder:
        for path, text in list(files.items())[1:]:
            pathlib.Path(folder, path).parent.mkdir(parents=True, exist_ok=True)
            pathlib.Path(folder, path).write_bytes(text.encode("latin-1"))
        done = subprocess.run(
            ["timeout", str(SECONDS), side.polhode, *shlex.split(command)], cwd=folder,
            input=stdin.encode("latin-1"), capture_output=True,
            env={"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"})
    fields = [("status", str(done.returncode))]
    for stream, data in (("out", done.stdout), ("error", done.stderr)):
        for k, line in enumerate(data.decode(errors="backslashreplace").splitlines()):
            place, text = placed(side, line, files)
            fields += [(f"{stream} {k} place", place), (f"{stream} {k}", text.replace("\t", "\\t"))]
    return "".join(f"{name}\t{field}\t{value}\n" for field, value in fields)


def run(side, table, path):
    rows, texts = table["rows"], table["texts"]
    with concurrent.futures.ThreadPoolExecutor() as pool:
        found = pool.map(lambda name: said(side, name, rows[name], texts), rows)
        path.write_text("".join(found), encoding="utf-8")
