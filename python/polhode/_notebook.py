# SPDX-License-Identifier: MIT
"""What a notebook shows of a body, states, a free rotation and a system: small tables.

They say what is there and compute nothing that grows with the number of states."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from polhode import _core

ANGLE, TIME, MOMENTUM = "rad", "time", "moment/time"
ENERGY, ROOT = "moment/time2", "sqrt(moment/time)"
# Fields of each kind of state with their units; those of bodies are the user's own.
FIELDS: dict[str, dict[str, str]] = {
    "RotorState": {"q": "", "g": MOMENTUM},
    "EulerState": dict(phi=ANGLE, theta=ANGLE, psi=ANGLE, Phi=MOMENTUM, Theta=MOMENTUM,
                       Psi=MOMENTUM),
    "AndoyerState": dict(l=ANGLE, g=ANGLE, h=ANGLE, L=MOMENTUM, G=MOMENTUM, H=MOMENTUM),
    "PoincareState": dict(pole_J="", pole_I="", sigma=ANGLE, Q1=ROOT, Q2=ROOT, G=MOMENTUM, P1=ROOT,
                          P2=ROOT),
    "SerretState": dict(g0=ANGLE, h=ANGLE, t0=TIME, G=MOMENTUM, H=MOMENTUM, T=ENERGY, sign_g1="",
                        sign_g3=""),
    "SadovState": dict(region="", lobe="", phi_l=ANGLE, phi_g=ANGLE, phi_h=ANGLE, I_l=MOMENTUM,
                       I_g=MOMENTUM, I_h=MOMENTUM),
    "KinoshitaState": dict(region="", lobe="", l=ANGLE, g=ANGLE, h=ANGLE, L=MOMENTUM, G=MOMENTUM,
                           H=MOMENTUM),
    "FukushimaIshizakiState": dict(l0=ANGLE, g0=ANGLE, h=ANGLE, L0=MOMENTUM, G=MOMENTUM,
                                   H=MOMENTUM, t0=TIME),
    "TumblerState": dict(precession_period=TIME, rotation_period=TIME, pole="", mode="", phi0=ANGLE,
                         psi0=ANGLE, branch="", sense=""),
}  # fmt: skip
REGIMES = {
    "short_axis": "short-axis mode (SAM)",
    "long_axis": "long-axis mode (LAM)",
    "separatrix": "separatrix",
    "steady": "steady rotation about a principal axis",
    "rest": "at rest",
}


def html_rows(title: str, rows: Iterable[Sequence[str]], head: Sequence[str] = ()) -> str:
    """A table: a title, names of columns, and rows of a name and texts."""
    import html

    left = "style='text-align:left'"

    def cells(kind: str, texts: Sequence[str]) -> str:
        return "".join(f"<{kind} {left}>{html.escape(text)}</{kind}>" for text in texts)

    caption = f"<caption {left}>{html.escape(title)}</caption>" if title else ""
    top = f"<tr>{cells('th', head)}</tr>" if head else ""
    body = "".join(f"<tr>{cells('th', row[:1])}{cells('td', row[1:])}</tr>" for row in rows)
    return f"<table>{caption}{top}{body}</table>"


def text_of(value: Any) -> str:
    """Numbers to ten digits; names of enumerations; what has parts joined by commas."""
    if isinstance(value, np.ndarray):
        return ", ".join(text_of(x) for x in value.reshape(-1))
    if isinstance(value, (float, np.floating)):
        return f"{value:.10g}"
    return str(getattr(value, "name", value))


def with_unit(value: Any, unit: str) -> str:
    return f"{text_of(value)} {unit}" if unit else text_of(value)


def of_body(body: _core.Body) -> str:
    moments = np.asarray(body.moments)
    rows = [("moments I1, I2, I3", text_of(moments)),
            ("ratios to the largest", text_of(moments / moments.max())),
            ("shape", shape_of(sorted(moments)))]  # fmt: skip
    if not np.array_equal(body.q_FB, [1.0, 0.0, 0.0, 0.0]):
        rows.append(("q_FB, principal axes to those of the tensor", text_of(body.q_FB)))
    return html_rows("Body", rows)


def shape_of(moments: Sequence[float]) -> str:
    least, middle, largest = moments
    if least == largest:
        return "all moments equal"
    if middle in (least, largest):
        return "axisymmetric, " + ("oblate" if least == middle else "prolate")
    return "triaxial"


def of_states(states: Any) -> str:
    """One state by its fields; of an array the first and the last."""
    name = type(states).__name__
    fields = FIELDS[name]
    if states.shape == ():
        return html_rows(name, [(f, with_unit(getattr(states, f), u)) for f, u in fields.items()])
    title = f"{name} of shape {states.shape}"
    if states.size == 0:
        return html_rows(title, [])
    first, last = states[(0,) * states.ndim], states[(-1,) * states.ndim]
    rows = [(f, text_of(getattr(first, f)), text_of(getattr(last, f)), unit)
            for f, unit in fields.items()]  # fmt: skip
    return html_rows(title, rows, ("", "first", "last", "unit"))


def period(rate: float) -> str:
    return with_unit(2.0 * math.pi / rate, TIME) if rate else "none"


def of_free_rotation(motion: _core.FreeRotation) -> str:
    G, T = motion.momentum, motion.energy
    rows = [("regime", REGIMES[motion.regime.name]),
            ("moments I1, I2, I3", text_of(motion.body.moments)),
            ("angular momentum G", with_unit(G, MOMENTUM)),
            ("kinetic energy T", with_unit(T, ENERGY)),
            ("epoch", with_unit(motion.epoch, TIME))]  # fmt: skip
    if G > 0.0:
        least = 0.5 * G * G / max(motion.body.moments)
        rows.insert(4, ("E/E0 (1: least energy for this G)", text_of(T / least)))
        rows += [("period of the polhode", with_unit(motion.polhode_period, TIME)),
                 ("precession period of the long axis", period(motion.precession_rate_long)),
                 ("precession period of the short axis", period(motion.precession_rate_short)),
        ]  # fmt: skip
    return html_rows("FreeRotation", rows)


def of_system(system: _core.System) -> str:
    rows = [("moments I1, I2, I3", text_of(system.body.moments)), ("frame", repr(system.frame))]
    rows += [(f"term {k}", repr(term)) for k, term in enumerate(system.terms, 1)]
    rows += [] if system.damper is None else [("damper", repr(system.damper))]
    rows.append(("Hamiltonian", "yes" if system.is_hamiltonian else "no"))
    return html_rows("System", rows)


def show_tables() -> None:
    """Gives the compiled classes what IPython asks for."""
    asked = "_repr_html_"
    shown = {_core.Body: of_body, _core.FreeRotation: of_free_rotation, _core.System: of_system}
    for kind, table in {**shown, **{getattr(_core, name): of_states for name in FIELDS}}.items():
        setattr(kind, asked, table)
