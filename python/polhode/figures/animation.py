# SPDX-License-Identifier: MIT
"""A film of a rotating body: its axes, the momentum that stays, the polhode sliding under it."""

from __future__ import annotations

import math
import os
import pathlib
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.animation import AbstractMovieWriter, FFMpegWriter, PillowWriter
from matplotlib.axes import Axes
from numpy.typing import ArrayLike, NDArray

from polhode import Body, FreeRotation, RotorState
from polhode._arguments import require_positive
from polhode._core import _numbers
from polhode.charts import attitude_matrix
from polhode.figures import style
from polhode.figures.attitude import DEFAULT_VIEW, REACH, BodyPicture
from polhode.figures.run_data import RunData, run_data
from polhode.figures.view import View, parts

PIXELS = 384
"""Width and height of the film; even, as MP4 wants it."""
DPI = 128
BETWEEN = 12
"""Points of the polhode drawn from one frame to the next."""
TRACE = style.Look(style.GREEN, "-", 1.8)


@style.styled
def animation(
    motion: Any,
    path: str | os.PathLike[str],
    body: Body | None = None,
    *,
    times: ArrayLike | None = None,
    duration: float = 8.0,
    fps: int = 20,
    shape: str = "ellipsoid",
    view: View = DEFAULT_VIEW,
    unit: str = "",
) -> pathlib.Path:
    """Writes a film of a rotating body, .gif or .mp4 by the name of `path`, and returns its path.

    Shown are the body with its axes b1, b2, b3, the directions of the momentum G and of the angular
    velocity, and the polhode: the path of the momentum in the body, which the tip of G traces.

    Parameters
    ----------
    motion : a FreeRotation, a Trajectory, Results, or RunData(t, states, body).
    path : the file. A .gif needs nothing else; an .mp4 needs the program ffmpeg.
    body : of a source that does not hold one (a Trajectory).
    times : of the frames; None: evenly over the run, of a FreeRotation over three polhode periods.
    duration, fps : seconds of film, and frames a second. With `times`, a frame for each.
    shape : "ellipsoid" or "box" of the body's moments. view : from where.
    unit : of time, for the clock.

    RuntimeError for an .mp4 where there is no ffmpeg; ValueError for any other kind of file, and
    unless duration and fps are positive. A film that fails leaves nothing behind."""
    path = pathlib.Path(path)
    require_positive("animation", "duration", duration)
    require_positive("animation", "fps", fps)
    count = max(2, round(duration * fps))
    writer = _writer(path, fps)
    run = frames_of(motion, body, times, count)
    trail = trail_of(motion, run)
    figure = style.new_figure(PIXELS / DPI, PIXELS / DPI)
    # The Axes are the figure: there is nothing to lay out anew in each frame.
    figure.set_layout_engine("none")
    partial = path.with_name(f"{path.stem}.part{path.suffix}")
    try:
        film = _Film(
            style.plane_axes(figure.add_axes((0.0, 0.0, 1.0, 1.0))), run, trail, shape, view
        )
        with writer.saving(figure, str(partial), dpi=DPI):
            for k in range(run.t.size):
                film.show(k, unit or run.time_unit)
                writer.grab_frame()
        os.replace(partial, path)
    finally:
        plt.close(figure)
        partial.unlink(missing_ok=True)
    return path


def _writer(path: pathlib.Path, fps: int) -> AbstractMovieWriter:
    kind = path.suffix.lower()
    if kind == ".gif":
        return PillowWriter(fps=fps)
    if kind != ".mp4":
        raise ValueError(
            f"animation: got the path {path}; expected one that ends with .gif or .mp4"
        )
    if not FFMpegWriter.isAvailable():
        raise RuntimeError(
            f"animation: {path} needs the program ffmpeg, which is not on the PATH; "
            "install it, or write a .gif"
        )
    return FFMpegWriter(fps=fps, metadata={}, extra_args=["-pix_fmt", "yuv420p"])


