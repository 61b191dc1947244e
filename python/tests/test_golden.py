# SPDX-License-Identifier: MIT
"""Golden cases and units, as Python has them."""

import copy
import gc
import json
import pickle

import budgets
import numpy as np
import polhode
import pytest
from polhode import Body, FreeRotation, Units, rotor_state
from polhode.free import Regime, golden_cases
from polhode.kinds import Dimension
from scenario_texts import command_line

CASES = golden_cases()


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_free_rotation_keeps_the_bound_of_a_golden_case(case):
    body = Body(*case.moments)
    motion = FreeRotation(body, rotor_state(body, case.q0, case.omega0))
    assert motion.regime == case.regime
    states = motion.at(case.t)
    sign = np.sign(np.sum(states.q * case.q, axis=-1, keepdims=True))
    off = np.linalg.norm(sign * states.q - case.q, axis=-1).max()
    # of the momentum: a needle's angular velocity shows its rounding some hundred times larger
    momentum_off = np.linalg.norm(states.g - case.moments * case.omega, axis=-1).max()
    rounding = case.bound * case.moments.max() * np.linalg.norm(case.omega, axis=-1).max()
    assert off < case.bound + budgets.free_state
    assert momentum_off <= motion.momentum * budgets.free_state + rounding


def test_samples_are_views_that_keep_their_case():
    q = golden_cases()[0].q
    before = q.tobytes()
    gc.collect()
    assert q.tobytes() == before == CASES[0].q.tobytes() and not q.flags.writeable
    case = CASES[0]
    assert case.t.shape == (len(case),) and case.omega.shape == (len(case), 3)
    assert np.all(case.q[:, 0] >= 0) and case.description and case.name in repr(case)


def test_the_files_are_those_of_the_command_line(tmp_path):
    command_line("golden", tmp_path / "there")
    polhode.free.write_golden(tmp_path / "here")
    for name in ("golden.json", "golden.csv"):
        here, there = (tmp_path / folder / name for folder in ("here", "there"))
        assert here.read_bytes() == there.read_bytes()
    read = json.loads((tmp_path / "here" / "golden.json").read_text())
    assert [c["name"] for c in read["cases"]] == [c.name for c in CASES]
    (tmp_path / "file").write_text("")
    with pytest.raises(polhode.DomainError):
        polhode.free.write_golden(tmp_path / "file")


def test_names_of_regimes():
    assert [polhode.free.regime_name(r) for r in Regime] == [r.name for r in Regime]


# Units.


def test_units_convert_as_in_files():
    units = Units(time="h", angle="deg", moment="kg m2", length="km")
    assert units.to_core("27.38 h", "time") == 27.38
    assert units.to_core("30 min", Dimension.time) == 0.5
    assert units.to_core(180.0, "angle") == np.pi
    assert units.to_core([[180.0], [90.0]], "rate").tolist() == [[np.pi], [np.pi / 2]]
    assert units.to_core([1.0, 2.0], "length", "m").tolist() == [1e-3, 2e-3]
    assert units.from_core(np.pi, "angle") == 180.0
    assert units.from_core(np.array([1.0, 2.0]), "moment").tolist() == [1.0, 2.0]
    assert units.label("rate") == "deg/h" and units.label("momentum") == "kg m2/h"
    assert polhode.kinds.known_units()["h"] == "hour"


def test_units_are_values():
    units = Units("d", "arcsec")
    assert units == Units("d", "arcsec") and units != Units("d") and units != "d"
    assert hash(units) == hash(Units("d", "arcsec"))
    assert pickle.loads(pickle.dumps(units)) == units == copy.copy(units) == eval(repr(units))


@pytest.mark.parametrize(("call", "message"), [
    (lambda: Units("hours"), "did you mean h?"),
    (lambda: Units(angle="km"), "is not a unit of angle"),
    (lambda: Units().to_core("3 deg", "time"), "is not a unit of time"),
    (lambda: Units().to_core("3", "time"), "a number without its unit"),
    (lambda: Units().to_core("3 h", "time", "h"), "expected no unit in addition"),
    (lambda: Units().to_core("3 " + "h" * 300, "time"), "more than 200 letters"),
    (lambda: Units().to_core(3, "tiem"), "expected one of number time angle"),
])
def test_wrong_units_say_what_was_expected(call, message):
    with pytest.raises(ValueError) as error:
        call()
    assert message in str(error.value)
