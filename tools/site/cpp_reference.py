# SPDX-License-Identifier: MIT
"""The C++ reference, from the public headers: one page per layer, and per header its labels and
what it declares. Function bodies, private members and namespace detail are left out."""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import headers as header_rules  # noqa: E402  (the labels and their order)
from declarations import declarations  # noqa: E402

# The layers in the order of who may include whom, each with what it is for.
LAYERS = {
    "rotor": "Bodies, the state, and every chart that needs no motion.",
    "free": "Torque-free rotation: exact states, and the sets that belong to a motion.",
    "shape": "Bodies from their shape: meshes, mass properties, inertia integrals.",
    "orbit": "Where the attracting body is.",
    "ephemeris": "Dates and time scales, and where Sun, Moon and planets are.",
    "frame": "Reference frames that move.",
    "perturb": "What acts on a body: terms, and the concepts that one of your own satisfies.",
    "system": "A body, a frame and terms: rates, energies, both angular velocities, osculation.",
    "dynamics": "Integration of a system: problem, methods, events.",
    "series": "Poisson series: their algebra, calculus, values and text.",
    "secular": "What is averaged over rotation and orbit.",
    "analysis": "What a run shows: how chaotic it is, and of which lines it is made.",
    "ensemble": "Many runs at once, on the processors of one machine.",
    "trajectory": "What a run leaves: samples, events, outcome.",
    "text": "Units, dates and words (`polhode::io`, as the next four).",
    "tables": "Tables, meshes and ephemeris messages read; tables converted between charts.",
    "output": "Columns of a run, and the files that hold them.",
    "scenario": "Scenario files: their keys, and what is read from them.",
    "run": "Scenarios run into files: runs, maps, summaries, citations, golden cases.",
    "cli": "The command line as a library, for programs with kinds of their own.",
    "ode": "Integrators of plain equations.",
    "elliptic": "Elliptic integrals and functions, with modulus and complement.",
    "math": "Vectors, quaternions, dual numbers, double-double.",
}
INDEX = """\
# C++

`#include "polhode/polhode.hpp"` brings everything but the layers of `polhode::io` and
`polhode::ensemble`; one header brings itself and what it needs. All names are in
`namespace polhode`. Link `polhode::polhode`, and `polhode::io` for scenarios and files
([install](../../start/install.md)). Value types are templates on the number type; `RotorState` is
`BasicRotorState<double>`, and so on. Headers in folders `detail/` are the library's own.

Every header carries the same labels. **Domain** says what is legal and what is returned in
degenerate cases, **Errors** what throws; nothing else throws. `[SA (84)]` is equation (84) of the
paper; [the map](../../theory/paper_map.md) leads from it to code and test.
"""
LABEL = re.compile(rf"^({'|'.join(header_rules.LABELS)})(?: {{2,}}|$)|^(Corrections) ")


def layer_headers(root: pathlib.Path, layer: str):
    return sorted((root / "include/polhode" / layer).glob("*.hpp"))


def anchor(header: str) -> str:
    return header.replace(".", "-").replace("_", "-")


def address(name: str) -> str | None:
    """Where the site shows include/polhode, a layer or a header."""
    parts = name.removeprefix("include/polhode").strip("/").split("/")
    if parts == [""] or len(parts) == 1 and parts[0].endswith(".hpp"):
        return "reference/cpp/index.md"
    if parts[0] not in LAYERS:
        return None
    page = f"reference/cpp/{parts[0]}.md"
    return page + ("#" + anchor(parts[1]) if len(parts) == 2 else "")


def escaped(text: str) -> str:
    text = re.sub(r"([\\`*_{}\[\]#])", r"\\\1", text.replace("&", "&amp;").replace("<", "&lt;"))
    text = text.replace("$", "&#36;")
    return re.sub(r"(docs/[\w\\/-]+\.md)", page_link, text)


def page_link(match) -> str:
    path = match[1].replace("\\", "")
    return f"[{path.removeprefix('docs/')}](../../{path.removeprefix('docs/')})"


def head_comment(text: str) -> list[str]:
    lines = text.splitlines()
    lines = lines[next(i for i, line in enumerate(lines) if "SPDX" in line) + 1:]
    end = next(i for i, line in enumerate(lines) if not line.startswith("//"))
    return [line.removeprefix("//").removeprefix(" ") for line in lines[:end]]


def labels(comment: list[str]) -> list[tuple[str, str]]:
    """("", what it is), then label and text in order."""
    found = [["", []]]
    for line in comment:
        match = LABEL.match(line)
        if match:
            found.append([match[1] or match[2], [line[match.end():]]])
        else:
            found[-1][1].append(line.strip())
    return [(label, " ".join(" ".join(lines).split())) for label, lines in found]


def header_text(root: pathlib.Path, path: pathlib.Path) -> str:
    text = path.read_text(encoding="utf-8")
    found = labels(head_comment(text))
    name = path.relative_to(root / "include").as_posix()
    lines = [f"## {path.name} {{ #{anchor(path.name)} }}", "", escaped(found[0][1]), "",
             '<div class="labels" markdown>', ""]
    for label, said in found[1:]:
        if said.rstrip(".") != "none":
            lines += [label, f":   {escaped(said)}", ""]
    return "\n".join([*lines, "</div>", "", "```cpp", f'#include "{name}"', "",
                      declarations(text), "```", ""])


def pages(root: pathlib.Path) -> dict[str, str]:
    """Page in reference/cpp -> its Markdown."""
    on_disk = {p.name for p in (root / "include/polhode").iterdir() if p.is_dir()}
    if on_disk != set(LAYERS):
        differ = sorted(on_disk ^ set(LAYERS))
        raise ValueError(f"tools/site/cpp_reference.py: the layers {differ} differ")
    index = [INDEX, "| layer | what it is | headers |", "|---|---|---|"]
    found = {}
    for layer, purpose in LAYERS.items():
        headers = layer_headers(root, layer)
        links = ", ".join(f"[{p.stem}]({layer}.md#{anchor(p.name)})" for p in headers)
        index.append(f"| [{layer}]({layer}.md) | {purpose} | {links} |")
        found[f"{layer}.md"] = "\n".join([f"# {layer}", "", purpose, "",
                                          *(header_text(root, p) for p in headers)])
    top = (p for p in (root / "include/polhode").glob("*.hpp") if p.name != "polhode.hpp")
    index += ["", *(header_text(root, p) for p in sorted(top))]
    return {"index.md": "\n".join(index) + "\n", **found}
