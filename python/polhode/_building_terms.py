# SPDX-License-Identifier: MIT
"""From orbits, terms and the surface that they act on to the tables of a scenario file."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from polhode import _core

_ORBITS = ("KeplerOrbit", "PrecessingKeplerOrbit", "TurnedKeplerOrbit", "TableOrbit")


def tables_of(
    system: Any,
    axes: str,
    names: Mapping[str, Any],
    angle: Callable[[Any], Any],
    rate: Callable[[Any], Any],
) -> dict[str, Any]:
    """The tables orbit, surface and perturbation of a System whose state is along `axes`; `names`
    are of orbits, `angle` and `rate` write a number in radians. ValueError for what has no place in
    a file, naming it."""
    tables = _Tables(axes, _checked(names), angle, rate)
    for term in system.terms:
        tables.add(term)
    data: dict[str, Any] = {}
    if system.frame.kind == "local_vertical":
        orbit = tables.name_of(system.frame.arguments["orbit"])
        data["frame"] = {"local-vertical": {"orbit": orbit}}
    if system.frame.kind == "plane_of":
        given = system.frame.arguments
        plane = {"orbit": tables.name_of(given["orbit"]), "axis_1": given["axis_1"]}
        data["frame"] = {"orbit-plane": plane}
    if tables.orbits:
        data["orbit"] = {name: tables.orbit(orbit) for name, orbit in tables.orbits.items()}
    if tables.surface is not None:
        data["surface"] = [_facet(row) for row in tables.surface.rows.tolist()]
    if tables.terms:
        data["perturbation"] = tables.terms
    return data


class _Tables:
    def __init__(
        self,
        axes: str,
        names: Mapping[str, Any],
        angle: Callable[[Any], Any],
        rate: Callable[[Any], Any],
    ) -> None:
        self.orbits: dict[str, Any] = {}
        self._names = names
        self.surface: Any = None
        self.terms: list[dict[str, Any]] = []
        self._axes = axes
        self._angle = angle
        self._rate = rate

    def add(self, term: Any) -> None:
        if term.kind is None:
            raise ValueError(
                f"build: term \"{term.name}\" ({type(term).__name__}) has no place in a scenario; "
                "expected one of the terms that are not functions in Python"
            )
        if (field := term.arguments.get("field")) is not None:
            raise ValueError(
                f"build: term \"{term.name}\": its field {field!r} has no place in a scenario; "
                "expected a DipoleField or three numbers"
            )
        if (surface := term.arguments.get("surface")) is not None:
            self._act_on(term, surface)
        write = {"number": lambda x: x, "angle": self._angle, "rate": self._rate,
                 "orbit": lambda orbit: self._orbit_name(term, orbit)}
        keys = {key: write[sort](value) for key, value, sort in _core._term_table(term)}
        self.terms.append({"kind": term.kind, **keys})

    def _act_on(self, term: Any, surface: Any) -> None:
        if self.surface is not None and self.surface != surface:
            raise ValueError(
                f"build: term \"{term.name}\": a scenario has one surface; expected that of the "
                "terms before it"
            )
        self.surface = surface

    # Orbits.

    def _orbit_name(self, term: Any, orbit: Any) -> str:
        if type(orbit).__name__ not in _ORBITS:
            raise ValueError(
                f"build: term \"{term.name}\": its orbit {orbit!r} has no place in a scenario; "
                f"expected one of {', '.join(_ORBITS)}"
            )
        return self.name_of(orbit)

    def name_of(self, orbit: Any) -> str:
        """Equal orbits are one table, of the name that was given for it."""
        name = _name_in(self.orbits, orbit) or _name_in(self._names, orbit)
        if name is None:
            taken = {*self.orbits, *self._names}
            made_up = (f"orbit-{k}" for k in range(len(self.orbits) + 1, len(taken) + 2))
            name = next(free for free in made_up if free not in taken)
        self.orbits[name] = orbit
        return name

    def orbit(self, orbit: Any) -> dict[str, Any]:
        if isinstance(orbit, _core.TableOrbit):
            return _rows(orbit)
        if not isinstance(orbit, _core.TurnedKeplerOrbit):
            return self._elements(orbit)
        return {"axes": self._own_axes(orbit), **self._elements(orbit.orbit)}

    def _own_axes(self, orbit: Any) -> str:
        turned = _core.TurnedKeplerOrbit
        if self._axes == "ecliptic-J2000" and orbit == turned.from_equator(orbit.orbit):
            return "equator-J2000"
        if self._axes == "equator-J2000" and orbit == turned.from_ecliptic(orbit.orbit):
            return "ecliptic-J2000"
        raise ValueError(
            f"build: orbit {orbit!r} has no place in a scenario with axes=\"{self._axes}\"; "
            "expected elements and state along ecliptic and equator of J2000"
        )

    def _elements(self, orbit: Any) -> dict[str, Any]:
        e = orbit.elements
        if isinstance(orbit, _core.KeplerOrbit) and orbit.state is not None:
            x, v = (part.tolist() for part in orbit.state)
            return {"kind": "state", "gm": e.gm, "position": x, "velocity": v, "epoch": e.epoch}
        data = {
            "gm": e.gm,
            "pericentre": e.pericentre,
            "eccentricity": e.eccentricity,
            "inclination": self._angle(e.inclination),
            "node": self._angle(e.node),
            "pericentre_argument": self._angle(e.argument),
            "mean_anomaly": self._angle(e.mean_anomaly),
            "epoch": e.epoch,
        }
        if isinstance(orbit, _core.PrecessingKeplerOrbit):
            data["node_rate"] = self._rate(orbit.rates.node)
            data["pericentre_rate"] = self._rate(orbit.rates.argument)
            data["mean_anomaly_rate"] = self._rate(orbit.rates.mean_anomaly)
            data["inclination_rate"] = self._rate(orbit.rates.inclination)
            data["eccentricity_rate"] = orbit.rates.eccentricity
        return data


def _checked(names: Mapping[str, Any]) -> Mapping[str, Any]:
    for name, orbit in names.items():
        if not isinstance(name, str) or not re.fullmatch(r"[A-Za-z0-9_-]{1,60}", name):
            raise ValueError(
                f"build: orbits: got the name {name!r}; expected 1 to 60 letters, digits, - and _"
            )
        if type(orbit).__name__ not in _ORBITS:
            raise TypeError(
                f"build: orbits: \"{name}\": got {orbit!r}; expected one of {', '.join(_ORBITS)}"
            )
    return names


def _name_in(orbits: Mapping[str, Any], orbit: Any) -> str | None:
    same = (n for n, other in orbits.items() if type(orbit) is type(other) and orbit == other)
    return next(same, None)


def _rows(orbit: Any) -> dict[str, Any]:
    data = {"kind": "table", "order": orbit.order, "times": orbit.times.tolist()}
    data.update(zip("xyz", orbit.positions.T.tolist()))
    if orbit.velocities is not None:
        data.update(zip(("vx", "vy", "vz"), orbit.velocities.T.tolist()))
    return data


def _facet(row: list[float]) -> dict[str, Any]:
    names = ("specular", "diffuse", "emitted", "normal_accommodation", "tangential_accommodation")
    finish = dict(zip(names, row[7:]))
    return {"position": row[:3], "normal": row[3:6], "area": row[6], **finish}

