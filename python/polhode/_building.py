# SPDX-License-Identifier: MIT
"""From the objects of a run to the nested dict of a scenario file. Numbers keep their bits: angles
and rates are written in radians, whatever unit outputs have."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from polhode import _core
from polhode._building_terms import tables_of

_TO_HUB = ("EulerRates",)  # what needs the body


def data_of(
    system: Any,
    state: Any,
    time: Any,
    method: Any,
    columns: Sequence[str],
    *,
    title: str,
    units: Any,
    events: Sequence[Mapping[str, Any]],
    epoch: str,
    axes: str,
    damper_rate: Any,
    orbits: Mapping[str, Any],
) -> dict[str, Any]:
    """ValueError for what has no place in a scenario file, naming it."""
    if isinstance(system, _core.Body):
        system = _core.System(system)
    if not isinstance(system, _core.System):
        raise TypeError(f"build: system: got {system!r}; expected a System or a Body")
    write = _Writer(units)
    data: dict[str, Any] = {"schema": 1}
    if title:
        data["title"] = title
    data["units"] = {
        "time": units.time, "angle": units.angle, "moment": units.moment, "length": units.length
    }
    data["body"] = _body(system.body)
    dated = {"epoch": epoch} if epoch else {}
    data["state"] = {**dated, "axes": axes, **write.state(state, system.body, axes)}
    data.update(write.frame(system.frame))
    data.update(tables_of(system, axes, orbits, write.angle, write.rate))
    if damper := write.damper(system.damper, damper_rate):
        data.setdefault("perturbation", []).append(damper)
    if method is not None:
        data["method"] = _method(method)
    for event in events:
        if not isinstance(event, Mapping):
            raise TypeError(
                f"build: events: got {event!r}; expected dicts like {{\"column\": \"theta\"}}"
            )
    if events:
        data["event"] = [dict(event) for event in events]
    if time is not None:
        data["time"] = _time(time)
    data["output"] = {"columns": list(columns)}
    return data


def _body(body: Any) -> dict[str, Any]:
    turn = body.q_FB.tolist()
    own = {} if turn == [1.0, 0.0, 0.0, 0.0] else {"column_axes": turn}
    return {"moments": body.moments.tolist(), **own}


class _Writer:
    """What depends on the units of the file."""

    def __init__(self, units: Any) -> None:
        self._angle = "" if units.angle == "rad" else "rad"
        self._rate = f"rad/{units.time}" if self._angle else ""

    def angle(self, value: Any) -> Any:
        return {"value": value, "unit": self._angle} if self._angle else value

    def rate(self, value: Any) -> Any:
        return {"value": value, "unit": self._rate} if self._rate else value

    def state(self, state: Any, body: Any, axes: str) -> dict[str, Any]:
        if isinstance(state, _core.FreeRotation):
            state = state.initial_state if state.epoch == 0.0 else state.at(0.0)
        kind = type(state).__name__
        if getattr(state, "shape", None) != () or not hasattr(_core, kind):
            raise TypeError(f"build: state: got {state!r}; expected one state of any chart")
        if kind == "TumblerState":
            return {"tumbler": self._tumbler(state, axes)}
        for name, kept_by, fields, numbers, options in _core._state_charts():
            if kept_by == kind and all(getattr(state, f).name == w for f, w in fields.items()):
                return {name: self._chart(state, numbers, options)}
        hub = state if kind == "RotorState" else _to_hub(state, body, kind)
        return {
            "attitude-rate": {"quaternion": hub.q.tolist(), "momentum_body": hub.g.tolist()}
        }

    def _chart(self, state: Any, numbers: Any, options: Any) -> dict[str, Any]:
        data = {}
        for name, is_angle in numbers:
            data[name] = self.angle(getattr(state, name)) if is_angle else getattr(state, name)
        for name, words in options:
            value = getattr(state, name)
            data[name] = words[value.value] if hasattr(value, "value") else value
        return data

    def _tumbler(self, state: Any, axes: str) -> dict[str, Any]:
        x, y, z = state.pole.tolist()
        longitude = self.angle(math.atan2(y, x))
        latitude = self.angle(math.atan2(z, math.hypot(x, y)))
        # longitude is ecliptic wherever axes say what they are
        names = ("ra", "dec") if axes == "equator-J2000" else ("longitude", "latitude")
        return {
            "precession_period": state.precession_period,
            "rotation_period": state.rotation_period,
            "pole": dict(zip(names, (longitude, latitude))),
            "mode": "SAM" if state.mode == _core.Regime.short_axis else "LAM",
            "phi0": self.angle(state.phi0),
            "psi0": self.angle(state.psi0),
            "branch": state.branch,
            "sense": state.sense,
        }

    def frame(self, frame: Any) -> dict[str, Any]:
        if frame.is_inertial or frame.kind in ("local_vertical", "plane_of"):
            return {}  # its orbit has a table: tables_of
        if frame.kind != "precessing":
            raise ValueError(
                f"build: frame {frame!r} has no place in a scenario; expected Frame.inertial(), "
                "Frame.precessing, Frame.plane_of or Frame.local_vertical"
            )
        given = frame.arguments
        return {"frame": {"precessing": {
            "axis": list(given["axis"]),
            "rate": self.rate(given["rate"]),
            "epoch": given["epoch"],
        }}}

    def damper(self, damper: Any, damper_rate: Any) -> dict[str, Any]:
        rate = _core._numbers(damper_rate, "damper_rate")
        if rate.shape != (3,):
            raise ValueError(f"build: damper_rate: got shape {rate.shape}; expected (3,)")
        if damper is None:
            if rate.any():
                raise ValueError(
                    f"build: damper_rate: got {damper_rate!r}; the system has no damper"
                )
            return {}
        return {
            "kind": "kane-damper",
            "sphere_moment": damper.moment,
            "friction": damper.friction,
            "rate_relative": self.rate(rate.tolist()),
        }


def _to_hub(state: Any, body: Any, kind: str) -> Any:
    return _core.to_rotor(body, state) if kind in _TO_HUB else _core.to_rotor(state)


def _method(method: Any) -> dict[str, Any]:
    try:
        kind, keys = _core._method_table(method)
    except TypeError:
        raise TypeError(
            f"build: method: got {method!r}; expected Adaptive, Collocation, Splitting, "
            "VariationOfConstants or None"
        ) from None
    # what stands for "chosen" has no place in a file
    given = {key: value for key in keys if (value := getattr(method, key)) not in (0.0, math.inf)}
    again = type(method)(**given)
    for name in (name for name in dir(method) if not name.startswith("_")):
        if getattr(again, name) != getattr(method, name):
            raise ValueError(
                f"build: method: {name} {getattr(method, name)!r} has no place in a scenario; "
                f"expected {getattr(again, name)!r}"
            )
    return {"kind": kind, **{key: _word(value) for key, value in given.items()}}


def _word(value: Any) -> Any:
    """The word of an enumerator in files; all else as it is."""
    name = getattr(value, "name", None)
    return value if name is None else name.replace("_", "-")


def _time(time: Any) -> dict[str, Any]:
    if isinstance(time, tuple) and len(time) == 3:
        try:
            start, stop, step = (_core._number(x, "time") for x in time)
        except TypeError:
            raise TypeError(
                f"build: time: got {time!r}; expected numbers (start, stop, step)"
            ) from None
        return {"start": start, "stop": stop, "step": step}
    if not isinstance(time, _core.SaveAt):
        time = _core.SaveAt.times(time)
    parts = _core._save_at_parts(time)
    if parts is None:
        return {"at": [time[k] for k in range(len(time))]}
    start, stop, step = parts
    if step is None:
        return {"start": start, "stop": stop, "count": len(time)}
    return {"start": start, "stop": stop, "step": step}
