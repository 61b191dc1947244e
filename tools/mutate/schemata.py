# SPDX-License-Identifier: MIT
"""Sources with all drawn mutants in them at once, each behind `polhode_mutants::active(number)`.

A mutated arm holds the text as it was: no two mutants are active together. The original arm goes on
with the mutants inside of it. Lines keep their numbers, so that compilers' messages lead back.
"""


def rewritten(source, numbered_mutants):
    """`source` (bytes) with the mutants [(number, Mutant)] of this file."""
    order = sorted(numbered_mutants, key=lambda n: (n[1].start, -n[1].end, n[0]))
    text, last = _rendered(source, 0, len(source), order, 0)
    if last != len(order):
        raise ValueError("schemata: mutants that overlap without one being inside of the other")
    return text


def _rendered(source, start, end, order, i):
    """source[start:end] with the mutants order[i:] that lie in it, and the index after them."""
    parts, at = [], start
    while i < len(order) and order[i][1].start < end:
        first = order[i][1]
        if first.start < at or first.end > end:
            raise ValueError(f"schemata: {first.file}:{first.line}: {first.original} overlaps")
        parts.append(source[at:first.start])
        here = []
        while i < len(order) and (order[i][1].start, order[i][1].end) == (first.start, first.end):
            here.append(order[i])
            i += 1
        inner, i = _rendered(source, first.start, first.end, order, i)
        parts.append(_choice(here, inner))
        at = first.end
    parts.append(source[at:end])
    return b"".join(parts), i


def _choice(here, inner):
    text = b"(" + inner + b")"
    for number, m in reversed(here):
        mutated = m.arm
        text = b"(polhode_mutants::active(%d) ? (%s) : %s)" % (number, mutated.encode(), text)
    cast = next((m.cast for _, m in here if m.cast), "")
    return b"static_cast<%s>%s" % (cast.encode(), text) if cast else text
