# SPDX-License-Identifier: MIT
"""Attitudes of a run as SPICE C-kernels; needs spiceypy (`pip install polhode[spice]`)."""

from __future__ import annotations

import os
import pathlib
import warnings
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

import polhode

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Kernels", "ephemeris_time", "write_ck", "write_ck_rows"]

_TICKS = 1_000_000  # of the clock, per second
_COUNTS = 4_294_967_296  # s until the clock ends: 136 years
_REFERENCES = {"equator-J2000": "J2000", "ecliptic-J2000": "ECLIPJ2000"}
_SCALES = ("TT", "TAI")
_TT_TAI = 32.184  # s
_LIMIT = 0.01  # deg of interpolation, without a warning
# DELTET of naif0012.tls: K, EB, M
_K, _EB, _M0, _M1 = 1.657e-3, 1.671e-2, 6.239996, 1.99096871e-7


class Kernels(NamedTuple):
    """The files that belong together: furnish all three."""

    ck: str
    sclk: str
    fk: str


def write_ck(
    results: polhode.Results,
    path: str | os.PathLike[str],
    *,
    structure: int = -999000,
    frame: str = "POLHODE_BODY",
    reference: str | None = None,
) -> Kernels:
    """The attitudes and angular velocities of a run as a CK of type 3, with its clock and frame.

    PATH.bc is written as PATH.bc.part and renamed when it is complete; next to it PATH.tsc, a clock
    of a microsecond per tick that runs with TDB, and PATH.tf, which names the frame.

    Between the rows SPICE rotates about a fixed axis at a fixed rate, the shorter way. A
    UserWarning tells the error of this in the middle between rows if it is more than 0.01 degrees;
    it is 180 degrees if the body makes half a revolution or more between two rows.

    Parameters
    ----------
    results : with the columns q (q_inertial in a moving frame) and omega, and an epoch.
    path : ends with .bc.
    structure : the id of the CK, negative; the clock is structure // 1000.
    frame : the name of the body axes.
    reference : the SPICE frame of the state's axes; left out, J2000 or ECLIPJ2000.

    Leap seconds are those of ERFA's list; where the caller has furnished a leap-second kernel, its
    own. A UserWarning for a UTC epoch beyond the list. ValueError for what is missing; what else
    SPICE refuses is its own error.
    """
    scenario = results.scenario
    if scenario.axes not in _REFERENCES and reference is None:
        raise ValueError(
            f"write_ck: axes are {scenario.axes!r}; expected reference, the SPICE frame they are"
        )
    groups = results.groups
    attitude = "q" if scenario.system.frame.is_inertial else "q_inertial"
    for needed in (attitude, "omega"):
        if needed not in groups:
            raise ValueError(f"write_ck: the results have no columns {needed!r}: with_columns")
    seconds = polhode.Units("s").to_core(1.0, "time", results.units["t"])
    rate = polhode.Units("s").to_core(1.0, "rate", results.units["w1"])
    return write_ck_rows(
        ephemeris_time(scenario.epoch, seconds * results.t), groups[attitude],
        rate * groups["omega"], path, structure=structure, frame=frame,
        reference=reference or _REFERENCES[scenario.axes],
        comments=[f"polhode {polhode.__version__}", scenario.title,
                  f"scenario: {scenario.name}", *scenario.text.splitlines()],
    )


def ephemeris_time(epoch: str, seconds: ArrayLike) -> Any:
    """Seconds past J2000 (TDB), as SPICE counts time, of `seconds` after an epoch of a scenario.

    epoch : such as "2026-05-01T00:00:00 UTC" or "2026-05-01T00:00:00Z", in UTC, TAI, TT or TDB.
    seconds : of any shape; of the scale of the epoch, UTC counts those of TT.

    With a leap-second kernel that the caller has furnished (spiceypy.furnsh) the answer is that of
    SPICE; without one leap seconds are those of ERFA, and TDB - TT is the formula that SPICE's
    kernels have. A UserWarning for a UTC epoch whose leap seconds ERFA's list does not know yet.
    """
    if epoch.endswith("Z") and not epoch.startswith("JD "):
        epoch = epoch[:-1] + " UTC"
    date, _, scale = epoch.rpartition(" ")
    if scale in (*_SCALES, "UTC", "TDB"):
        polhode.ephemeris.Date(epoch)  # refuses what is no date
    after = polhode._core._numbers(seconds, "seconds")
    if scale == "TDB":
        return _past_J2000(date) + after
    if scale == "UTC":
        start = _utc_in_tt(epoch)
        scale = "TT"
    elif scale in _SCALES:
        start = _past_J2000(date)
    else:
        raise ValueError(f"got the epoch {epoch!r}; expected one in UTC, TAI, TT or TDB")
    tt = start + after + (_TT_TAI if scale == "TAI" else 0.0)
    if not _has_leap_seconds():
        return tt + _tdb_tt(tt)
    import spiceypy

    return np.array([spiceypy.unitim(x, "TDT", "ET") for x in tt.ravel()]).reshape(tt.shape)


