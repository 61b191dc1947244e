# SPDX-License-Identifier: MIT
"""One possible mutant: where it stands, what it changes, and a name that survives shifted lines."""

import dataclasses
import hashlib


@dataclasses.dataclass(frozen=True)
class Mutant:
    file: str  # from the root of the checkout
    layer: str
    operator: str
    start: int  # bytes of the file: the expression that is replaced
    end: int
    original: str  # on one line
    mutated: str
    arm: str  # what is compiled for `mutated`
    line: int
    last_line: int
    context: str  # the line on which it starts, without margins
    cast: str = ""  # the type that the expression is converted to, where it must be spelled out
    occurrence: int = 1  # among equal changes of equal lines of this file

    @property
    def identity(self):
        return (self.file, self.context, self.original, self.mutated, self.occurrence)

    @property
    def key(self):
        return hashlib.sha256("\n".join(map(str, self.identity)).encode()).hexdigest()[:12]


def numbered(mutants):
    """The same mutants, each change listed once, `occurrence` counted in the order of the text."""
    unique, counts = {}, {}
    for m in sorted(mutants, key=lambda m: (m.file, m.start, m.end, m.operator, m.mutated)):
        unique.setdefault((m.file, m.start, m.end, m.mutated), m)
    result = []
    for m in unique.values():
        at = (m.file, m.context, m.original, m.mutated)
        counts[at] = counts.get(at, 0) + 1
        result.append(dataclasses.replace(m, occurrence=counts[at]))
    return result
