# SPDX-License-Identifier: MIT
"""Films: frames, clock, the polhode under the tip of the momentum, and what cannot be filmed."""

import importlib
import shutil
from types import SimpleNamespace

import budgets
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pytest
from closeness import assert_allclose
from matplotlib.animation import FFMpegWriter
from numpy.testing import assert_array_equal
from PIL import Image
from polhode import (
    Body,
    FreeRotation,
    Problem,
    RotorState,
    Scenario,
    System,
    figures,
    integrate,
    rotor_state,
)
from polhode.figures.attitude import DEFAULT_VIEW, REACH
from polhode.figures.run_data import RunData

film = importlib.import_module("polhode.figures.animation")  # its function has the same name
BODY = Body(3.0, 5.0, 6.0)
MOTION = FreeRotation(BODY, rotor_state(BODY, [0.9, 0.3, 0.2, 0.1], [0.1, 0.9, 0.5]), 2.0)
RUN = integrate(Problem(System(BODY), MOTION.initial_state, 2.0, 9.0), np.linspace(2.0, 9.0, 29))


@pytest.mark.parametrize("shape", ["ellipsoid", "box"])
def test_a_film_has_a_frame_for_each_time(tmp_path, shape):
    before = dict(matplotlib.rcParams)
    path = tmp_path / f"{shape}.gif"
    times = MOTION.epoch + np.linspace(0.0, 2.0, 5)
    assert figures.animation(MOTION, path, times=times, fps=10, shape=shape) == path
    with Image.open(path) as picture:
        assert picture.n_frames == 5 and picture.size == (film.PIXELS, film.PIXELS)
        assert picture.info["duration"] == 100
        frames = []
        for k in range(5):
            picture.seek(k)
            frames.append(np.asarray(picture.convert("L")).astype(int))
    for one, next_one in zip(frames[:-1], frames[1:]):
        assert np.mean(one != next_one) > 0.01  # it moves
    assert list(tmp_path.iterdir()) == [path]
    assert plt.get_fignums() == [] and dict(matplotlib.rcParams) == before


def test_the_same_film_has_the_same_bytes(tmp_path):
    one, two = (
        figures.animation(MOTION, tmp_path / name, duration=0.3, fps=10)
        for name in ("a.gif", "b.gif")
    )
    assert one.read_bytes() == two.read_bytes()


def test_times_of_the_frames():
    free = film.frames_of(MOTION, None, None, 7)
    assert_allclose(free.t, 2.0 + np.linspace(0.0, 3.0 * MOTION.polhode_period, 7))
    assert_array_equal(free.states.q, MOTION.at(free.t).q)
    dense = film.frames_of(RUN, BODY, None, 7)
    assert_array_equal(dense.t, np.linspace(2.0, 9.0, 7))
    assert_array_equal(dense.states.q, RUN.at(dense.t).q)
    wanted = film.frames_of(RUN, BODY, [3.0, 3.5], 7)
    assert_array_equal(wanted.states.g, RUN.at([3.0, 3.5]).g)


def test_rows_without_dense_output_are_shown_as_they_are():
    rows = RunData(RUN.t, RUN.states, BODY, {"t": "s"}, "rows")
    few = film.frames_of(rows, None, None, 5)
    assert_array_equal(few.t, RUN.t[::7])
    assert_array_equal(few.states.q, RUN.q[::7])
    assert few.time_unit == "s" and few.title == "rows"
    assert_array_equal(film.frames_of(rows, None, [2.1, 2.9], 5).t, [2.0, 3.0])
    trail = film.trail_of(rows, few)
    g = few.states.g / np.linalg.norm(few.states.g, axis=-1, keepdims=True)
    assert_allclose(trail, np.repeat(g[:, None], film.BETWEEN, axis=1), atol=budgets.chart_rounding)


def test_results_are_filmed_in_their_own_units(tmp_path):
    scenario = Scenario.from_text("""
schema = 1
units = { time = "h", angle = "deg" }
body.moments = [3, 5, 6]
state.attitude-rate = { quaternion = [1, 0, 0, 0], omega_body = [10, 60, 20] }
time = { stop = 6, step = 0.5 }
output.columns = ["q", "g"]
""")
    results = scenario.run()
    frames = film.frames_of(results, scenario.body, None, 3)
    assert_array_equal(frames.t, [0.0, 3.0, 6.0])
    assert frames.time_unit == "h"
    path = figures.animation(results, tmp_path / "film.gif", scenario.body, duration=0.3, fps=10)
    with Image.open(path) as picture:
        assert picture.n_frames == 3


