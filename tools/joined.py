#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes a source that includes others, so that the compiler reads their headers once.

tools/joined.py [--apart] OUT SOURCE...

--apart keeps each source in a namespace of its own: two tests may both have an `eps`. Then all
headers come first, and what a source puts into `namespace polhode` sees what the library has there.
"""

import argparse
import pathlib
import re

INCLUDE = re.compile(r'^#include ([<"])([^>"]+)[>"]', re.MULTILINE)
OPENED = re.compile(r"^namespace ([\w:]+) \{", re.MULTILINE)


def included(source, text):
    for bracket, name in INCLUDE.findall(text):
        beside = source.parent / name
        yield f"<{name}>" if bracket == "<" else f'"{beside if beside.exists() else name}"'


def in_namespace(number, source, text):
    paths = [name.split("::") for name in OPENED.findall(text)]
    opened = sorted({"::".join(path[:n + 1]) for path in paths for n in range(len(path))})
    own = f"joined_{number}"
    return [*(f"namespace {name} {{}}\nnamespace {own}::{name} {{ using namespace ::{name}; }}"
              for name in opened),
            f'namespace {own} {{\n#include "{source}"\n}}']


def joined(sources, apart):
    lines = ["// Written by tools/joined.py."]
    if not apart:
        return lines + [f'#include "{source}"' for source in sources]
    texts = [source.read_text(encoding="utf-8") for source in sources]
    headers = dict.fromkeys(header for source, text in zip(sources, texts)
                            for header in included(source, text))
    lines += [f"#include {header}" for header in headers]
    for number, (source, text) in enumerate(zip(sources, texts)):
        lines += in_namespace(number, source, text)
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--apart", action="store_true")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("sources", type=pathlib.Path, nargs="+")
    options = parser.parse_args()
    text = "\n".join(joined(options.sources, options.apart)) + "\n"
    if options.out.exists() and options.out.read_text(encoding="utf-8") == text:
        return  # another build tree has written it
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
