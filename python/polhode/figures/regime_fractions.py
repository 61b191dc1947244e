# SPDX-License-Identifier: MIT
"""Which part of an ensemble is in each regime, against time."""

from __future__ import annotations

from matplotlib.axes import Axes

from polhode.figures.ensemble_data import Source, read_ensemble
from polhode.figures.style import (
    SINGLE_COLUMN,
    axes_or_new,
    faded,
    legend_above,
    regime_look,
    series,
    styled,
)

REGIMES = {"SAM": "short_axis", "LAM": "long_axis", "other": "separatrix"}
OPACITY = 0.55


@styled
def regime_fractions(
    source: Source,
    column: str = "mode",
    ax: Axes | None = None,
) -> Axes:
    """The part of the members in each regime, one above the other, against time.

    Parameters
    ----------
    source : EnsembleResults with statistics, the file that `polhode ensemble` wrote, or its columns
        by name.
    column : of the rows of members: "mode" (group `tumbler`) draws mode_SAM, mode_LAM, mode_other.
        A regime that no member is ever in is left out.

    ValueError for a column whose parts are not there."""
    data = read_ensemble(source, "regime_fractions")
    parts = {
        name[len(column) + 1 :]: x for name, x in data.columns.items()
        if name.startswith(f"{column}_")
    }  # fmt: skip
    if "t" not in data.columns or not parts:
        raise ValueError(
            f'regime_fractions: no parts of "{column}" against t{data.other_keep("statistics")}; '
            "expected statistics of an ensemble with the group tumbler; there are: "
            f"{', '.join(data.columns)}"
        )
    met = {name: x for name, x in parts.items() if (x > 0).any()}
    looks = [
        regime_look(REGIMES[name]) if name in REGIMES else series(k)
        for k, name in enumerate(met)
    ]  # fmt: skip
    axis = axes_or_new(ax, SINGLE_COLUMN)
    t = data.columns["t"]
    layers = axis.stackplot(
        t, *met.values(), labels=["others" if name == "other" else name for name in met],
        colors=[faded(look.color, OPACITY) for look in looks], linewidth=0.0,
    )  # fmt: skip
    total = 0.0
    for name, layer, look in zip(met, layers, looks):
        layer.set_gid(f"{column}-{name}")
        total = total + met[name]
        if name != list(met)[-1]:
            axis.plot(t, total, **look.line)
    axis.margins(x=0)
    axis.set(ylim=(0.0, 1.0), xlabel=data.label("t"), ylabel="part of the members")
    legend_above(axis)
    return axis
