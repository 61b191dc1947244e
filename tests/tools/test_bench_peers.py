# SPDX-License-Identifier: MIT
"""The records of `make bench-peers`: their shape, how they are paired, the page made of them."""

import json
import math
import sys

import pytest


@pytest.fixture(scope="module")
def peers(root):
    sys.path.insert(0, str(root / "benchmarks/peers"))
    import native
    import page
    import records
    import timing
    yield type("Peers", (), {"native": native, "page": page, "records": records,
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


def test_the_page_says_where_polhode_is_slower(peers, entries):
    slow = peers.records.record("G5", "set-up", line("polhode new", [50.0], 1e-16),
                                line("van Zon", [10.0], 1e-12), "ns", command="it", revision="abc")
    machine = {"revision": "abc", "command": "make", "cores": 2, "load": 1.0, "system": "Debian",
               "compiler": "g++", "versions": {"numpy": "2", "heyoka": None}, "missing": ["snvec"],
               "cpu": {"model": "m", "sets": ["avx2"]}}
    text = "\n".join(peers.page.page([*entries, slow], machine, {}))
    assert "- G5: van Zon (5 times)." in text
    assert "| **0.2** |" in text
    assert "| G1, k = 0.5 | Boost |" in text
    assert "Not measured: snvec." in text
    assert "heyoka" not in text  # not installed
