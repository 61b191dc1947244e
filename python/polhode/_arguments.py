# SPDX-License-Identifier: MIT
"""Arguments as arrays and numbers, with a sentence when they are none."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from polhode._core import _number, _numbers

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

# A kind, or a kind and its scale.
Loss = Union[str, tuple[str, float]]
LOSSES = ("squared", "huber", "soft_l1", "cauchy")


def of_shape(value: Any, name: str, shape: tuple[int, ...]) -> Array:
    """A read-only array of exactly this shape."""
    array = np.array(_numbers(value, name), dtype=float)
    if array.shape != shape:
        raise ValueError(f"{name}: got shape {array.shape}; expected {shape}")
    array.flags.writeable = False
    return array


def column(value: Any, name: str) -> Array:
    """(N,)"""
    array = np.array(_numbers(value, name), dtype=float)
    if array.ndim != 1:
        raise ValueError(f"{name}: got shape {array.shape}; expected (N,)")
    return array


def rows(value: Any, name: str, count: int, width: int) -> Array:
    """(count, width): of that, or of one row for all of them."""
    array = np.array(_numbers(value, name), dtype=float)
    if array.shape not in ((width,), (count, width)):
        raise ValueError(
            f"{name}: got shape {array.shape}; expected ({width},) or ({count}, {width})"
        )
    return np.broadcast_to(array, (count, width))


def whole(value: Any, name: str, least: int = 1) -> int:
    number = _number(value, name)
    if not number >= least or number != int(number):
        raise ValueError(f"{name}: got {value!r}; expected a whole number from {least}")
    return int(number)


def one_of(value: Any, name: str, words: Sequence[str]) -> str:
    if value not in words:
        raise ValueError(f"{name}: got {value!r}; expected one of {' '.join(words)}")
    return value


def some_of(values: Any, name: str, words: Sequence[str]) -> list[str]:
    given = [values] if isinstance(values, str) else list(values)
    for value in given:
        one_of(value, name, words)
    return given


def loss_of(loss: Any) -> tuple[str, float]:
    """A name, or (name, scale)."""
    kind, scale = (loss, 1.0) if isinstance(loss, str) else loss
    return one_of(kind, "loss", LOSSES), float(_number(scale, "loss"))


def prior_rows(priors: Any) -> list[tuple[list[str], list[float], list[float]]]:
    """Of {name: (mean, sigma)} and {(name, ...): (means, covariance)}."""
    found = []
    for names, (mean, spread) in dict(priors or {}).items():
        if isinstance(names, str):
            center, sigma = float(_number(mean, "priors")), float(_number(spread, "priors"))
            found.append(([names], [center], [sigma * sigma]))
            continue
        n = len(names)
        means = of_shape(mean, "priors", (n,))
        covariance = of_shape(spread, "priors", (n, n))
        found.append((list(names), means.tolist(), covariance.ravel().tolist()))
    return found


def require_positive(function: str, name: str, value: Any) -> None:
    """ValueError unless the number is positive and finite; TypeError for what is no number."""
    required = f"{function}: got {name} = {value!r}; expected a positive, finite number"
    try:
        finite = math.isfinite(value)
    except TypeError:
        raise TypeError(required) from None
    value = _number(value, f"{function}: {name}")
    if not (finite and value > 0):
        raise ValueError(required)
