# SPDX-License-Identifier: MIT
"""Which mutants are made: so many of all, by a seed, every layer with its share.

The order of a mutant is a hash of the seed and of its name, so that a change of one file leaves the
draw from the others as it was.
"""

import hashlib


def rank(seed, mutant):
    return hashlib.sha256(f"{seed} {mutant.key}".encode()).hexdigest()


def shares(counts, total):
    """Of `total`, to each layer in proportion to its candidates, but half of an even share at
    least."""
    layers = [layer for layer in counts if counts[layer] > 0]
    everything = sum(counts.values())
    if total >= everything:
        return dict(counts)
    even = 0.5 * total / len(layers)
    exact = {layer: even + 0.5 * total * counts[layer] / everything for layer in layers}
    result = {layer: min(counts[layer], int(exact[layer])) for layer in layers}
    by_rest = sorted(layers, key=lambda layer: (int(exact[layer]) - exact[layer], layer))
    while sum(result.values()) < total:
        for layer in by_rest:
            if result[layer] < counts[layer] and sum(result.values()) < total:
                result[layer] += 1
    return result


def drawn(mutants, seed, total):
    """The mutants of this seed, in a fixed order."""
    layers = {}
    for m in mutants:
        layers.setdefault(m.layer, []).append(m)
    wanted = shares({layer: len(ms) for layer, ms in sorted(layers.items())}, total)
    chosen = []
    for layer in sorted(layers):
        chosen += sorted(layers[layer], key=lambda m: rank(seed, m))[:wanted.get(layer, 0)]
    return sorted(chosen, key=lambda m: rank(seed, m))
