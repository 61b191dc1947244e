# SPDX-License-Identifier: MIT
"""Light curves of several sessions that join one by one."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from polhode import _core
from polhode._core import _number
from polhode._observed import loss_of, one_of, whole
from polhode.light_fits import (
    MOMENTS,
    BrightEllipsoid,
    FoundLight,
    LightCurve,
    curve_parts,
    found_light,
    listed,
)

if TYPE_CHECKING:
    from polhode._observed import Loss


@dataclass(frozen=True)
class JoinedSession:
    """What a session came to when it joined those before it.

    Attributes
    ----------
    session : its place among the curves.
    distance : of its middle from that of those before it; 0 of the first.
    counts : fits that were begun, one for each count of turns and solution; for the first session,
        one for each start.
    converged : of them. solutions : within the limit, of all sessions so far. cost : of the lowest.
    """

    session: int
    distance: float
    counts: int
    converged: int
    solutions: int
    cost: float


@dataclass(frozen=True, eq=False)
class LightExtensionResult:
    """What extend_light found.

    Attributes
    ----------
    solutions : FoundLight of all sessions, by what was minimised; all converged.
    joined : JoinedSession in the order in which they joined.
    failure : why there are no solutions; else empty. notes : what to know of it.
    """

    solutions: list[FoundLight]
    joined: list[JoinedSession]
    failure: str
    notes: tuple[str, ...]

    def __repr__(self) -> str:
        counted = f"{len(self.solutions)} solutions of {len(self.joined)} sessions"
        said = f": {self.failure}" if self.failure else ""
        return listed(f"<LightExtensionResult: {counted}{said}", self.solutions)


def extend_light(
    curves: Iterable[LightCurve],
    starts: BrightEllipsoid | Iterable[BrightEllipsoid],
    *,
    first: int = 0,
    within: float = 1.5,
    threads: int = 1,
    shape: bool = True,
    moments: str = "shape",
    multiple: bool = False,
    loss: Loss = "squared",
    most_counts: int = 5000,
    most_iterations: int = 200,
) -> LightExtensionResult:
    """Solutions of one session of light curves, to all sessions, which join one by one.

    Each solution is fitted with every count of turns until the next session that three of its
    errors leave; what is within the limit goes on to the session after it.

    Parameters
    ----------
    curves : LightCurve, the sessions, with vectors.
    starts : BrightEllipsoid, one or several, near what the session `first` has: bodies of the
        solutions of search_light.
    first : the place of that session.
    within : chi-square, or the sum under a robust loss, over the lowest, up to which solutions go
        on and are reported.
    threads : the bits of the result do not depend on it.
    shape, moments, multiple, loss : as in fit_light.
    most_counts : of turns, for one solution and session; where there are more, `failure` says so.
    most_iterations : of each fit; near the limit it may go on for five times as many.

    Returns
    -------
    LightExtensionResult

    DomainError (a ValueError) as fit_light, and without starts. A fit for each count of turns and
    solution, some milliseconds for each 100 points. Ctrl-C ends it between two fits. Releases the
    GIL.
    """
    bodies = [starts] if isinstance(starts, BrightEllipsoid) else list(starts)
    for body in bodies:
        if not isinstance(body, BrightEllipsoid):
            raise TypeError(f"extend_light: starts: got {body!r}; expected BrightEllipsoid")
    found = _core._extend_light(
        curve_parts(curves), [body._parts() for body in bodies], whole(first, "first", 0),
        float(_number(within, "within")), bool(shape), one_of(moments, "moments", MOMENTS),
        bool(multiple), *loss_of(loss), whole(most_counts, "most_counts"),
        whole(most_iterations, "most_iterations"), whole(threads, "threads"),
    )  # fmt: skip
    return LightExtensionResult(
        [found_light(one) for one in found["solutions"]],
        [JoinedSession(*one) for one in found["joined"]], found["failure"], found["notes"],
    )  # fmt: skip
