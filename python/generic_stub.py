# SPDX-License-Identifier: MIT
"""Makes the states of a stub generic: a.L is a float, or an array, by what `a` was made from.

nanobind writes what a function takes and returns, but not how the one follows from the other. Here
a class that has a shape gets a parameter, float or array; a function of states, of times `t` or of
angles returns what it was given; lists of floats are one vector, hence one state. Run by CMake on
the stub that nanobind wrote: generic_stub.py FROM TO.
"""

from __future__ import annotations

import pathlib
import re
import sys

ARRAY = "numpy.typing.NDArray[numpy.float64]"
FLOATS = f"float | {ARRAY}"
LABELS = "numpy.typing.NDArray[numpy.int32]"
ARGUMENT = "numpy.typing.ArrayLike"
VECTOR = "Sequence[float]"
# Arguments of functions that broadcast: times, and Andoyer's angles.
NUMBERS = ("t", "l", "g", "h")
# Properties that are states, where their class says whether it is one or many.
PROPERTIES = {"initial_state": "float", "initial": "float", "s": "float", "states": ARRAY}
HEADER = f"""from collections.abc import Sequence
from typing import Any, ClassVar, Generic, overload
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
        types = self._types = [(i, *a.partition(": ")[::2]) for i, a in enumerate(self.arguments)]
        self.of_states = [i for i, _, said in types if said in states]
        self.of_times = [
            i for i, name, said in types if name in NUMBERS and said.split(" = ")[0] == ARGUMENT
        ]

    def returns_as_given(self) -> bool:
        found = bool(self.of_states or self.of_times)
        return found and (self.returns in self._states or self.returns == FLOATS)

    def of_vectors(self) -> bool:
        """Makes states of nothing but vectors, whose type may say that each is one."""
        found = any(said == ARGUMENT for _, _, said in self._types)
        return found and self.returns in self._states and not (self.of_states or self.of_times)

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

    def constructors(self, state: str, fields: dict[str, str]) -> list[str]:
        """Of a state with these `fields`: of one of each, or else of arrays. An array may still be
        one vector."""
        rest = self.arguments[1:]
        ones = []
        for argument in rest:
            name = argument.partition(":")[0]
            if ARGUMENT in argument and name not in fields:
                raise SystemExit(f"generic_stub.py: {state} has no field {name}")
            ones.append(argument.replace(ARGUMENT, fields.get(name, "")))
        lines = []
        many = FLOATS if VECTOR in fields.values() else ARRAY
        for value, arguments in (("float", ones), (many, rest)):
            given = ", ".join([f"self: {state}[{value}]", *arguments])
            lines.append(f"{self.indent}def __init__({given}) -> None: ...")
        return lines


def states_of(lines: list[str]) -> dict[str, dict[str, str]]:
    """The classes of states: their fields, each with the type of one."""
    found: dict[str, dict[str, str]] = {}
    name, fields = "", {}
    for line in lines:
        if match := re.match(r"class (\w+)", line):
            name, fields = match.group(1), {}
        elif match := re.match(r"    def (\w+)\(self\) -> (.*):$", line):
            field, said = match.groups()
            one, _, many = said.partition(" | ")
            if said == FLOATS:
                fields[field] = "float"
            elif said == ARRAY:
                fields[field] = VECTOR
            elif many == LABELS:
                fields[field] = "int" if one == "int" else f"{one} | int | str"
        elif line.startswith("    def reshape(self, shape: "):
            found[name] = fields
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
    states = states_of(text.split("\n"))
    if not states:
        raise SystemExit("generic_stub.py: the stub has no class of states")
    # A callable is called with one state.
    any_state = "|".join(states)
    # mypy takes a class for a dataclass where the table of its fields belongs to the class.
    text = re.sub(r"__dataclass_fields__: dict\b.*", "__dataclass_fields__: "
                  "ClassVar[dict[str, dataclasses.Field[Any]]] = ...", text)
    lines = re.sub(rf"(Callable\[\[float, (?:{any_state}))\]", r"\1[float]]", text).split("\n")
    properties = set(PROPERTIES)
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
            if signature.arguments[1:]:
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
            # at one time a state stays what it is
            value = "_Value" if signature.of_states else "float"
            of_one = signature.text(value, value, "float", " ...")
            overloads([of_one], result, signature.text(ARRAY, "typing.Any", ARGUMENT))
        elif signature.of_vectors():
            head = f"{line.partition(' -> ')[0]} -> {signature.returns}[float]: ..."
            overloads([head.replace(ARGUMENT, VECTOR)], result, line)
        elif signature.name in PROPERTIES and signature.returns in states:
            properties.discard(signature.name)
            result.append(signature.text(PROPERTIES[signature.name], "", ""))
        else:
            result.append(line)
    if properties:
        raise SystemExit(f"generic_stub.py: no class has a state {', '.join(sorted(properties))}")
    return "\n".join(result).replace("typing.Any", "Any")


def main() -> None:
    written, wanted = map(pathlib.Path, sys.argv[1:])
    wanted.write_text(generic(written.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
