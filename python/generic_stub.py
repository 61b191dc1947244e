# SPDX-License-Identifier: MIT
"""Makes the states of a stub generic: a.L is a float, or an array, by what `a` was made from.

nanobind writes what a function takes and returns, but not how the one follows from the other. Here
a class that has a shape gets a parameter, float or array; a function of states or of times `t`
returns what it was given. Run by CMake on the stub that nanobind wrote: generic_stub.py FROM TO.
"""

from __future__ import annotations

import pathlib
import re
import sys

ARRAY = "numpy.typing.NDArray[numpy.float64]"
FLOATS = f"float | {ARRAY}"
ARGUMENT = "numpy.typing.ArrayLike"
HEADER = f"""from typing import Generic
from typing_extensions import TypeVar

_Value = TypeVar("_Value", covariant=True, default={FLOATS})

"""
SIGNATURE = re.compile(r"^(\s*)def (\w+)\((.*)\) -> (.*?):( \.\.\.)?$")


def split(arguments: str) -> list[str]:
    """At the commas that lie in no brackets."""
    parts, depth = [""], 0
    for character in arguments:
        depth += (character in "[(") - (character in "])")
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts]


class Signature:
    """One line of a stub that begins a function."""

    def __init__(self, line: str, states: set[str]) -> None:
        match = SIGNATURE.match(line)
        assert match is not None, line
        self.indent, self.name, arguments, self.returns, self.body = match.groups()
        self.arguments = split(arguments)
        self._states = states
        types = [(i, *a.partition(": ")[::2]) for i, a in enumerate(self.arguments)]
        self.of_states = [i for i, _, said in types if said in states]
        self.of_times = [
            i for i, name, said in types if name == "t" and said.split(" = ")[0] == ARGUMENT
        ]

    def returns_as_given(self) -> bool:
        found = bool(self.of_states or self.of_times)
        return found and (self.returns in self._states or self.returns == FLOATS)

    def text(self, value: str, given: str, time: str, ends: str = "") -> str:
        """That returns `value`, of states of `given` and times of type `time`."""
        arguments = list(self.arguments)
        for i in self.of_states:
            arguments[i] += f"[{given}]"
        for i in self.of_times:
            arguments[i] = arguments[i].replace(ARGUMENT, time)
        returns = value if self.returns == FLOATS else f"{self.returns}[{value}]"
        head = f"{self.indent}def {self.name}({', '.join(arguments)})"
        return f"{head} -> {returns}:{ends or self.body or ''}"

    def constructors(self, state: str, fields: set[str]) -> list[str]:
        """Of a state whose `fields` are numbers: all floats, or else arrays."""
        rest = self.arguments[1:]
        floats = [
            a.replace(f": {ARGUMENT}", ": float") if a.partition(":")[0] in fields else a
            for a in rest
        ]
        lines = []
        for value, arguments in (("float", floats), (ARRAY, rest)):
            given = ", ".join([f"self: {state}[{value}]", *arguments])
            lines.append(f"{self.indent}def __init__({given}) -> None: ...")
        return lines


def states_of(lines: list[str]) -> dict[str, set[str]]:
    """The classes of states with their fields that are numbers; none where one is a vector, whose
    type does not say whether it is one."""
    found: dict[str, set[str]] = {}
    name, numbers, vectors = "", set(), False
    for line in lines:
        if match := re.match(r"class (\w+)", line):
            name, numbers, vectors = match.group(1), set(), False
        elif match := re.match(r"    def (\w+)\(self\) -> (.*):$", line):
            if match.group(2) == FLOATS:
                numbers.add(match.group(1))
            vectors = vectors or match.group(2) == ARRAY
        elif line.startswith("    def reshape(self, shape: object)"):
            found[name] = set() if vectors else numbers
    return found


def overloads(lines: list[str], result: list[str], rest: str) -> None:
    """The lines of functions of one name; a decorator that stands before them already serves."""
    if result and result[-1].strip() == "@overload":
        result.pop()
    indent = re.match(r"\s*", lines[0]).group()  # type: ignore[union-attr]
    for line in [*lines, rest]:
        result += [f"{indent}@overload", line]
        if line is not rest:
            result.append("")


def generic(text: str) -> str:
    lines = text.split("\n")
    states = states_of(lines)
    if not states:
        raise SystemExit("generic_stub.py: the stub has no class of states")
    owner, result, imported = "", [], False
    for line in lines:
        if match := re.match(r"class (\w+)(.*):$", line):
            owner = match.group(1)
            if owner in states:
                line = f"class {owner}(Generic[_Value]):"
        if not imported and re.match(r"(class|def) ", line):
            result += HEADER.split("\n")
            imported = True
        match = SIGNATURE.match(line)
        if match is None:
            result.append(line)
            continue
        signature = Signature(line, set(states))
        inside = owner in states and line.startswith("    ")
        if inside and signature.name == "__init__":
            if states[owner]:
                *first, last = signature.constructors(owner, states[owner])
                overloads(first, result, last)
            else:
                result.append(line)
        elif inside and signature.returns in (FLOATS, owner):
            value = {"__getitem__": "typing.Any", "reshape": ARRAY}.get(signature.name, "_Value")
            result.append(signature.text(value, value, ARGUMENT))
        elif signature.returns_as_given() and not signature.of_times:
            result.append(signature.text("_Value", "_Value", ARGUMENT))
        elif signature.returns_as_given():
            of_one = signature.text("float", "float", "float", " ...")
            overloads([of_one], result, signature.text(ARRAY, "typing.Any", ARGUMENT))
        else:
            result.append(line)
    return "\n".join(result).replace("typing.Any", "Any")


def main() -> None:
    written, wanted = map(pathlib.Path, sys.argv[1:])
    wanted.write_text(generic(written.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
