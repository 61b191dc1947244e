# SPDX-License-Identifier: MIT
"""Tables of notebooks: every field with its unit, and what people see stays text."""

import math
from html.parser import HTMLParser

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode._notebook import FIELDS

BODY = polhode.Body(0.61, 0.965, 1.0)
TIMES = np.arange(6.0).reshape(2, 3)
# What a unit becomes when moments are `moment` and times `time` times what they were.
POWERS = {"": (0, 0), "rad": (0, 0), "time": (0, 1), "moment/time": (1, -1),
          "moment/time2": (1, -2), "sqrt(moment/time)": (0.5, -0.5)}  # fmt: skip


class Cells(HTMLParser):
    """Rows of a table as lists of texts; the title is a row of one."""

    def __init__(self, html):
        super().__init__()
        self.rows, self.tags = [], []
        self.feed(html)
        self.close()
        assert not self.tags

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        if tag in ("tr", "caption"):
            self.rows.append([])
        if tag in ("td", "th", "caption"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        assert self.tags.pop() == tag

    def handle_data(self, data):
        assert self.tags[-1] in ("td", "th", "caption")
        self.rows[-1][-1] += data


def rows_of(thing):
    return Cells(thing._repr_html_()).rows


def fields_of(thing):
    return {row[0]: row[1] for row in rows_of(thing)[1:]}


def motion(moment=1.0, unit=1.0):
    body = polhode.Body(*(moment * BODY.moments))
    rate = np.array([0.1, 0.2, 1.0]) / unit
    return polhode.FreeRotation(body, polhode.rotor_state(body, [0.9, 0.1, 0.3, 0.2], rate))


def charts(motion, t):
    s = motion.at(t)
    return [s, polhode.to_euler(s), polhode.to_andoyer(s), polhode.to_poincare(s, "zero", "pi"),
            polhode.to_serret(motion, t), polhode.to_sadov(motion, t),
            polhode.to_kinoshita(motion, t), polhode.to_fukushima_ishizaki(motion, t),
            polhode.to_tumbler(motion, t)]  # fmt: skip


def test_every_chart_shows_every_field():
    shown = charts(motion(), 1.0)
    assert {type(state).__name__ for state in shown} == {*FIELDS}
    for state in shown:
        names = {n for n in dir(state) if not n.startswith("_") and not callable(getattr(state, n))}
        rows = rows_of(state)
        assert rows[0] == [type(state).__name__]
        assert {row[0] for row in rows[1:]} == names - {"shape", "ndim", "size"}


@pytest.mark.parametrize("k", range(9), ids=FIELDS)
def test_units_are_those_that_the_numbers_scale_with(k):
    moment, unit = 8.0, 0.25
    state, scaled = charts(motion(), 1.0)[k], charts(motion(moment, unit), unit)[k]
    for name, said in FIELDS[type(state).__name__].items():
        value, other = getattr(state, name), getattr(scaled, name)
        if hasattr(value, "name"):
            assert value == other and said == ""
            continue
        p, q = POWERS[said]
        factor = moment**p * unit**q
        tolerance = budgets.round_trip_floor * np.max(np.abs(other))
        assert_allclose(other, np.multiply(value, factor), atol=tolerance)


def test_an_array_shows_its_first_and_last_state():
    states = polhode.to_andoyer(motion().at(TIMES))
    title, head, *rows = rows_of(states)
    assert title == ["AndoyerState of shape (2, 3)"] and head == ["", "first", "last", "unit"]
    assert rows[4] == ["G", f"{states[0, 0].G:.10g}", f"{states[1, 2].G:.10g}", "moment/time"]
    assert rows_of(states[:0]) == [["AndoyerState of shape (0, 3)"]]


def test_a_body_says_its_moments_and_shape():
    assert fields_of(BODY) == {"moments I1, I2, I3": "0.61, 0.965, 1", "shape": "triaxial",
                               "ratios to the largest": "0.61, 0.965, 1"}  # fmt: skip
    for moments, shape in (((1, 1, 1), "all moments equal"), ((2, 3, 2), "axisymmetric, oblate"),
                           ((3, 2, 3), "axisymmetric, prolate")):  # fmt: skip
        assert fields_of(polhode.Body(*moments))["shape"] == shape
    turned = polhode.Body.from_tensor([[2, 0.1, 0], [0.1, 3, 0], [0, 0, 4]])
    assert len(fields_of(turned)["q_FB, principal axes to those of the tensor"].split(", ")) == 4


def test_a_motion_says_its_regime_and_periods():
    m = motion()
    shown = fields_of(m)
    assert shown["regime"] == "short-axis mode (SAM)"
    assert shown["period of the polhode"] == f"{m.polhode_period:.10g} time"
    long_axis, short_axis = (2 * math.pi / x for x in (m.precession_rate_long,
                                                       m.precession_rate_short))  # fmt: skip
    assert shown["precession period of the long axis"] == f"{long_axis:.10g} time"
    assert shown["precession period of the short axis"] == f"{short_axis:.10g} time"
    for g, regime in (([1, 0, 0], "steady rotation about a principal axis"), ([0, 0, 0], "at rest"),
                      ([1, 0, 0.1], "long-axis mode (LAM)")):  # fmt: skip
        shown = fields_of(polhode.FreeRotation(BODY, polhode.RotorState([1, 0, 0, 0], g)))
        assert shown["regime"] == regime
    slowest = polhode.FreeRotation(BODY, polhode.RotorState([1, 0, 0, 0], [0, 0, 3.0]))
    assert fields_of(slowest)["E/E0 (1: least energy for this G)"] == "1"


class Torque:
    """A term whose text is HTML."""

    def __call__(self, t, state):
        return np.zeros(3)

    def __repr__(self):
        return "<b>&amp;</b>"


def test_a_system_says_what_acts_and_escapes_it():
    term = polhode.TorqueTerm(Torque())
    system = polhode.System(BODY, terms=[term], damper=polhode.KaneDamper(0.1, 0.2))
    assert "<b>" not in system._repr_html_()
    shown = fields_of(system)
    assert shown["term 1"] == repr(term)
    assert shown["damper"] == repr(system.damper) and shown["Hamiltonian"] == "no"
    assert fields_of(polhode.System(BODY))["Hamiltonian"] == "yes"
