# SPDX-License-Identifier: MIT
"""One look for every figure: sizes and fonts for print, colours that survive colour blindness, and
line styles and markers that survive a grey printer.

Figures draw inside `style()` (or under the decorator `styled`), so that matplotlib's own settings
stay as the user left them. Widths are those of journal columns; nothing is scaled after drawing, so
that 8 points here are 8 points on paper."""

from __future__ import annotations

import functools
import os
import pathlib
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Callable, TypeVar

import matplotlib
import numpy as np
from cycler import cycler
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

SINGLE_COLUMN = 85 / 25.4
"""Width (inches) of one column of a journal, 85 mm."""
DOUBLE_COLUMN = 170 / 25.4
"""Width (inches) of two columns, 170 mm."""
PRINT_DPI = 300

# Okabe and Ito (2008): distinguished with every common colour vision deficiency.
BLACK = "#000000"
BLUE = "#0072B2"
VERMILLION = "#D55E00"
GREEN = "#009E73"
ORANGE = "#E69F00"
SKY = "#56B4E9"
PURPLE = "#CC79A7"
GREY = "#6E6E6E"
PALE = "#EDEDED"
"""Fill of surfaces behind curves."""

SEQUENTIAL = "cividis"
"""Colour map for one number: even in lightness, the same to deuteranopes."""

HIDDEN_ALPHA = 0.4
"""Opacity of what lies behind a surface."""


@dataclass(frozen=True)
class Look:
    """How one kind of curve is drawn: colour, and what tells it apart without colour."""

    color: str
    linestyle: Any = "-"
    linewidth: float = 1.0
    marker: str = "None"

    @property
    def line(self) -> dict[str, Any]:
        """Keywords of Axes.plot for the curve without markers."""
        return {"color": self.color, "linestyle": self.linestyle, "linewidth": self.linewidth}

    @property
    def point(self) -> dict[str, Any]:
        """Keywords of Axes.plot for the marker alone."""
        return {"color": self.color, "linestyle": "None", "marker": self.marker}


DASHED = (0, (4.5, 1.6))
DOTTED = (0, (1, 1.4))
DASH_DOT = (0, (6, 1.4, 1.2, 1.4))

REGIMES: Mapping[str, Look] = MappingProxyType(
    {
        "short_axis": Look(BLUE, "-", 0.8, "o"),
        "long_axis": Look(VERMILLION, DASHED, 1.1, "s"),
        "separatrix": Look(BLACK, "-", 1.7, "D"),
        "steady": Look(BLACK, DOTTED, 1.0, "o"),
        "rest": Look(GREY, DOTTED, 1.0, "x"),
    }
)
"""The look of each regime of free rotation, by the name of polhode.free.Regime."""

SERIES: tuple[Look, ...] = (
    Look(BLUE, "-", 1.0, "o"),
    Look(VERMILLION, DASHED, 1.1, "s"),
    Look(GREEN, DASH_DOT, 1.1, "^"),
    Look(BLACK, DOTTED, 1.3, "D"),
    Look(PURPLE, (0, (8, 1.6)), 1.0, "v"),
    Look(ORANGE, (0, (3, 1, 1, 1, 1, 1)), 1.2, "P"),
    Look(SKY, (0, (2, 1)), 1.4, "X"),
)
"""Looks of curves that stand next to one another, in this order; `series(k)` goes round."""

SETTINGS: Mapping[str, Any] = MappingProxyType(
    {
        "font.family": "STIXGeneral",
        "mathtext.fontset": "stix",
        "font.size": 8.0,
        "axes.labelsize": 8.0,
        "axes.titlesize": 8.0,
        "figure.titlesize": 9.0,
        "xtick.labelsize": 7.0,
        "ytick.labelsize": 7.0,
        "legend.fontsize": 7.0,
        "legend.frameon": False,
        "legend.handlelength": 2.6,
        "axes.linewidth": 0.6,
        "xtick.major.width": 0.6,
        "ytick.major.width": 0.6,
        "xtick.minor.width": 0.4,
        "ytick.minor.width": 0.4,
        "xtick.major.size": 3.0,
        "ytick.major.size": 3.0,
        "xtick.direction": "in",
        "ytick.direction": "in",
        "xtick.top": True,
        "ytick.right": True,
        "lines.linewidth": 1.0,
        "lines.markersize": 3.5,
        "lines.markeredgewidth": 0.6,
        "patch.linewidth": 0.6,
        "hatch.linewidth": 0.4,
        "grid.linewidth": 0.3,
        "grid.color": "#BBBBBB",
        "image.cmap": SEQUENTIAL,
        "axes.formatter.use_mathtext": True,
        "axes.formatter.useoffset": False,
        "axes.prop_cycle": cycler(color=[s.color for s in SERIES])
        + cycler(linestyle=[s.linestyle for s in SERIES]),
        "figure.constrained_layout.use": True,
        "figure.dpi": 150.0,
        "savefig.dpi": float(PRINT_DPI),
        "pdf.fonttype": 42,
        "ps.fonttype": 42,
        "svg.fonttype": "none",
        "svg.hashsalt": "polhode",
    }
)
"""Matplotlib settings of the figures."""


