# SPDX-License-Identifier: MIT
"""The page that shows the files of examples/, each in full."""

import pathlib

INTRODUCTION = """\
# Examples

Scenarios of real bodies, for `polhode run FILE`, and short programs. The tests run every one of
them. They are in `examples/` of the repository.
"""
LANGUAGE = {".toml": "toml", ".cpp": "cpp", ".py": "python"}


def files(root: pathlib.Path):
    return sorted(p for p in (root / "examples").iterdir() if p.suffix in LANGUAGE)


def anchor(name: str) -> str:
    return name.replace(".", "-")


def address(name: str) -> str:
    """Where the site shows `examples` or a file in it."""
    file = name.removeprefix("examples").strip("/")
    return "examples.md#" + anchor(file) if file else "examples.md"


def page(root: pathlib.Path) -> str:
    parts = [INTRODUCTION]
    for path in files(root):
        text = path.read_text(encoding="utf-8").rstrip("\n")
        parts += [f"## {path.name} {{ #{anchor(path.name)} }}\n",
                  f"````{LANGUAGE[path.suffix]}\n{text}\n````\n"]
    return "\n".join(parts)
