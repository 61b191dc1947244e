# SPDX-License-Identifier: MIT
"""Orbit mean-elements messages (OMM, CCSDS 502.0) as texts: XML, JSON, CSV or KEYWORD = value."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Mapping
from typing import Any
from xml.etree import ElementTree

Fields = dict[str, str]

# What these fields must say, if they are there, of elements for SGP4.
_EXPECTED = {
    "TIME_SYSTEM": ("UTC",),
    "REF_FRAME": ("TEME", "TEMEOFDATE"),
    "CENTER_NAME": ("EARTH",),
    "MEAN_ELEMENT_THEORY": ("SGP4", "SDP4", "SGP/SGP4", "SGP4/SDP4", "SGP"),
    "EPHEMERIS_TYPE": ("0", "2"),
}
_RANGES = {
    "MEAN_MOTION": (1e-3, 20.0),  # revolutions a day
    "ECCENTRICITY": (0.0, 0.999999),
    "INCLINATION": (0.0, 180.0),
    "RA_OF_ASC_NODE": (-360.0, 360.0),
    "ARG_OF_PERICENTER": (-360.0, 360.0),
    "MEAN_ANOMALY": (-360.0, 360.0),
    "BSTAR": (-1e3, 1e3),
}
# float and int also take 1_0 and digits of other scripts.
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
# What SGP4 leaves unused.
DEFAULTS = {
    "OBJECT_ID": "", "CLASSIFICATION_TYPE": "U", "EPHEMERIS_TYPE": "0", "ELEMENT_SET_NO": "0",
    "REV_AT_EPOCH": "0", "MEAN_MOTION_DOT": "0", "MEAN_MOTION_DDOT": "0",
}  # fmt: skip
_UNUSED_NUMBERS = ("ELEMENT_SET_NO", "REV_AT_EPOCH", "MEAN_MOTION_DOT", "MEAN_MOTION_DDOT")
_KVN_START = "CCSDS_OMM_VERS"


def messages(text: str) -> list[Fields] | None:
    """The fields of each message of a text; None for a text that is no OMM.

    ValueError for a text that begins as one but is damaged.
    """
    start = text.lstrip("\ufeff \t\r\n")
    if start.startswith("<"):
        return _from_xml(start)
    if start.startswith(("[", "{")):
        return _from_json(start)
    first = start.partition("\n")[0]
    if re.match(rf"(COMMENT .*|{_KVN_START}\s*=.*)$", first.strip()):
        return _from_kvn(start)
    if "MEAN_MOTION" in first and "," in first:
        return _from_csv(start)
    return None


def _from_xml(text: str) -> list[Fields]:
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as wrong:
        raise ValueError(f"not XML: {wrong}") from None

    def named(name: str) -> list[ElementTree.Element]:
        return [node for node in root.iter() if _tag(node) == name]

    # a message has one segment; some files have none of these levels
    found = named("segment") or named("omm") or [root]
    return [
        _once((_field(leaf), leaf.text or "")
              for leaf in one.iter() if not len(leaf) and _tag(leaf) != "COMMENT")
        for one in found
    ]  # fmt: skip


def _field(leaf: ElementTree.Element) -> str:
    """Each parameter of a user is a field of its own."""
    name = _tag(leaf)
    return f"{name}_{leaf.get('parameter', '')}" if name == "USER_DEFINED" else name


def _tag(node: ElementTree.Element) -> str:
    return node.tag.rpartition("}")[2]  # without its namespace


def _from_json(text: str) -> list[Fields]:
    try:
        data = json.loads(text, object_pairs_hook=_once)
    except json.JSONDecodeError as wrong:
        raise ValueError(f"not JSON: {wrong}") from None
    data = data if isinstance(data, list) else [data]
    if not all(isinstance(one, dict) for one in data):
        raise ValueError("expected a list of messages in JSON, each an object of its fields")
    return data


def _from_kvn(text: str) -> list[Fields]:
    pairs: list[list[tuple[str, str]]] = []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.strip()
        if not line or line.startswith("COMMENT"):
            continue
        key, equals, value = (part.strip() for part in line.partition("="))
        if not equals:
            raise ValueError(f'line {number}: got "{line[:80]}"; expected KEYWORD = value')
        if key == _KVN_START:
            pairs.append([])
        if not pairs:
            raise ValueError(f"line {number}: expected {_KVN_START} before {key[:80]}")
        # a unit may stand behind the value: 7.1 [deg]
        pairs[-1].append((key, re.sub(r"\s*\[[^\]]*\]$", "", value)))
    return [_once(one) for one in pairs]


def _from_csv(text: str) -> list[Fields]:
    rows = [row for row in csv.reader(text.splitlines(), skipinitialspace=True) if row]
    names = [name.strip() for name in rows[0]]
    for number, row in enumerate(rows[1:], 1):
        if len(row) != len(names):
            raise ValueError(f"message {number}: has {len(row)} fields; the first line names "
                             f"{len(names)}")  # fmt: skip
    return [_once(zip(names, row, strict=True)) for row in rows[1:]]


def _once(pairs: Any) -> Fields:
    """A field that a message has twice is an error, so that none takes the place of another."""
    fields: Fields = {}
    for name, value in pairs:
        text = "" if value is None else str(value).strip()
        if fields.setdefault(name, text) != text:
            raise ValueError(f'the field {name} is there twice, "{fields[name][:80]}" and '
                             f'"{text[:80]}"')  # fmt: skip
    return fields


def required(fields: Mapping[str, str], name: str) -> str:
    value = fields.get(name, "")
    if not value:
        raise ValueError(f"the field {name} is missing")
    return value


def elements(fields: Mapping[str, str]) -> Fields:
    """The numbers that SGP4 needs; ValueError for one that is missing or beyond its range, and for
    an unused one that is no number."""
    for name, (least, most) in _RANGES.items():
        text = required(fields, name)
        if not (_NUMBER.fullmatch(text.strip()) and least <= float(text) <= most):
            raise ValueError(f'{name}: got "{text[:80]}"; expected a number from {least:g} to '
                             f"{most:g}")  # fmt: skip
    for name in _UNUSED_NUMBERS:
        text = fields.get(name, "")
        if text and not _NUMBER.fullmatch(text.strip()):
            raise ValueError(f'{name}: got "{text[:80]}"; expected a number')
    return {name: fields[name] for name in _RANGES}


def require_sgp4(fields: Mapping[str, str]) -> None:
    """ValueError for elements of another theory, time system, frame or planet."""
    for name, good in _EXPECTED.items():
        value = fields.get(name, "")
        if value and value.upper() not in good:
            raise ValueError(f'{name}: got "{value[:80]}"; SGP4 elements have {good[0]}')
