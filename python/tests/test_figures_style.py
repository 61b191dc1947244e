# SPDX-License-Identifier: MIT
"""The style of figures: settings are restored, looks differ by more than colour, files repeat."""

import itertools
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import polhode
import pytest
from closeness import largest, smallest
from matplotlib.colors import to_rgb
from PIL import Image
from polhode import figures
from polhode.figures import style
from rejections import rejected

BODY = polhode.Body(3.0, 4.0, 6.0)
STATE = polhode.RotorState([0.9, 0.1, -0.3, 0.2], [0.6, 0.1, 0.8])
MOTION = polhode.FreeRotation(BODY, STATE)
RUN = figures.RunData(np.linspace(0.0, 9.0, 50), MOTION.at(np.linspace(0.0, 9.0, 50)), BODY)
CALLS = {
    "momentum_sphere": lambda ax: figures.momentum_sphere(BODY, ax=ax),
    "phase_plane": lambda ax: figures.phase_plane(BODY, ax=ax),
    "frames_and_angles": lambda ax: figures.frames_and_angles(STATE, ax=ax),
    "polhode_on_ellipsoid": lambda ax: figures.polhode_on_ellipsoid(MOTION, ax=ax),
    "herpolhode": lambda ax: figures.herpolhode(MOTION, ax=ax),
    "attitude_of_body": lambda ax: figures.attitude_of_body(STATE, BODY, ax=ax),
}
PANELS = {"polhode_and_herpolhode": (lambda ax: figures.polhode_and_herpolhode(MOTION, ax=ax), 2),
          "overview": (lambda ax: figures.overview(RUN, ax=ax), 3)}


@pytest.mark.parametrize("name", CALLS)
def test_a_figure_returns_its_axes_and_leaves_the_settings(name):
    before = dict(matplotlib.rcParams)
    own = CALLS[name](None)
    assert own.figure.get_size_inches()[0] == pytest.approx(figures.SINGLE_COLUMN)
    given = plt.figure().add_subplot()
    assert CALLS[name](given) is given
    assert len(given.lines) >= 3
    assert dict(matplotlib.rcParams) == before
    if name not in ("phase_plane", "herpolhode"):
        with pytest.raises(TypeError, match="got 3-D Axes; expected plain ones"):
            CALLS[name](plt.figure().add_subplot(projection="3d"))
        assert dict(matplotlib.rcParams) == before


@pytest.mark.parametrize("name", PANELS)
def test_a_figure_of_panels_returns_them_and_leaves_the_settings(name):
    call, count = PANELS[name]
    before = dict(matplotlib.rcParams)
    own = call(None)
    assert own.shape == (count,)
    assert own[0].figure.get_size_inches()[0] == pytest.approx(figures.DOUBLE_COLUMN)
    given = plt.figure().subplots(1, count)
    assert list(call(given)) == list(given)
    assert dict(matplotlib.rcParams) == before
    rejected(ValueError, f"got 1 Axes; expected {count}", call, [given[0]])


def test_importing_polhode_does_not_import_matplotlib():
    code = "import sys, polhode; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def grey(color):
    return np.dot(to_rgb(color), [0.299, 0.587, 0.114])


@pytest.mark.parametrize(
    "looks", [list(style.REGIMES.values())[:3], style.SERIES], ids=["regimes", "series"]
)
def test_looks_differ_by_more_than_colour(looks):
    for a, b in itertools.combinations(looks, 2):
        assert a.color != b.color
        assert a.marker != b.marker
        wide = largest(a.linewidth, b.linewidth) / smallest(a.linewidth, b.linewidth)
        assert a.linestyle != b.linestyle or (
            wide > 1.5 and abs(grey(a.color) - grey(b.color)) > 0.2
        )


# Machado, Oliveira & Fernandes (2009), severity 1: linear RGB as a dichromat sees it.
DICHROMATS = {
    "protanopia": [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
    "deuteranopia": [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ],
}


def lab(rgb):
    """CIE L*a*b* of linear sRGB under D65."""
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    xyz = np.array(to_xyz) @ rgb / [0.9505, 1.0, 1.089]
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16.0 / 116.0)
    return np.array([116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])])


@pytest.mark.parametrize("eye", DICHROMATS)
def test_colours_are_told_apart_by_the_colour_blind(eye):
    for looks in (list(style.REGIMES.values())[:3], style.SERIES):
        seen = []
        for look in looks:
            c = np.array(to_rgb(look.color))
            linear = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
            seen.append(lab(np.clip(DICHROMATS[eye] @ linear, 0.0, 1.0)))
        for a, b in itertools.combinations(seen, 2):
            assert np.linalg.norm(a - b) > 15.0  # a difference of 2.3 is just noticed


def test_fills_of_planes_differ_in_grey():
    from polhode.figures.frames import FILLS

    levels = sorted(grey(color) for color in FILLS.values())
    assert np.diff(levels).min() > 0.04


def test_looks_go_round_and_are_found_by_regime():
    assert style.series(len(style.SERIES) + 1) == style.series(1)
    assert style.regime_look(polhode.free.Regime.long_axis) is style.regime_look("long_axis")
    with pytest.raises(ValueError, match="got 'sideways'; expected one of short_axis, long_axis"):
        style.regime_look("sideways")
    look = style.series(0)
    assert look.point["linestyle"] == "None"
    assert style.faded("#000000", 0.25) == (0.75, 0.75, 0.75)


def test_a_saved_figure_has_its_printed_size_and_repeats_to_the_byte(tmp_path):
    for suffix in (".png", ".pdf", ".svg"):
        first = figures.save(figures.phase_plane(BODY), tmp_path / f"a{suffix}")
        second = figures.save(figures.phase_plane(BODY), str(tmp_path / f"b{suffix}"))
        assert first.read_bytes() == second.read_bytes()
    with Image.open(tmp_path / "a.png") as picture:
        assert abs(picture.size[0] - 85 / 25.4 * 300) <= 1


def test_the_figure_of_axes_of_arrays_and_of_subfigures():
    figure = plt.figure()
    left, right = figure.subfigures(1, 2)
    axes = right.subplots(1, 2)
    assert style.figure_of(axes) is figure
    assert style.figure_of(axes[0]) is figure
    assert style.figure_of(figure) is figure
    rejected(TypeError, "expected Axes, an array of Axes or a Figure", style.figure_of, "axes")
    grid = style.panels(None, 2, 2, (3.0, 2.0))
    assert grid.shape == (2, 2)
    style.panel_label(axes[0], "(a)")
    assert axes[0].get_title(loc="left") == "(a)"


def test_settings_return_after_an_error():
    before = dict(matplotlib.rcParams)
    rejected(ValueError, "expected andoyer, euler or both", figures.frames_and_angles, STATE, "all")
    assert dict(matplotlib.rcParams) == before
    assert figures.frames_and_angles.__name__ == "frames_and_angles"
