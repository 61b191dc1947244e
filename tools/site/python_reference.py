# SPDX-License-Identifier: MIT
"""The Python reference: the directive `names`, and docstrings as Sphinx's autodoc takes them.

    ```{names} polhode
    RotorState rotor_state
    ```

documents these names of a module. Docstrings are plain text with the sections of numpydoc, an
entry being `name : what it is`."""

import importlib
import inspect
import re
from collections.abc import Mapping

import stubs
from inventories import short_names
from restructured import escaped
from sphinx.addnodes import pending_xref
from sphinx.util.docutils import SphinxDirective

FIELDS = {"Parameters": "param", "Raises": "raises", "Attributes": "ivar"}
SHORT_NAMES = short_names()
ENTRY = re.compile(r"(\S.*?) : ?(.*)$")
UNDERLINE = re.compile(r"-{3,}$")


def kind(thing) -> str:
    if inspect.isclass(thing):
        return "autoexception" if issubclass(thing, BaseException) else "autoclass"
    return "autofunction" if callable(thing) else "autodata"


class Names(SphinxDirective):
    required_arguments = 1
    has_content = True

    def run(self):
        (module,) = self.arguments
        lines = []
        for name in " ".join(self.content).split():
            thing = getattr(importlib.import_module(module), name)
            members = ["   :members:"] if inspect.isclass(thing) else []
            if inspect.isclass(thing) and issubclass(thing, Mapping):  # what results share
                members.append("   :inherited-members: Mapping")
            lines += [f".. {kind(thing)}:: {module}.{name}", *members, ""]
        return self.parse_text_to_nodes("```{eval-rst}\n" + "\n".join(lines) + "\n```\n")


def described(title: str, lines: list[str]) -> tuple[list[str], int]:
    """The entries under the title of a section as fields, and how many lines they took.

    After an empty line only another parameter goes on with it."""
    out, at = [], 0
    while at < len(lines):
        entry = ENTRY.match(lines[at])
        if not lines[at].strip():
            if title != "Parameters" or not any(map(ENTRY.match, lines[at + 1 : at + 2])):
                break
            at += 1
            continue
        end = at + 1
        while end < len(lines) and lines[end].startswith("    "):
            end += 1
        name, first = (entry[1], entry[2]) if entry else (lines[at], "")
        text = escaped(" ".join([first, *(line.strip() for line in lines[at + 1 : end])]).strip())
        if title in FIELDS:
            out.append(f":{FIELDS[title]} {name.replace(', ', ',')}: {text}")
        else:
            out.append(f":{title.lower()}: {escaped(name)} -- {text}")
        at = end
    return [*out, ""], at


def of_overloads(functions: list) -> str:
    """What is said of an overloaded function: a text that all share, or each with its arguments.
    The stubs write a text that neighbours share at the last of them."""
    shared, found = [], []
    for function in functions:
        names = inspect.signature(function).parameters.values()
        kinds = [str(p.annotation).rpartition(".")[2] for p in names if p.name != "self"]
        shared.append(f"``({', '.join(kinds)})``")
        if function.__doc__:
            found.append((shared, inspect.getdoc(function)))
            shared = []
    if len({text for _, text in found}) == 1:
        return found[0][1]
    return "\n".join(f"- {' or '.join(kinds)}: {' '.join(text.split())}" for kinds, text in found)


def docstring(app, what, name, thing, options, lines) -> None:
    """A docstring as reStructuredText: plain text, fields, examples of a session."""
    overloaded = stubs.overloads.get(name)
    given, out, at = of_overloads(overloaded).splitlines() if overloaded else lines, [], 0
    while at < len(given):
        line, following = given[at], given[at + 1 : at + 2]
        if following and line.strip() and UNDERLINE.match(following[0]):
            fields, taken = described(line.strip(), given[at + 2 :])
            out += ["", *fields]
            at += 1 + taken
        elif ENTRY.match(line) and not (out and out[-1].strip()):
            fields, taken = described("Parameters", given[at:])
            out += fields
            at += taken - 1
        else:
            out.append(line if line.startswith(">>>") else escaped(line))
        at += 1
    lines[:] = [*out, ""]


def keep_words(app, function, bound) -> None:
    """Annotations stay as they are written: ArrayLike, not the union that it is."""
    if inspect.isfunction(function) and function.__annotations__:
        function.__signature__ = inspect.signature(function)
        function.__annotations__ = {}


def name_types(app, doctree) -> None:
    """Types of other packages by their full names, however a module imports them; `bytes` is
    Python's, whatever attributes have that name."""
    for node in doctree.findall(pending_xref):
        name = SHORT_NAMES.get(node["reftarget"].rpartition(".")[2])
        is_ours = node["reftarget"].startswith("polhode.")
        if node.get("refdomain") == "py" and name and not is_ours:
            node["reftarget"] = name
            for key in ("refspecific", "py:class", "py:module"):
                node.attributes.pop(key, None)


def setup(app):
    app.setup_extension("sphinx.ext.autodoc")
    stubs.declare("polhode", "_core")
    app.add_directive("names", Names)
    app.connect("autodoc-before-process-signature", keep_words, priority=900)
    app.connect("doctree-read", name_types)
    app.connect("autodoc-process-docstring", docstring, priority=100)
    return {"parallel_read_safe": True}