def style() -> Any:
    """A context in which matplotlib draws in this style; afterwards the settings are restored."""
    return matplotlib.rc_context(dict(SETTINGS))


F = TypeVar("F", bound=Callable[..., Any])


def styled(draw: F) -> F:
    """Decorator: the function runs inside `style()`."""

    @functools.wraps(draw)
    def inside(*arguments: Any, **keywords: Any) -> Any:
        with style():
            return draw(*arguments, **keywords)

    return inside  # type: ignore[return-value]


def regime_look(regime: Any) -> Look:
    """The look of a polhode.free.Regime (or of its name)."""
    name = getattr(regime, "name", regime)
    if name not in REGIMES:
        raise ValueError(f"regime_look: got {regime!r}; expected one of {', '.join(REGIMES)}")
    return REGIMES[name]


def faded(color: str, opacity: float) -> tuple[float, ...]:
    """The colour as it looks with this opacity on white."""
    return tuple(1.0 - opacity * (1.0 - part) for part in to_rgb(color))


def series(index: int) -> Look:
    """The look of the curve with this index."""
    return SERIES[index % len(SERIES)]


def new_figure(width: float, height: float) -> Figure:
    """A new figure of this size (inches)."""
    return plt.figure(figsize=(width, height))


def axes_or_new(
    ax: Axes | None,
    width: float = SINGLE_COLUMN,
    height: float | None = None,
    projection: str | None = None,
) -> Axes:
    """The Axes given, or a new one alone in a figure of this size (inches; golden section)."""
    if ax is not None:
        return ax
    size = (width, width / 1.618 if height is None else height)
    return new_figure(*size).add_subplot(projection=projection)


def plane_axes(ax: Axes | None, width: float = SINGLE_COLUMN, height: float | None = None) -> Axes:
    """Axes for a picture of things in space: equal scales, no frame, no ticks.

    The picture projects by itself, with hidden lines; TypeError for 3-D Axes."""
    ax = axes_or_new(ax, width, width if height is None else height)
    if ax.name == "3d":
        raise TypeError("got 3-D Axes; expected plain ones: the figure does its own projection")
    ax.set_aspect("equal", adjustable="box")
    ax.set_axis_off()
    return ax


def panels(
    axes: Any, rows: int, columns: int, size: tuple[float, float], **keywords: Any
) -> np.ndarray:
    """An array (rows, columns) of Axes: those given, in reading order, or new ones."""
    if axes is None:
        return new_figure(*size).subplots(rows, columns, squeeze=False, **keywords)
    given = np.asarray(axes, dtype=object).ravel()
    if given.size != rows * columns:
        raise ValueError(f"got {given.size} Axes; expected {rows * columns}")
    return given.reshape(rows, columns)


def legend_above(ax: Axes, **keywords: Any) -> None:
    """A legend above the panel, side by side: for panels that are full."""
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4, handlelength=1.6,
              columnspacing=1.2, borderpad=0.2, **keywords)  # fmt: skip


def panel_label(ax: Axes, text: str) -> None:
    """Names a panel, as in (a), outside its upper left corner."""
    family = SETTINGS["font.family"]
    ax.set_title(text, loc="left", fontsize=8.0, fontweight="bold", fontfamily=family)


def figure_of(drawn: Any) -> Figure:
    """The Figure of what a figure function returned: an Axes, an array of them, or a Figure."""
    if isinstance(drawn, Figure):
        return drawn
    first = drawn if isinstance(drawn, Axes) else np.asarray(drawn, dtype=object).ravel()[0]
    if not isinstance(first, Axes):
        raise TypeError(f"figure_of: got {drawn!r}; expected Axes, an array of Axes or a Figure")
    return first.figure.figure  # of a SubFigure: the one that is saved


METADATA = {
    ".png": {"Software": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    ".svg": {"Date": None},
}


def save(drawn: Any, path: str | os.PathLike[str], dpi: int = PRINT_DPI) -> pathlib.Path:
    """Writes a figure (or the figure of Axes) at its own size: .png, .pdf, .svg and so on by name.

    The same figure gives the same bytes: no time stamp goes in. Returns the path."""
    path = pathlib.Path(path)
    with style():
        figure_of(drawn).savefig(path, dpi=dpi, metadata=METADATA.get(path.suffix.lower()))
    return path
