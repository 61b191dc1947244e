# SPDX-License-Identifier: MIT
"""Parts of a run whose momentum goes round so often, on ever other polhodes, that it would paint a
sphere: some circuits, evenly spread over the run, show the same."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from polhode import Body

PARTS = 16
"""How many circuits are shown of a run that has more."""
ONE_POLHODE = 0.02
"""Range of the energy, over that of the body, within which polhodes lie on one another."""


def excerpts(body: Body, g: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """The momenta (n, 3) of a run on a sphere in the parts to draw; one part where all is drawn.

    A circuit is a path as long as the equator."""
    steps = np.linalg.norm(np.diff(g, axis=0), axis=-1)
    path = np.concatenate([[0.0], np.cumsum(steps)])
    size = np.linalg.norm(g[0])
    circuit = 2.0 * np.pi * size
    inverse = 1.0 / np.asarray(body.moments)
    energy = np.sum(g * g * inverse, axis=-1) / size**2
    spread = np.ptp(energy) > ONE_POLHODE * np.ptp(inverse)
    if not spread or path[-1] < PARTS * circuit:
        return [g]
    starts = np.linspace(0.0, path[-1] - circuit, PARTS)
    first = np.searchsorted(path, starts)
    last = np.searchsorted(path, starts + circuit) + 1
    return [g[a:b] for a, b in zip(first, last)]
