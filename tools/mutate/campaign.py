# SPDX-License-Identifier: MIT
"""Every mutant against the tests that reach it: its layer's, property, paper, the other layers'.

Results are appended as they come, so that a campaign that was stopped goes on where it was.
"""

from . import reach, results
from .tree import ABOVE, TARGETS

FIRST = 1.0  # s: the quick tests go first, in a run of their own


def programs_for(layer):
    own = f"unit_{layer}"
    return [own, *ABOVE, *(t for t in TARGETS if t != own and t not in ABOVE)]


def batches(layer, by_program):
    """The quick tests of every program, then the others."""
    quick, slow = [], []
    for program in programs_for(layer):
        order = sorted(by_program.get(program, []), key=lambda t: t.seconds)
        total, first = 0.0, []
        while order and total + order[0].seconds <= FIRST:
            total += order[0].seconds
            first.append(order.pop(0))
        quick.append(first)
        slow.append(order)
    return [b for b in quick + slow if b]


def verdict(folder, number, mutant, by_program):
    """What became of one mutant; by_program: the tests that reach it."""
    if not by_program:
        return {"status": "unreached"}
    for batch in batches(mutant.layer, by_program):
        most = 10.0 + 5.0 * sum(t.seconds for t in batch)
        caught = reach.with_mutant(folder, number, batch, most)
        if caught:
            return {"status": "caught", **caught}
    return {"status": "survived", "tests": sum(map(len, by_program.values()))}


def earlier(path, fingerprint):
    """What an earlier start has found for this state of sources and tests, by key."""
    return {r["key"]: r for r in results.read(path) if r["fingerprint"] == fingerprint}


def run(folder, kept, tests, path, fingerprint, jobs):
    """Results of all mutants {number: mutant}, by key."""
    reaching = {}
    for t in tests:
        for number in t.reached:
            reaching.setdefault(number, {}).setdefault(t.program, []).append(t)
    done = earlier(path, fingerprint)

    def one(item):
        number, m = item
        r = {"key": m.key, "fingerprint": fingerprint,
             **verdict(folder, number, m, reaching.get(number, {}))}
        results.append(path, r)
        done[m.key] = r
        print(f"{len(done):5d}  {r['status']:9} {r.get('by', ''):50.50} "
              f"{m.file}:{m.line}: {m.original:.40} -> {m.mutated:.40}", flush=True)

    results.each(one, [i for i in kept.items() if i[1].key not in done], jobs)
    return done
