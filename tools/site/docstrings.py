# SPDX-License-Identifier: MIT
"""Griffe extension: what the reference shows of the package.

The compiled module is read from its stubs, which know every signature. Docstrings are plain text
with the sections of numpydoc (Parameters, Returns, Raises), an entry being `name : what it is`;
here they become Markdown."""

import pathlib
import re

import griffe

COMPILED = "_core"
UNDERLINE = re.compile(r"-{3,}$")
ENTRY = re.compile(r"(\S.*?) :(?: (.*))?$")


def escaped(text: str) -> str:
    """What Markdown would misread outside of backticks: q*, <, [SA (84)]."""
    parts = re.split(r"(`[^`]*`)", text.replace("``", "`"))
    parts[::2] = [re.sub(r"([*_\[\]\\])", r"\\\1", part.replace("&", "&amp;").replace("<", "&lt;"))
                  for part in parts[::2]]
    return re.sub(r"\\\*\\\*(\w+)\\\*\\\*", r"**\1**", "".join(parts))


def section(title: str, lines: list[str]) -> tuple[list[str], int]:
    """The entries under a title as a definition list, and how many lines they took."""
    out, at = [f"**{title}**", ""], 0
    while at < len(lines):
        head = lines[at]
        entry = ENTRY.match(head)
        if not head.strip():
            following = lines[at + 1] if at + 1 < len(lines) else ""
            if title != "Parameters" or not ENTRY.match(following):
                break
            at += 1
            continue
        body = []
        while at + 1 < len(lines) and lines[at + 1].startswith("    "):
            at += 1
            body.append(lines[at].strip())
        at += 1
        if entry:
            text = " ".join([entry[2] or "", *body]).strip()
            out += [f"`{entry[1]}`", f":   {escaped(text)}", ""]
        elif body:
            out += [escaped(head), f":   {escaped(' '.join(body))}", ""]
        else:
            out += [escaped(head), ""]
    return out, at


def as_markdown(text: str) -> str:
    lines, out, at = text.splitlines(), [], 0
    while at < len(lines):
        if at + 1 < len(lines) and lines[at].strip() and UNDERLINE.match(lines[at + 1]):
            shown, taken = section(lines[at].strip(), lines[at + 2:])
            out += ["", *shown]
            at += 2 + taken
        elif lines[at].startswith(">>> "):
            end = next((k for k in range(at, len(lines)) if not lines[k].strip()), len(lines))
            out += ["```pycon", *lines[at:end], "```"]
            at = end
        else:
            out.append(escaped(lines[at]))
            at += 1
    return "\n".join(out)


def arguments(overload: griffe.Function) -> str:
    """What tells a signature from the others: `body, EulerRates`."""
    found = []
    for parameter in overload.parameters:
        kind = str(parameter.annotation or "").split(".")[-1]
        found.append(parameter.name if kind in ("", "Body", "ArrayLike", "object") else kind)
    return ", ".join(name for name in found if name != "self")


def overloads_text(overloads: list[griffe.Function]) -> str:
    """One docstring, or one line for each with the signatures that share it: the stubs write a
    docstring that neighbours share at the last of them."""
    shared, lines = [], []
    for overload in overloads:
        shared.append(arguments(overload))
        if overload.docstring:
            lines.append((shared, overload.docstring.value))
            shared = []
    if len({text for _, text in lines}) <= 1:
        return lines[0][1] if lines else ""
    return "\n".join(f"- {' or '.join(f'`({s})`' for s in signatures)}: {' '.join(text.split())}"
                     for signatures, text in lines)


def implemented(overloads: list[griffe.Function]) -> griffe.Function:
    """One function for all overloads; the last signature stands where an implementation's would."""
    last = overloads[-1]
    function = griffe.Function(last.name, parameters=last.parameters, returns=last.returns,
                               parent=last.parent, lineno=last.lineno, endlineno=last.endlineno)
    function.labels |= last.labels - {"overload"}
    function.docstring = griffe.Docstring(overloads_text(overloads), parent=function)
    function.overloads = overloads[:-1]
    return function


def give_overloads(scope: griffe.Module | griffe.Class) -> None:
    for name, overloads in list(scope.overloads.items()):
        if overloads:
            scope.set_member(name, implemented(overloads))
    for member in scope.members.values():
        if not member.is_alias and member.is_class:
            give_overloads(member)


def stubs(package: griffe.Module) -> griffe.Module:
    path = pathlib.Path(package.filepath).parent / f"{COMPILED}.pyi"
    module = griffe.visit(COMPILED, filepath=path, code=path.read_text(encoding="utf-8"),
                          parent=package)
    give_overloads(module)
    return module


def mend(thing: griffe.Object) -> None:
    if thing.docstring:
        thing.docstring.value = as_markdown(thing.docstring.value)
    for member in thing.members.values():
        if not member.is_alias:
            mend(member)


class Docstrings(griffe.Extension):
    def on_package(self, *, pkg: griffe.Module, **_) -> None:
        if pkg.path != "polhode":
            return
        pkg.members[COMPILED] = stubs(pkg)  # not set_member, which would merge it with the module
        compiled = f"polhode.{COMPILED}."
        for name, member in list(pkg.members.items()):
            if member.is_alias and member.target_path.startswith(compiled):
                pkg.set_member(name, griffe.Alias(name, member.target_path, parent=pkg))
        mend(pkg)
