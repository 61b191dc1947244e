# SPDX-License-Identifier: MIT
"""The page of references, from docs/references.bib.

Every entry has a `doi`, or says in `nodoi` why it has none; tests/docs/test_site.py checks it."""

import pathlib
import re
import urllib.parse

INTRODUCTION = """\
# References

What polhode rests on. `polhode cite FILE.toml` prints those that a scenario rests on; the keys are
those of [references.bib]({bib}).
"""
ENTRY = re.compile(r"^@(\w+)\{(\w+),\n(.*?)^\}", re.MULTILINE | re.DOTALL)
FIELD = re.compile(r"^\s*(\w+)\s*=\s*\{(.*?)\},?\s*$(?=\s*(?:\w+\s*=|\Z))",
                   re.MULTILINE | re.DOTALL)
# \'{e}, {\'e} and \'e
ACCENT = re.compile(r"\{?\\(['`\"])\{?(\w)\}?\}?")
COMBINING = {"'": "\u0301", "`": "\u0300", '"': "\u0308"}


def entries(bib: str) -> list[dict]:
    """The entries in the order of the file: fields by name, with `key` and `kind`."""
    found = []
    for kind, key, body in ENTRY.findall(bib):
        fields = {name: plain(value) for name, value in FIELD.findall(body)}
        found.append({"key": key, "kind": kind, **fields})
    return found


def plain(value: str) -> str:
    value = ACCENT.sub(lambda m: m[2] + COMBINING[m[1]], value)
    value = re.sub(r"[{}]", "", value).replace("--", "\u2013")
    return re.sub(r"\s+", " ", value).strip()


def authors(entry: dict) -> str:
    names = entry["author"].split(" and ")
    names = ["et al." if name == "others" else name for name in names]
    if len(names) < 3:
        return " and ".join(names)
    return "; ".join(names).replace("; et al.", " et al.")


def place(entry: dict) -> str:
    journal = f"*{entry['journal']}*" if "journal" in entry else entry.get("publisher", "")
    volume = f" **{entry['volume']}**" if "volume" in entry else ""
    number = f"({entry['number']})" if "number" in entry else ""
    pages = f", {entry['pages']}" if "pages" in entry else ""
    return journal + volume + number + pages


def links(entry: dict) -> str:
    found = []
    if "doi" in entry:
        address = urllib.parse.quote(entry["doi"])
        found.append(f"[doi:{entry['doi']}](https://doi.org/{address})")
    if "eprint" in entry:
        found.append(f"[arXiv:{entry['eprint']}](https://arxiv.org/abs/{entry['eprint']})")
    if "url" in entry:
        found.append(f"<{entry['url']}>")
    if "nodoi" in entry:
        found.append(f"No DOI: {entry['nodoi']}.")
    return " ".join(found)


def page(root: pathlib.Path) -> str:
    path = root / "docs/references.bib"
    lines = [INTRODUCTION.format(bib="references.bib")]
    known = entries(path.read_text(encoding="utf-8"))
    for entry in sorted(known, key=lambda e: (e["author"].lower(), e.get("year", ""))):
        year = f" ({entry['year']})" if "year" in entry else ""
        what = f"{authors(entry)}{year}. {entry['title']}."
        where = place(entry)
        lines += [f"`{entry['key']}` {{ #{entry['key']} }}",
                  f":   {what}{f' {where}.' if where else ''} {links(entry)}", ""]
    return "\n".join(lines)