def _has_leap_seconds() -> bool:
    """Whether the caller has furnished a leap-second kernel."""
    import spiceypy

    return bool(spiceypy.expool("DELTET/DELTA_AT"))


def _utc_in_tt(epoch: str) -> float:
    """Seconds of TT past J2000 (12:00 TT) of a date in UTC."""
    utc = polhode.ephemeris.Date(epoch)
    if _has_leap_seconds():
        import spiceypy

        year, month, day, hour, minute, second = utc.calendar
        date = f"{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:012.9f}"
        return float(spiceypy.unitim(spiceypy.str2et(date), "ET", "TDT"))
    if utc.is_dubious:
        warnings.warn(
            f"the epoch {epoch!r} is beyond the leap seconds that are known here; a leap-second "
            "kernel that you furnish is taken instead",
            UserWarning,
            stacklevel=4,
        )
    return polhode.ephemeris.seconds_between(polhode.ephemeris.Date("TT", 2451545.0), utc)


def _tdb_tt(tt: Any) -> Any:
    """TDB - TT in s, as the kernels naif00XX.tls have it: K sin(M + EB sin M), of the time past
    J2000 in TDB; that of TT will do for it, to 1e-11 s."""
    anomaly = _M0 + _M1 * tt
    return _K * np.sin(anomaly + _EB * np.sin(anomaly))


def write_ck_rows(
    et: ArrayLike,
    q: ArrayLike,
    omega: ArrayLike,
    path: str | os.PathLike[str],
    *,
    structure: int,
    frame: str,
    reference: str,
    comments: list[str] | None = None,
) -> Kernels:
    """The same for rows from anywhere.

    Parameters
    ----------
    et : (N,), rising; s past J2000 in TDB.
    q : (N, 4), scalar first: body axes to `reference`.
    omega : (N, 3), rad/s relative to `reference`, along the body axes.
    """
    import spiceypy

    ck = pathlib.Path(os.fspath(path))
    if ck.suffix != ".bc":
        raise ValueError(f"write_ck: got {str(ck)!r}; expected a path that ends with .bc")
    if not structure < -999:
        raise ValueError(f"write_ck: structure: got {structure}; expected an id below -999")
    given = (("et", et), ("q", q), ("omega", omega))
    times, quaternions, rates = (polhode._core._numbers(x, name).copy() for name, x in given)
    n = len(times)
    if quaternions.shape != (n, 4) or rates.shape != (n, 3) or n == 0:
        raise ValueError("write_ck: expected et (N,), q (N, 4) and omega (N, 3), N > 0")
    if not (np.diff(times) > 0).all():
        raise ValueError("write_ck: the times of a CK rise from row to row")
    quaternions /= np.linalg.norm(quaternions, axis=1)[:, None]
    error = np.degrees(_interpolation_error(times, quaternions, rates))
    if error > _LIMIT:
        warnings.warn(
            f"{ck}: between rows SPICE's interpolation is off by about {error:.2g} deg; expected a "
            "shorter step between them",
            UserWarning,
            stacklevel=3 if comments else 2,
        )
    start = float(np.floor(times[0]))
    ticks = (times - start) * _TICKS
    # C-matrix of SPICE: components along `reference` to those along the body axes
    matrices = quaternions * [1.0, -1.0, -1.0, -1.0]
    rates = _turned(quaternions, rates)
    clock = structure // 1000 if structure % 1000 == 0 else -(-structure // 1000)
    kernels = Kernels(str(ck), str(ck.with_suffix(".tsc")), str(ck.with_suffix(".tf")))
    _write_text(kernels.sclk, _clock_text(-clock, start))
    _write_text(kernels.fk, _frame_text(frame, structure, clock))
    part = str(ck) + ".part"
    pathlib.Path(part).unlink(missing_ok=True)
    handle = spiceypy.ckopn(part, "polhode", 0)
    try:
        spiceypy.ckw03(
            handle, ticks[0], ticks[-1], structure, reference, True, "polhode", n, ticks,
            matrices, rates, 1, ticks[:1],
        )
        # lines of a comment area have at most 1000 printable ASCII characters
        lines = [line.encode("ascii", "replace").decode()[:900] for line in comments or []]
        spiceypy.dafac(handle, [line if line.strip() else " " for line in lines or [" "]])
    finally:
        spiceypy.ckcls(handle)
    os.replace(part, kernels.ck)
    return kernels


