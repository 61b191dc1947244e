# SPDX-License-Identifier: MIT
"""Texts of scenarios: compiled, from nested dicts, and to them."""

from __future__ import annotations

import copyreg
import os
import re
import warnings
from collections.abc import Mapping
from typing import Any

import numpy

from polhode import _core

# Kinds that scenario texts may name; polhode.kinds.register replaces them.
_kinds = _core._default_kinds()


def known_kinds() -> Any:
    return _kinds


def set_known_kinds(kinds: Any) -> None:
    global _kinds
    _kinds = kinds


def compiled(text: str | bytes, name: str) -> Any:
    """The scenario of a text as the extension has it; see Scenario.from_text."""
    data = text.encode("utf-8") if isinstance(text, str) else text
    shown = os.fsdecode(name).encode("utf-8", "backslashreplace").decode("utf-8")
    file = _core._Scenario.from_text(data, shown, _kinds)
    for warning in file.warnings:
        warnings.warn(warning, UserWarning, stacklevel=3)
    return file


# The compiled file that results hold is pickled as its text.
copyreg.pickle(_core._Scenario, lambda file: (compiled, (file.text, file.name)))


def text_from(data: Mapping[str, Any]) -> str:
    """The TOML of a nested dict, in its order; every number reads back to the same bits.

    TypeError, which names the key, for what TOML has not.
    """
    return "\n".join(_lines(data, "")) + "\n"


def data_from(text: str) -> dict[str, Any]:
    """The nested dict behind a TOML text: plain Python values."""
    import tomlkit  # 10 ms, for those alone who edit

    return tomlkit.parse(text).unwrap()


def value_text(value: Any, key: str) -> str:
    """The TOML of one value, tables in braces; TypeError, naming the key, for what it has not."""
    return _value(value, key)


# Not tomlkit: its arrays take a time that grows with the square of their length.
def _lines(table: Mapping[str, Any], path: str) -> list[str]:
    lines: list[str] = []
    tables: list[str] = []
    for key, value in table.items():
        name = _name(key, path)
        inner = f"{path}.{name}" if path else name
        if isinstance(value, Mapping) and not _is_value_with_unit(value):
            inside = _lines(value, inner)
            # tables in tables need no header of their own
            only_tables = len(inside) > 0 and inside[0] == ""
            tables += inside if only_tables else ["", f"[{inner}]", *inside]
        elif _is_array_of_tables(value):
            for element in value:
                tables += ["", f"[[{inner}]]", *_lines(element, inner)]
        else:
            lines.append(f"{name} = {_value(value, inner)}")
    return lines + tables  # a key after the header of a table would belong to that table


def _is_value_with_unit(value: Any) -> bool:
    return isinstance(value, Mapping) and "value" in value and set(value) <= {"value", "unit"}


def _is_array_of_tables(value: Any) -> bool:
    return (
        isinstance(value, (list, tuple))
        and len(value) > 0
        and all(isinstance(x, Mapping) and not _is_value_with_unit(x) for x in value)
    )


def _name(key: Any, path: str) -> str:
    if not isinstance(key, str):
        raise TypeError(f"{path or 'scenario'}: got a key {key!r}; expected a str")
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else _text(key)


def _text(value: str) -> str:
    import json

    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: Any, path: str) -> str:
    if isinstance(value, Mapping):
        inside = (f"{_name(key, path)} = {_value(x, f'{path}.{key}')}" for key, x in value.items())
        return "{ " + ", ".join(inside) + " }"
    if isinstance(value, (numpy.ndarray, numpy.generic)):
        if not isinstance(value, (numpy.bool_, numpy.str_)) and (
            type(value) is not numpy.ndarray or value.dtype.kind not in "biufUO"
        ):
            _core._require_plain(value, path)  # a list would lose its unit or its mask
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(x, path) for x in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if type(value) in (int, float):  # an enum is no number of a file
        return repr(value)
    if isinstance(value, str):
        return _text(value)
    raise TypeError(
        f"{path}: got {value!r}; expected a number, a text, a bool, or a list or dict of them"
    )
