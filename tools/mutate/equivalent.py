# SPDX-License-Identifier: MIT
"""Mutants shown to be equivalent, each with its reason: equivalent.toml next to this file."""

import tomllib

KEYS = {"file", "line", "original", "mutated", "reason"}


def entries(path):
    found = tomllib.loads(path.read_text()).get("mutant", [])
    for e in found:
        missing = KEYS - set(e)
        unknown = set(e) - KEYS - {"occurrence"}
        if missing or unknown:
            raise ValueError(f"{path.name}: {e.get('file')}: missing {sorted(missing)}, "
                             f"unknown {sorted(unknown)}")
    return found


def names(entry, m):
    """Whether an entry means this mutant; without `occurrence` it means all that look like it."""
    return (entry["file"], entry["line"], entry["original"], entry["mutated"]) == \
        (m.file, m.context, m.original, m.mutated) and \
        entry.get("occurrence", m.occurrence) == m.occurrence


def reason(found, m):
    return next((e["reason"] for e in found if names(e, m)), None)
