# SPDX-License-Identifier: MIT
"""Columns with their units, read from whatever holds them, and their names as print has them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter, MultipleLocator
from numpy.typing import NDArray

from polhode import DomainError, Units
from polhode._core import _numbers

# Columns of scenario files that are angles; in a table without units they are in radians.
ANGLES = frozenset(
    "phi theta psi l g h sigma g0 phi_l phi_g phi_h phi_osc theta_osc psi_osc l_osc g_osc h_osc "
    "I_f h_f I_m h_m I_r h_r I_f_rel h_f_rel I_m_rel h_m_rel I_r_rel h_r_rel".split()
)
SYMBOLS = {
    **{name: rf"\{name}" for name in ("phi", "theta", "psi", "Phi", "Theta", "Psi", "sigma")},
    **{f"w{k}": rf"\omega_{k}" for k in (1, 2, 3)},
    **{f"W{k}": rf"\Omega_{k}" for k in (1, 2, 3)},
    **{f"w{k}_rel": rf"\omega_{k}^{{\rm rel}}" for k in (1, 2, 3)},
    **{f"phi_{k}": rf"\varphi_{k}" for k in "lgh"},
    "phi0": r"\phi_0",
    "psi0": r"\psi_0",
    "dE": r"\Delta E",
}
SUBSCRIPT = {
    **{word: rf"{{\rm {word}}}" for word in ("osc", "rel", "short", "max")},
    "phi": r"\phi",
    "psi": r"\psi",
}


def radians_in(unit: str) -> float | None:
    """Radians in a unit of angle of scenarios; None for what is no such unit."""
    try:
        return float(Units().to_core(1.0, "angle", unit))
    except DomainError:
        return None


def turn_in(unit: str) -> float | None:
    """A full turn in a unit of angle; None for what is no such unit."""
    radians = radians_in(unit)
    return None if radians is None else 2 * np.pi / radians


def symbol(name: str) -> str:
    """The name of a column as mathtext; a name that is no symbol of polhode's as it is.

    symbol("theta_osc") is theta with a subscript, symbol("temperature") is "temperature"."""
    if name in SYMBOLS:
        return f"${SYMBOLS[name]}$"
    stem, _, rest = name.partition("_")
    if len(stem) == 1 and stem.isalpha() and not rest:
        return f"${stem}$"
    if len(stem) == 2 and stem[0].isalpha() and stem[1].isalnum() and not rest:
        return f"${stem[0]}_{stem[1]}$"
    if rest and (stem in SYMBOLS or len(stem) == 1):
        parts = ", ".join(SUBSCRIPT.get(part, part) for part in rest.split("_"))
        return f"${SYMBOLS.get(stem, stem)}_{{{parts}}}$"
    return name


def axis_label(names: Iterable[str], unit: str) -> str:
    """Symbols and unit, as in "theta, psi (rad)"; without a unit where there is none. Of long names
    what they share: "turn (deg)" of turn_x, turn_y, turn_z."""
    listed = list(names)
    shared = os.path.commonprefix(listed).rstrip("_")
    if len(listed) > 1 and len(shared) > 2:
        listed = [shared]
    text = ", ".join(symbol(name) for name in listed)
    return f"{text} ({unit_text(unit)})" if unit and unit != "1" else text


def unit_text(unit: str) -> str:
    """A unit with its exponents raised: "kg m2/s" as kg m^2/s."""
    raised = "".join(
        f"$^{{{c}}}$" if c.isdigit() and k and unit[k - 1].isalpha() else c
        for k, c in enumerate(unit)
    )
    return raised


def angle_axis(axis: Axis, unit: str = "rad") -> None:
    """Ticks at quarters of a turn on an axis (ax.xaxis) of angles that shows half a turn."""
    low, high = sorted(axis.get_view_interval())
    turn = turn_in(unit)
    if turn is None:
        raise ValueError(f"angle_axis: got unit {unit!r}; expected one of angle")
    half = turn / 2
    if high - low < 0.9 * half:
        return
    if abs(high - low - 2.2 * half) < 0.22 * half:
        # The range of a wrapped angle has its own ends; margins beyond them would be empty.
        middle = half * np.round((low + high) / (2 * half))
        axis.set_view_interval(middle - half, middle + half, ignore=True)
    axis.set_major_locator(MultipleLocator(half / 2))
    if unit == "rad":
        axis.set_major_formatter(FuncFormatter(lambda value, _: _multiple_of_pi(value)))


def _multiple_of_pi(value: float) -> str:
    halves = round(value / (np.pi / 2))
    if halves == 0:
        return "0"
    over, under = (halves, "/2") if halves % 2 else (halves // 2, "")
    number = {1: "", -1: "-"}.get(over, str(over))
    return rf"${number}\pi{under}$"


@dataclass(frozen=True)
class Table:
    """Times and columns of one run, and the unit of each ("" where it is not known)."""

    t: NDArray[np.float64]
    columns: Mapping[str, NDArray[np.float64]]
    units: Mapping[str, str]

    def turn(self, name: str) -> float | None:
        """A full turn in the unit of a column that is an angle; None for any other column."""
        return turn_in(self.units.get(name, ""))


def table(
    source: Any,
    names: Iterable[str],
    system: Any = None,
    units: Mapping[str, str] | None = None,
) -> Table:
    """The named columns of a Trajectory, Results, DataFrame, Dataset, or mapping with "t".

    Units are those given, else those of the source (`.units`, or `.attrs["units"]`), else rad for
    angles. ValueError naming a column that is not there, or has not one number per time."""
    names = list(names)
    # A Trajectory computes its columns, so that they are asked for by name; all else has them.
    held = source.columns(names, system) if callable(getattr(source, "columns", None)) else source
    if getattr(getattr(held, "index", None), "name", None) == "t":
        held = held.reset_index()  # of a DataFrame
    own = getattr(source, "units", None) or getattr(source, "attrs", {}).get("units") or {}
    found = {name: _column(held, name) for name in ("t", *names)}
    said = {name: x.attrs["units"] for name, x in found.items() if "units" in _attributes(x)}
    known = {**{name: "rad" for name in ANGLES}, **said, **own, **(units or {})}
    t = _numbers(found.pop("t"), "t")
    columns = {name: _numbers(x, name) for name, x in found.items()}
    for name, numbers in columns.items():
        if numbers.shape != t.shape or t.ndim != 1:
            raise ValueError(
                f'column "{name}" has shape {numbers.shape}; expected one number for each of the '
                f"times of shape {t.shape}"
            )
    return Table(t, columns, {name: known.get(name, "") for name in ("t", *names)})


def _attributes(column: Any) -> Mapping[str, Any]:
    """Of a variable of xarray; nothing else says its unit by itself."""
    return getattr(column, "attrs", {})


def _column(held: Any, name: str) -> Any:
    try:
        return held[name]
    except KeyError:
        there = ", ".join(str(key) for key in held)
        raise ValueError(f'no column "{name}"; there are: {there}') from None
