# SPDX-License-Identifier: MIT
"""The records of `make bench-peers`: their shape, how they are paired, the page made of them."""

import json
import math
import subprocess
import sys

import pytest


@pytest.fixture(scope="module")
def peers(root):
    sys.path.insert(0, str(root / "benchmarks/peers"))
    import goals
    import native
    import page
    import records
    import timing
    yield type("Peers", (), {"goals": goals, "native": native, "page": page, "records": records,
                             "timing": timing})
    sys.path.pop(0)


def line(who, values, error):
    return {"goal": "G1", "case": "k = 0.5", "who": who, "unit": "ns", "repetitions": values,
            "error": error}


@pytest.fixture
def entries(peers):
    missing = []
    found = peers.native.paired(
        [line("polhode at", [10, 30, 20], 1e-16), line("Boost", [400, 200, 300.5], 0),
         line("polhode exactly", [90.0], None), {"missing": "GSL"}], "it", "abc", missing.append)
    assert missing == ["GSL"]
    return found


def test_every_peer_stands_beside_every_method(entries):
    assert [(r["method"], r["peer"], r["ours"], r["theirs"]) for r in entries] == [
        ("polhode at", "Boost", 20.0, 300.5), ("polhode exactly", "Boost", 90.0, 300.5)]
    assert [r["ratio"] for r in entries] == [300.5 / 20.0, 300.5 / 90.0]


def test_records_have_their_shape(peers, entries, tmp_path):
    assert peers.records.faults(entries) == []
    peers.records.write(tmp_path / "peers.json", entries)
    assert json.loads((tmp_path / "peers.json").read_text()) == entries


@pytest.mark.parametrize("field, value, word", [
    ("goal", 1, "goal is 1"), ("ours", "20", "ours is '20'"), ("ratio", 3.0, "theirs / ours"),
    ("ours", 21.0, "ratio"), ("theirs", -1.0, "positive"), ("our_error", "small", "our_error"),
    ("repetitions", {"ours": [20.0]}, "median of its repetitions")])
def test_a_wrong_record_is_seen(peers, entries, field, value, word):
    entries[0][field] = value
    assert any(word in fault for fault in peers.records.faults(entries))


def test_a_field_that_is_not_there_is_seen(peers, entries):
    del entries[1]["revision"]
    assert peers.records.faults(entries) == ["record 1: no revision"]
    assert peers.records.faults({}) == ["peers.json holds no list"]


def test_a_peer_is_matched_by_error_first(peers):
    ours = [(1.0, 1e-6), (2.0, 1e-9), (3.0, 1e-10), (4.0, 1e-12)]
    assert peers.records.matched(ours, 1e-9) == 1
    assert peers.records.matched(ours, 4e-10) == 1
    assert peers.records.matched(ours, 2e-10) == 2
    assert peers.records.matched(ours, 1e-14) == 3  # the one that errs least
    assert peers.records.matched(ours, None) == 0


def test_repetitions_are_interleaved(peers):
    order = []

    def contender(name, once=False):
        return peers.timing.Contender(name, "", lambda: (2, order.append(name)), once)
    found = peers.timing.interleaved([contender("a"), contender("b"), contender("c", True)], 3)
    assert "".join(order) == "abcabab"
    assert [len(t.seconds) for t in found] == [3, 3, 1]
    assert all(math.isfinite(t.median) and t.median >= 0 for t in found)


def test_programs_that_have_ended_are_counted(peers):
    def run():
        subprocess.run([sys.executable, "-c", "sum(range(3000000))"], check=True)
        return 1, None
    timed, = peers.timing.interleaved([peers.timing.Contender("a program", "", run)], 1)
    assert timed.median > 0.02  # python alone takes as long to start


def test_the_page_says_where_polhode_is_slower(peers, entries):
    slow = peers.records.record("G5", "set-up", line("polhode new", [50.0], 1e-16),
                                line("van Zon", [10.0], 1e-12), "ns", command="it", revision="abc")
    machine = {"revision": "abc", "command": "make", "cores": 2, "load": 1.0, "system": "Debian",
               "compiler": "g++", "versions": {"numpy": "2", "heyoka": None}, "missing": ["snvec"],
               "cpu": {"model": "m", "sets": ["avx2"]}}
    medians = [{"goal": "G7", "case": "", "who": who, "unit": "ns", "value": value, "error": 1e-16}
               for who, value in (("polhode jacobi, many at once", 2.0), ("GeographicLib", 50.0))]
    text = "\n".join(peers.page.page([*entries, slow], machine, {}, medians))
    assert "- G5: van Zon (5 times)." in text
    assert "| **0.2** |" in text
    assert "| G1 | Boost |" in text
    assert "| G7 | sn, cn, dn, 20 times as fast as GeographicLib | 25 | yes |" in text
    assert "| G15 | Mars unaveraged for a Myr" in text
    assert text.count("| not measured |") == len(peers.goals.GOALS) - 1
    assert "Not measured: snvec." in text
    assert "heyoka" not in text.split("## The goals")[0]  # not installed


