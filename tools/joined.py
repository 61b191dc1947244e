#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes a source that includes others, so that the compiler reads their headers once.

It names them relative to itself: a compiler cache then knows it in every checkout. Each source is
in a namespace of its own: two tests may both have an `eps`. All headers come first, and what a
source puts into `namespace polhode` sees what the library has there.

tools/joined.py OUT SOURCE...
"""

import argparse
import os
import pathlib
import re

INCLUDE = re.compile(r'^#include ([<"])([^>"]+)[>"]', re.MULTILINE)
OPENED = re.compile(r"^namespace ([\w:]+) \{", re.MULTILINE)


def included(source, place, text):
    for bracket, name in INCLUDE.findall(text):
        beside = source.parent / name
        near = place.parent / name if beside.exists() else name
        yield f"<{name}>" if bracket == "<" else f'"{near}"'


def in_namespace(number, place, text):
    paths = [name.split("::") for name in OPENED.findall(text)]
    opened = sorted({"::".join(path[:n + 1]) for path in paths for n in range(len(path))})
    own = f"joined_{number}"
    return [*(f"namespace {name} {{}}\nnamespace {own}::{name} {{ using namespace ::{name}; }}"
              for name in opened),
            f'namespace {own} {{\n#include "{place}"\n}}']


def joined(out, sources):
    lines = ["// Written by tools/joined.py."]
    places = [pathlib.Path(os.path.relpath(source, out.parent)) for source in sources]
    texts = [source.read_text(encoding="utf-8") for source in sources]
    headers = dict.fromkeys(header for each in zip(sources, places, texts)
                            for header in included(*each))
    lines += [f"#include {header}" for header in headers]
    for number, (place, text) in enumerate(zip(places, texts)):
        lines += in_namespace(number, place, text)
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("sources", type=pathlib.Path, nargs="+")
    options = parser.parse_args()
    text = "\n".join(joined(options.out, options.sources)) + "\n"
    if options.out.exists() and options.out.read_text(encoding="utf-8") == text:
        return  # another build tree has written it
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