def frames_of(motion: Any, body: Body | None, times: ArrayLike | None, count: int) -> RunData:
    """The times and states of the frames."""
    if isinstance(motion, FreeRotation):
        if times is None:
            times = motion.epoch + np.linspace(0.0, _span(motion), count)
        return RunData(times, motion.at(times), motion.body)
    if times is None and getattr(motion, "has_dense", False):
        times = np.linspace(motion.start, motion.stop, count)
    if times is not None and hasattr(motion, "at"):
        return RunData(times, motion.at(times), _body_of(motion, body))
    run = run_data(motion, body)
    wanted = np.linspace(run.t[0], run.t[-1], count) if times is None else _numbers(times, "times")
    # Rows are shown as they are: between them nothing is known.
    nearest = np.array([int(np.argmin(np.abs(run.t - t))) for t in wanted])
    return RunData(run.t[nearest], run.states[nearest], run.body, run.units, run.title)


def _body_of(motion: Any, body: Body | None) -> Body:
    body = body or getattr(motion, "body", None)
    if body is None:
        raise TypeError(
            f"animation: got {type(motion).__name__} without a body; expected body=Body(...)"
        )
    return body


def _span(motion: FreeRotation) -> float:
    """Three polhode periods; where the momentum does not return, six turns of the fastest axis."""
    if np.isfinite(motion.polhode_period) and motion.polhode_period > 0.0:
        return 3.0 * motion.polhode_period
    rate = motion.momentum / float(np.min(motion.body.moments))
    return 12.0 * np.pi / rate if rate > 0.0 else 1.0


def trail_of(motion: Any, run: RunData) -> NDArray[np.float64]:
    """Directions (frames, BETWEEN, 3) of the momentum in the body, from each frame to the next."""
    at = getattr(motion, "at", None)
    if at is None or not getattr(motion, "has_dense", True):
        g = np.repeat(np.asarray(run.states.g)[:, None, :], BETWEEN, axis=1)
    else:
        last = np.append(run.t[1:], run.t[-1])
        part = np.linspace(0.0, 1.0, BETWEEN)
        g = np.asarray(at(run.t[:, None] * (1.0 - part) + last[:, None] * part).g)
    size = np.linalg.norm(g, axis=-1, keepdims=True)
    return np.divide(g, size, out=np.zeros_like(g), where=size > 0.0)


class _Film:
    """What moves from frame to frame."""

    def __init__(
        self, ax: Axes, run: RunData, trail: NDArray[np.float64], shape: str, view: View
    ) -> None:
        self.run, self.trail, self.view = run, trail, view
        self.picture = BodyPicture(ax, run.body, shape, view)
        # of each the seen and the hidden part, thin ahead and thick behind
        thin = {**TRACE.line, "linewidth": 0.6}
        self.ahead = [
            ax.plot([], [], **thin, alpha=a, zorder=z)[0] for a, z in ((0.7, 2.2), (0.25, 0.4))
        ]
        self.traced = [
            ax.plot([], [], **TRACE.line, alpha=a, zorder=z)[0]
            for a, z in ((1.0, 2.5), (0.35, 0.5))
        ]
        self.clock = ax.text(0.03, 0.97, "", transform=ax.transAxes, va="top", fontsize=9.0)

    def show(self, k: int, unit: str) -> None:
        state: RotorState = self.run.states[k]
        self.picture.show(state)
        rows = attitude_matrix(state.q)
        whole = self.trail.reshape(-1, 3)
        for lines, directions in ((self.ahead, whole), (self.traced, whole[: k * BETWEEN + 1])):
            points = REACH * directions @ rows
            near, far = parts(self.view.paper(points), self.picture.solid.hides(rows, points))
            lines[0].set_data(*near.T)
            lines[1].set_data(*far.T)
        span = float(np.ptp(self.run.t))
        decimals = max(0, 3 - math.ceil(math.log10(span))) if span > 0.0 else 0
        self.clock.set_text(f"$t$ = {self.run.t[k]:.{decimals}f} {unit}".rstrip())
