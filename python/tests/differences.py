# SPDX-License-Identifier: MIT
"""Derivatives by central differences of sixth order: `slope(f, x)`."""

from typing import Any, Callable


def slope(f: Callable[[float], Any], x: float = 0.0, step: float = 2.0**-10) -> Any:
    near, middle, far = (f(x + k * step) - f(x - k * step) for k in (1, 2, 3))
    return (45 * near - 9 * middle + far) / (60 * step)
