# SPDX-License-Identifier: MIT
"""From orbits, terms and the surface that they act on to the tables of a scenario file."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Any

import numpy

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
    tables = _Tables(system, axes, _checked(names), angle, rate)
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
        system: Any,
        axes: str,
        names: Mapping[str, Any],
        angle: Callable[[Any], Any],
        rate: Callable[[Any], Any],
    ) -> None:
        self.orbits: dict[str, Any] = {}
        self._names = names
        self.surface: Any = None
        self.terms: list[dict[str, Any]] = []
        self._moving = not system.frame.is_inertial
        self._axes = axes
        self._angle = angle
        self._rate = rate

    def add(self, term: Any) -> None:
        write = getattr(self, f"_{type(term).__name__}", None)
        if write is None:
            raise ValueError(
                f"build: term \"{term.name}\" ({type(term).__name__}) has no place in a scenario; "
                "expected one of the terms that are not functions in Python"
            )
        if term.arguments.get("axes") is not None:
            self._require_inertial(term)
        write(term, term.arguments)

    def _require_inertial(self, term: Any) -> None:
        if term.arguments["axes"] != _core.SpaceAxes.inertial and self._moving:
            raise ValueError(
                f"build: term \"{term.name}\": its axes are those of the moving frame, which a "
                "scenario cannot say; expected SpaceAxes.inertial"
            )

    # Gravity: the file has one table for a point mass and what comes with it.

    def _GravityGradient(self, term: Any, given: dict[str, Any]) -> None:
        name = self._orbit_name(term, term.orbit)
        self.terms.append({"kind": "gravity-gradient", **self._attractor(name, term.gm)})

    def _HigherGravity(self, term: Any, given: dict[str, Any]) -> None:
        table = self._gravity_before(term, given, "third_moments")
        table["orbit_of"] = given["orbit_of"].name
        table["third_moments"] = given["moments"].third.tolist()
        table["fourth_moments"] = given["moments"].fourth.tolist()

    def _OblateGravity(self, term: Any, given: dict[str, Any]) -> None:
        table = self._gravity_before(term, given, "J2")
        oblate = given["oblateness"]
        table.update(J2=oblate.J2, primary_radius=oblate.radius, pole=oblate.pole.tolist())

    def _gravity_before(self, term: Any, given: dict[str, Any], key: str) -> dict[str, Any]:
        own = self._attractor(self._orbit_name(term, given["orbit"]), given["gm"])
        last = self.terms[-1] if self.terms else {}
        if last.get("kind") != "gravity-gradient" or key in last or any(
            last.get(name) != own.get(name) for name in ("orbit", "gm")
        ):
            raise ValueError(
                f"build: term \"{term.name}\" ({type(term).__name__}): a scenario has it only with "
                "the point mass; expected it right after the GravityGradient of the same gm "
                "and orbit"
            )
        return last

    def _TidalTorque(self, term: Any, given: dict[str, Any]) -> None:
        name = self._orbit_name(term, given["orbit"])
        lagging = given["body"]
        self.terms.append({
            "kind": "tide", **self._attractor(name, given["gm"]), "mass": given["mass"],
            "k2": lagging.k2, "time_lag": lagging.lag, "radius": lagging.radius,
        })

    def _attractor(self, name: str, gm: float) -> dict[str, Any]:
        own = getattr(self.orbits[name], "gm", None)
        return {"orbit": name} if gm == own else {"orbit": name, "gm": gm}

    # Torques of the body's own, and friction.

    def _ConstantTorque(self, term: Any, given: dict[str, Any]) -> None:
        axes = "body" if term.axes is None else "inertial"
        self.terms.append({"kind": "constant-torque", "torque": term.u.tolist(), "axes": axes})

    def _TorqueTable(self, term: Any, given: dict[str, Any]) -> None:
        columns = numpy.transpose(given["torques"]).tolist()
        outside = "error" if given["outside"] == _core.Outside.refuse else given["outside"].name
        self.terms.append({
            "kind": "torque-table", "times": list(given["times"]),
            **{f"torque_{k + 1}": column for k, column in enumerate(columns)},
            "between": given["between"].name, "outside": outside,
            "axes": "body" if given["axes"] is None else "inertial",
        })

    def _LinearDamping(self, term: Any, given: dict[str, Any]) -> None:
        D = term.matrix
        diagonal = numpy.array_equal(D, numpy.diag(numpy.diag(D)))
        numbers = (numpy.diag(D) if diagonal else D).tolist()
        self.terms.append({"kind": "damping", "coefficients": numbers})

    def _InternalDamping(self, term: Any, given: dict[str, Any]) -> None:
        k = term.coefficients.tolist()
        self.terms.append({"kind": "internal-damping", "k": k, "grows": term.grows})

    # Light and air.

    def _SolarPressure(self, term: Any, given: dict[str, Any]) -> None:
        self._act_on(term, given["surface"])
        table = {
            "kind": "solar-pressure", **self._path(term, given),
            "pressure": given["pressure"], "pressure_distance": given["distance"],
        }
        if given["sun"] is not None:
            table["sun"] = self._orbit_name(term, given["sun"])
            table["sun_orbit_of"] = "attractor" if given["sun_reversed"] else "sun"
        if given["shadow"] is not None:
            table.update(shadow=given["shadow"], shadow_radius=given["radius"])
            if given["shadow"] == "cone":
                table["sun_radius"] = given["sun_radius"]
        self.terms.append(table)

    def _AtmosphericDrag(self, term: Any, given: dict[str, Any]) -> None:
        self._act_on(term, given["surface"])
        table = {"kind": "drag", **self._path(term, given), "density": given["density"]}
        if given["scale_height"] is not None:
            table.update(scale_height=given["scale_height"], density_radius=given["radius"])
        rotation = given["rotation"]
        if not any(rotation):
            table["air_rate"] = 0.0
        else:
            table.update(air_rate=self._rate(_norm(rotation)), air_pole=list(rotation))
        self.terms.append({**table, "exit_speed": given["exit_speed"]})

    def _path(self, term: Any, given: dict[str, Any]) -> dict[str, Any]:
        of = "attractor" if given["reversed"] else "body"
        return {"orbit": self._orbit_name(term, given["orbit"]), "orbit_of": of}

    def _act_on(self, term: Any, surface: Any) -> None:
        if self.surface is not None and self.surface != surface:
            raise ValueError(
                f"build: term \"{term.name}\": a scenario has one surface; expected that of the "
                "terms before it"
            )
        self.surface = surface

    # Magnetic fields.

    def _ResidualDipole(self, term: Any, given: dict[str, Any]) -> None:
        moment = term.moment.tolist()
        self.terms.append({"kind": "residual-dipole", "moment": moment, **self._field(term)})

    def _EddyCurrents(self, term: Any, given: dict[str, Any]) -> None:
        self.terms.append({
            "kind": "eddy-currents", "tensor": term.tensor.tolist(),
            "field_rate": term.field_rate, **self._field(term),
        })

    def _field(self, term: Any) -> dict[str, Any]:
        field = term.field
        if not isinstance(field, _core.DipoleField):
            raise ValueError(
                f"build: term \"{term.name}\": its field {field!r} has no place in a scenario; "
                "expected a DipoleField"
            )
        g11, h11, g10 = field.strength.tolist()  # at a radius of 1
        return {
            "orbit": self._orbit_name(term, term.orbit), "gauss": [g10, g11, h11],
            "reference_radius": 1.0, "pole": field.pole.tolist(),
            "rotation_rate": self._rate(field.rate), "meridian": self._angle(field.meridian),
            "meridian_epoch": field.epoch,
        }

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


def _norm(v: tuple[float, float, float]) -> float:
    """As the library forms it, so that the rate over the length of the pole is 1."""
    s = max(map(abs, v))
    x, y, z = (component / s for component in v)
    return s * math.sqrt(x * x + y * y + z * z)