def median(goal, case, who, value, error=None):
    return {"goal": goal, "case": case, "who": who, "unit": "ns", "value": value, "error": error}


def test_goals_are_judged_by_their_worst_case(peers):
    goals = peers.goals
    lanes, boost = goals.LANES, goals.BOOST
    found = goals.Medians([
        median("G1", "k = 0.5", lanes, 3.0, 1e-16), median("G1", "k = 0.5", boost, 6000.0, 1e-12),
        median("G1", "k = 0.9", lanes, 10.0, 6e-16), median("G1", "k = 0.9", boost, 6000.0, 1e-9),
        median("G1", "k = 0.9", lanes + ", AVX2", 20.0), median("G1", "k = 1", boost, 1.0)])
    text, met = goals.Goal("G1", "", goals.ratios("G1", lanes, boost), 1300).line(found)
    assert (text, met) == ("600 to 2000", "no")
    assert goals.Goal("G1", "", goals.ratios("G1", lanes, boost), 500).line(found)[1] == "yes"
    errors = goals.numbers("error", "G1", lanes)
    assert goals.Goal("G3", "", errors, most=5e-16).line(found) == ("1.0e-16 to 6.0e-16", "no")
    assert goals.Goal("G3", "", errors, most=1e-15).line(found)[1] == "yes"
    assert goals.Goal("G2", "", goals.ratios("G2", lanes, boost)).line(found) == (
        "not measured", "")
    assert goals.quickest("G1", lanes[:-3] + "...", 5e-16, 1e3)(found) == [3000.0]
    assert goals.between("G1", lanes, "k = 0.9", boost, "k = 0.5")(found) == [600.0]


def test_a_default_that_errs_too_much_meets_no_goal(peers):
    goals = peers.goals
    entries = [median("G9", "W1, tolerance", goals.TIGHTEST, 8.0, 1e-11),
               median("G9", "W1, tolerance", "polhode Adaptive, 1e-14", 4.0, 2e-11),
               median("G9", "W1, tolerance", "polhode integrate_many of 8, default", 0.1, 1e-12)]
    close = median("G9", "W1, tolerance", goals.DEFAULT, 1.0, 3e-11)
    wrong = median("G9", "W1, tolerance", goals.DEFAULT, 1.0, 3e-10)
    found = goals.beside_heyoka("W1")
    assert list(found(goals.Medians([*entries, close]))) == [8.0]
    assert list(found(goals.Medians([*entries, wrong]))) == [2.0]
    assert list(found(goals.Medians([entries[0], wrong]))) == []


def test_every_goal_has_a_line(peers):
    names = {goal.name for goal in peers.goals.GOALS}
    assert {f"G{k}" for k in range(1, 16)} <= names
    for goal in peers.goals.GOALS:
        assert goal.line(peers.goals.Medians([])) == ("not measured", "")


def test_cases_that_differ_by_a_modulus_share_a_line(peers):
    rows = [peers.records.record("G1", case, line("polhode a", [ours], 1e-16),
                                 line("b", [theirs], error), "ns", command="it", revision="abc")
            for case, ours, theirs, error in (
                ("k = 0.05", 2.0, 100.0, 1e-12), ("k = 1 - 1e-9", 4.0, 100.0, 1e-5),
                ("K, 1 - m = 2e-9", 4.0, 2.0, None))]
    assert list(peers.page.table(rows))[2:] == [
        "| G1 | b | 100 ns | 1.0e-05 | a | 2 to 4 ns | 1.0e-16 | 25 to 50 |",
        "| G1, K | b | 2 ns |  | a | 4 ns | 1.0e-16 | **0.5** |"]


def test_the_shadow_of_a_case_is_entered_and_left_in_order(peers):
    pytest.importorskip("numpy")
    import sunlight
    edges = sunlight.edges(20.0)
    assert [light for _, light in edges[:5]] == ["all", "part", "none", "part", "all"]
    assert edges[-1] == (20.0, "all")
    moved = sunlight.with_margins(edges)
    assert all(a[0] < b[0] for a, b in zip(moved, moved[1:], strict=False))
    assert 0 < moved[0][0] - edges[0][0] < 1e-5 * (edges[1][0] - edges[0][0])
    assert 0 > moved[1][0] - edges[1][0]


def test_ensembles_are_compared_at_equal_error(peers):
    entries = [median("ensemble", "64", "heyoka e, 1e-15", 8.0, 1e-10),
               median("ensemble", "64", "polhode ensemble, default", 4.0, 1e-11),
               median("ensemble", "64", "polhode ensemble, 1e-10", 2.0, 2e-10),
               median("ensemble", "64", "polhode ensemble, 1e-9", 1.0, 4e-10)]
    found = peers.goals.beside_at_equal_error("ensemble", "heyoka e, 1e-15")
    assert list(found(peers.goals.Medians(entries))) == [4.0]
    assert list(found(peers.goals.Medians([entries[0], entries[3]]))) == []
