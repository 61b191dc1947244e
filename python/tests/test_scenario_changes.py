# SPDX-License-Identifier: MIT
"""Scenario.replace, columns of dates, and what observers write: in Python."""

import datetime
import pickle

import budgets
import numpy as np
import polhode
import pytest
from polhode import Scenario, ScenarioError, load
from rejections import rejected
from scenario_texts import ROOT, command_line

APOPHIS = ROOT / "examples" / "apophis.toml"


def test_replace_is_set_of_the_command_line(tmp_path):
    columns = ["date", "tumbler", "axis1"]
    changed = load(APOPHIS).replace({
        "state.tumbler.rotation_period": 250.0, "state.tumbler.mode": "LAM", "time.step": None,
        "time.count": 5, "output.columns": columns,
    })
    there, here = tmp_path / "there.csv", tmp_path / "here.csv"
    command_line("run", APOPHIS, "--out", there, "--set", "state.tumbler.rotation_period=250.0",
                 "--set", "state.tumbler.mode=LAM", "--set", "time.step=", "--set", "time.count=5",
                 "--set", "output.columns=[\"date\", \"tumbler\", \"axis1\"]")
    changed.run(here)
    assert here.read_bytes() == there.read_bytes()
    assert "# Source: Pravec, P." in changed.text  # comments stay
    assert changed.columns == tuple(columns)


def test_replace_of_tables_and_of_numbers_of_numpy():
    apophis = load(APOPHIS)
    changed = apophis.replace(time={"at": np.array([1.0, 2.5])}, title="Other")
    assert changed.title == "Other" and len(changed.time) == 2 and changed.time[1] == 2.5
    assert apophis.title == "Apophis, torque-free"
    assert changed.replace({"title": None}).title == ""
    exact = apophis.replace({"state.tumbler.phi0": 0.1 + 0.2})
    assert repr(0.1 + 0.2) in exact.text


def test_replace_looks_for_files_next_to_the_scenario():
    scenario = load(ROOT / "examples" / "migrating-exoplanet.toml")
    again = scenario.replace(title="The same orbit")
    assert again.name == scenario.name and again.title == "The same orbit"


def test_replace_says_what_is_wrong():
    apophis = load(APOPHIS)
    with pytest.raises(ScenarioError, match="body.momnets: unknown key; did you mean moments"):
        apophis.replace({"body.momnets": [1, 2, 3]})
    with pytest.raises(ScenarioError, match="state.tumbler.mode: got \"XAM\""):
        apophis.replace({"state.tumbler.mode": "XAM"})
    rejected(ValueError, r"replace: event\.0\.value: ", apophis.replace, {"event.0.value": 3})
    rejected(TypeError, "time.stop: got <object", apophis.replace, {"time.stop": object()})
    rejected(TypeError, "expected a dict", apophis.replace, ["time.stop"])


def test_dates_are_texts_that_numpy_understands():
    results = load(APOPHIS).replace({
        "output.columns": ["q", "date"], "time.stop": "2013-01-06", "time.step": "6 h",
    }).run()
    dates = results["date"]
    assert list(dates) == ["2013-01-05T00:00:00", "2013-01-05T06:00:00", "2013-01-05T12:00:00",
                           "2013-01-05T18:00:00", "2013-01-06T00:00:00"]
    assert results.units["date"] == "UTC" and not dates.flags.writeable
    assert list(results.groups["date"]) == list(dates)
    times = np.asarray(dates, "datetime64[us]")
    assert times[1].astype(datetime.datetime) == datetime.datetime(2013, 1, 5, 6)
    again = pickle.loads(pickle.dumps(results))
    assert again == results and list(again["date"]) == list(dates)
    frame = results.to_pandas()
    assert frame["date"].iloc[-1] == "2013-01-06T00:00:00"


@pytest.mark.parametrize("name", ["a.csv", "a.h5"])
def test_dates_come_back_when_a_run_is_resumed(tmp_path, name):
    scenario = load(APOPHIS).replace({"output.columns": ["tumbler", "date", "q"]})
    straight = scenario.run(tmp_path / name)
    again = scenario.run(tmp_path / name, resume=True)  # all is there: its rows are read back
    assert again == straight
    assert list(again["date"]) == list(straight["date"])
    other = tmp_path / f"written-{name}"
    straight.write(other)
    assert other.read_bytes() == (tmp_path / name).read_bytes()


def test_columns_of_a_trajectory_have_no_date_but_a_pole():
    body = polhode.Body(1.0, 2.0, 2.5)
    state = polhode.rotor_state(body, [1, 0, 0, 0], [0.1, 0.2, 1.0])
    scenario = Scenario.build(body, state, time=(0.0, 1.0, 1.0), columns=["pole", "tumbler"])
    run = scenario.run()
    momentum = np.array([0.1, 0.4, 2.5])
    lon = np.arctan2(momentum[1], momentum[0])
    assert run["pole_lon"][0] == pytest.approx(lon, rel=budgets.observer_columns)
    motion = polhode.FreeRotation(body, state)
    assert run["P_psi"][0] == motion.polhode_period
    assert run["psi_max"][0] == polhode.free.psi_max(motion)


def test_tumblers_take_the_words_of_observers():
    words = polhode.TumblerState(30.56, 263.0, [0, 0, 1], "SAM", 0.0, 0.0)
    assert words == polhode.TumblerState(
        30.56, 263.0, [0, 0, 1], polhode.free.Regime.short_axis, 0, 0
    )
    assert polhode.TumblerState(30.56, 263.0, [0, 0, 1], "LAM", 0.0, 0.0).mode == \
        polhode.free.Regime.long_axis
    body = polhode.Body(0.61, 0.965, 1.0)
    assert polhode.free.least_period_ratio(body, "LAM") == polhode.free.least_period_ratio(
        body, polhode.free.Regime.long_axis)
    rejected(ValueError, "mode", polhode.TumblerState, 30.56, 263.0, [0, 0, 1], "XAM", 0.0, 0.0)


def test_long_axis_period_is_that_of_the_paper():
    # Pravec et al. (2014): 27.38 h of the short axis, P_psi 263 h, P_1 = 30.56 h
    found = polhode.free.long_axis_period(27.38, 263.0)
    assert found == pytest.approx(30.56, abs=budgets.published_hours)
    for wrong in (0.0, -1.0, 263.0, float("nan")):
        rejected(ValueError, "long_axis_period", polhode.free.long_axis_period, wrong, 263.0)


def test_a_perturbed_run_ends_with_what_it_made_of_the_spin():
    scenario = load(ROOT / "examples" / "gravity-gradient-satellite.toml")
    results = scenario.run()
    text = str(results.summary)
    assert text.splitlines()[-1].startswith("at t = ")
    assert str(pickle.loads(pickle.dumps(results)).summary) == text