@pytest.mark.parametrize(
    ("g", "span"),
    [([0.0, 2.0, 0.0], 12 * np.pi / (2.0 / 3.0)), ([0.0, 0.0, 0.0], 1.0)],
    ids=["unstable", "rest"],
)
def test_a_motion_without_a_period_has_a_span(g, span):
    motion = FreeRotation(BODY, RotorState([1, 0, 0, 0], g))
    frames = film.frames_of(motion, None, None, 3)
    assert_allclose(frames.t, np.linspace(0.0, span, 3))
    assert np.all(np.isfinite(film.trail_of(motion, frames)))


def test_the_trail_goes_from_frame_to_frame_along_the_polhode():
    frames = film.frames_of(MOTION, None, None, 9)
    trail = film.trail_of(MOTION, frames)
    assert_allclose(trail[1:, 0], trail[:-1, -1], atol=budgets.chart_rounding)
    energy = np.sum(trail**2 / BODY.moments, axis=-1) / 2.0
    assert_allclose(energy, MOTION.energy / MOTION.momentum**2, rtol=budgets.free_invariants)


def test_the_momentum_stays_and_its_tip_is_on_the_polhode():
    frames = film.frames_of(MOTION, None, None, 9)
    ax = plt.figure().add_subplot()
    shown = film._Film(ax, frames, film.trail_of(MOTION, frames), "box", DEFAULT_VIEW)
    tip = None
    for k in range(9):
        shown.show(k, "h")
        now = np.asarray(shown.picture.momentum.head.xy)
        tip = now if tip is None else tip
        assert_allclose(now, tip, atol=budgets.round_trip_floor)
        lines = [line.get_xydata() for line in shown.traced]
        drawn = np.where(np.isfinite(lines[0]), *lines)
        assert len(drawn) == k * film.BETWEEN + 1
        assert_allclose(drawn[-1], tip, atol=budgets.round_trip_floor)
        assert shown.clock.get_text() == f"$t$ = {frames.t[k]:.1f} h"
    assert np.linalg.norm(tip) <= REACH
    plt.close("all")


def test_a_film_without_an_extent_has_a_clock():
    frames = film.frames_of(MOTION, None, [3.0, 3.0], 2)
    shown = film._Film(
        plt.figure().add_subplot(), frames, film.trail_of(MOTION, frames), "box", DEFAULT_VIEW
    )
    shown.show(1, "")
    assert shown.clock.get_text() == "$t$ = 3"
    plt.close("all")


def test_what_cannot_be_filmed(tmp_path, monkeypatch):
    with pytest.raises(ValueError, match=r"film\.avi; expected one that ends with \.gif or \.mp4"):
        figures.animation(MOTION, tmp_path / "film.avi")
    with pytest.raises(TypeError, match=r"got Trajectory without a body; expected body=Body"):
        figures.animation(RUN, tmp_path / "film.gif")
    for name in ("fps", "duration"):
        for number, error in ((0, ValueError), (-1, ValueError), ("fast", TypeError)):
            words = f"animation: got {name} = {number!r}; expected a positive, finite number"
            with pytest.raises(error, match=words):
                figures.animation(MOTION, tmp_path / "film.gif", **{name: number})
    monkeypatch.setattr(film.FFMpegWriter, "isAvailable", lambda: False)
    with pytest.raises(RuntimeError, match=r"film\.mp4 needs the program ffmpeg, .* write a \.gif"):
        figures.animation(MOTION, tmp_path / "film.mp4")
    assert list(tmp_path.iterdir()) == []


def test_a_film_that_fails_leaves_nothing(tmp_path):
    times = np.linspace(0.0, 1.0, 4)
    broken = SimpleNamespace(t=times, states=MOTION.at(times)[:, None], body=BODY)
    with pytest.raises(ValueError, match="expected one row of each"):
        figures.animation(broken, tmp_path / "film.gif")
    with pytest.raises(ValueError, match="got shape = 'cone'; expected one of ellipsoid, box"):
        figures.animation(MOTION, tmp_path / "film.gif", shape="cone", duration=0.2, fps=10)
    assert list(tmp_path.iterdir()) == [] and plt.get_fignums() == []


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="needs ffmpeg")
def test_ffmpeg_writes_an_mp4(tmp_path):
    path = figures.animation(MOTION, tmp_path / "film.mp4", duration=0.5, fps=10)
    assert path.read_bytes()[4:8] == b"ftyp"


def test_an_mp4_is_left_to_ffmpeg(tmp_path, monkeypatch):
    monkeypatch.setattr(FFMpegWriter, "isAvailable", lambda: True)
    writer = film._writer(tmp_path / "film.mp4", 12)
    assert isinstance(writer, FFMpegWriter) and writer.fps == 12
    assert film.PIXELS % 2 == 0 and "yuv420p" in writer.extra_args