def _interpolation_error(times: Any, q: Any, omega: Any) -> float:
    """The largest angle, in rad, between the attitude in the middle of two rows as SPICE has it,
    which takes the shorter way between them at a fixed rate, and as the angular velocities at both
    ends have it, each on from its row. If the body makes half a revolution or more between two
    rows, the shorter way is not its way, and the error is half a revolution."""
    if len(times) < 2:
        return 0.0
    step, before, after = np.diff(times)[:, None], omega[:-1], omega[1:]
    speed = np.linalg.norm(omega, axis=1)
    turn = (step[:, 0] * np.maximum(speed[:-1], speed[1:])).max()
    if turn >= np.pi * (1.0 - 1e-9):  # for the rounding of the rates
        return float(np.pi)
    left = _product(q[:-1], _rotation(step * (0.375 * before + 0.125 * after)))
    right = _product(q[1:], _rotation(-step * (0.375 * after + 0.125 * before)))
    middle = left + np.where((left * right).sum(1) < 0, -1.0, 1.0)[:, None] * right
    linear = q[:-1] + np.where((q[:-1] * q[1:]).sum(1) < 0, -1.0, 1.0)[:, None] * q[1:]
    away = _product(middle * [1.0, -1.0, -1.0, -1.0], linear)
    return float((2 * np.arctan2(np.linalg.norm(away[:, 1:], axis=1), np.abs(away[:, 0]))).max())


def _rotation(v: Any) -> Any:
    """Quaternions of rotation vectors."""
    half = 0.5 * np.linalg.norm(v, axis=1)[:, None]
    return np.hstack([np.cos(half), 0.5 * np.sinc(half / np.pi) * v])


def _product(p: Any, q: Any) -> Any:
    w = p[:, :1] * q[:, :1] - (p[:, 1:] * q[:, 1:]).sum(1)[:, None]
    return np.hstack([w, p[:, :1] * q[:, 1:] + q[:, :1] * p[:, 1:] + np.cross(p[:, 1:], q[:, 1:])])


def _past_J2000(date: str) -> float:
    """Seconds from J2000 of a date in a scale with days of 86400 s."""
    if date.startswith("JD "):
        return (float(date[3:]) - 2451545.0) * 86400.0
    whole, _, fraction = date.replace(" ", "T").partition(".")
    days = np.datetime64(whole, "s") - np.datetime64("2000-01-01T12:00:00", "s")
    return float(days.astype(np.int64)) + (float("0." + fraction) if fraction else 0.0)


def _turned(q: Any, v: Any) -> Any:
    """q v q* of rows."""
    w, u = q[:, :1], q[:, 1:]
    t = 2.0 * np.cross(u, v)
    return v + w * t + np.cross(u, t)


def _write_text(path: str, text: str) -> None:
    part = path + ".part"
    pathlib.Path(part).write_text(text, encoding="ascii")
    os.replace(part, path)


def _clock_text(clock: int, start: float) -> str:
    return f"""KPL/SCLK

The clock of a CK written by polhode: {_TICKS} ticks per second of TDB, from {start!r} s past J2000.

\\begindata

SCLK_KERNEL_ID             = ( @2000-01-01 )
SCLK_DATA_TYPE_{clock}        = ( 1 )
SCLK01_TIME_SYSTEM_{clock}    = ( 1 )
SCLK01_N_FIELDS_{clock}       = ( 2 )
SCLK01_MODULI_{clock}         = ( {_COUNTS} {_TICKS} )
SCLK01_OFFSETS_{clock}        = ( 0 0 )
SCLK01_OUTPUT_DELIM_{clock}   = ( 1 )
SCLK_PARTITION_START_{clock}  = ( 0.0 )
SCLK_PARTITION_END_{clock}    = ( {float(_COUNTS * _TICKS)!r} )
SCLK01_COEFFICIENTS_{clock}   = ( 0.0 {start!r} 1.0 )

\\begintext
"""


def _frame_text(frame: str, structure: int, clock: int) -> str:
    return f"""KPL/FK

The body axes of a CK written by polhode.

\\begindata

FRAME_{frame} = {structure}
FRAME_{structure}_NAME = '{frame}'
FRAME_{structure}_CLASS = 3
FRAME_{structure}_CLASS_ID = {structure}
FRAME_{structure}_CENTER = {clock}
CK_{structure}_SCLK = {clock}
CK_{structure}_SPK = {clock}

\\begintext
"""
