# SPDX-License-Identifier: MIT
"""polhode golden: its files are well formed, and their numbers are those of a 60-digit integration
that shares nothing with polhode."""

import csv
import json
import subprocess

import budgets
import mpmath as mp
import pytest
from closeness import largest, smallest

DIGITS = 60
ORDER = 80
# Cases integrated here, to the times below; tests/unit/run/golden.cpp does all of them.
INTEGRATED = ["sam", "lam-reverse", "near-separatrix-lam-1e-8", "separatrix", "spin-b2", "near-b2",
              "sphere", "oblate-reverse", "prolate", "flat-sam", "needle", "order-634"]
LAST_TIME = 5.0


def golden(polhode, folder):
    return subprocess.run([polhode, "golden", folder], text=True, stdin=subprocess.DEVNULL,
                          capture_output=True)


@pytest.fixture(scope="module")
def folder(polhode, tmp_path_factory):
    path = tmp_path_factory.mktemp("golden") / "made" / "here"
    done = golden(polhode, path)
    assert (done.returncode, done.stderr) == (0, "")
    assert sorted(p.name for p in path.iterdir()) == ["golden.csv", "golden.json"]
    return path


@pytest.fixture(scope="module")
def cases(folder):
    document = json.loads((folder / "golden.json").read_text(), parse_float=mp.mpf)
    return {case["name"]: case for case in document["cases"]}


def test_the_json_is_what_the_page_says(folder):
    document = json.loads((folder / "golden.json").read_text())
    assert set(document) == {"title", "polhode", "meaning", "cases"}
    for case in document["cases"]:
        assert set(case) == {"name", "description", "regime", "moments", "q0", "omega0_body",
                             "bound", "samples"}
        assert [len(case[key]) for key in ("moments", "q0", "omega0_body")] == [3, 4, 3]
        assert 0.0 < case["bound"] < budgets.free_state
        for sample in case["samples"]:
            assert set(sample) == {"t", "q", "omega"}
            assert [len(sample["q"]), len(sample["omega"])] == [4, 3]


def test_the_csv_holds_the_same_numbers(folder, cases):
    lines = [line for line in (folder / "golden.csv").read_text().splitlines()
             if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    expected = [(case, sample) for case in cases.values() for sample in case["samples"]]
    assert len(rows) == len(expected)
    for row, (case, sample) in zip(rows, expected):
        assert (row["case"], row["regime"]) == (case["name"], case["regime"])
        numbers = [mp.mpf(x) for x in list(row.values())[2:]]
        assert numbers == [*case["moments"], *case["q0"], *case["omega0_body"], case["bound"],
                           sample["t"], *sample["q"], *sample["omega"]]


def test_every_kind_of_motion_occurs(cases):
    assert {case["regime"] for case in cases.values()} == {
        "rest", "steady", "short_axis", "long_axis", "separatrix"}
    assert {"sphere", "oblate", "prolate", "flat-sam", "spin-b1", "spin-b2", "spin-b3",
            "near-separatrix-sam-1e-8", "long-sam"} <= set(cases)
    rank = [tuple(sorted(range(3), key=lambda i: float(case["moments"][i])))
            for case in cases.values()]
    assert len(set(rank)) == 6  # every order of the axes
    turns = [mp.norm(mp.matrix(case["omega0_body"])) * case["samples"][-1]["t"] / (2 * mp.pi)
             for case in cases.values()]
    assert largest(turns) > 1e6


def taylor(moments, q, w):
    """Taylor coefficients of omega and of the quaternion: dq/dt = q (0, omega) / 2, Euler's
    equations."""
    i1, i2, i3 = moments
    w1, w2, w3 = ([x] for x in w)
    a, b, c, d = ([x] for x in q)

    def product(x, y):
        return mp.fdot(zip(x, reversed(y)))

    for k in range(ORDER):
        n = mp.mpf(k + 1)
        rates = ((i2 - i3) / i1 * product(w2, w3), (i3 - i1) / i2 * product(w3, w1),
                 (i1 - i2) / i3 * product(w1, w2))
        turns = (-product(b, w1) - product(c, w2) - product(d, w3),
                 product(a, w1) + product(c, w3) - product(d, w2),
                 product(a, w2) + product(d, w1) - product(b, w3),
                 product(a, w3) + product(b, w2) - product(c, w1))
        for series, rate in zip((w1, w2, w3), rates):
            series.append(rate / n)
        for series, turn in zip((a, b, c, d), turns):
            series.append(turn / (2 * n))
    return (a, b, c, d), (w1, w2, w3)


def step_of(series):
    """A step whose last terms are below the digits."""
    size = largest(abs(s[k]) ** (mp.mpf(1) / k) for s in series for k in (ORDER - 1, ORDER))
    return mp.inf if size == 0 else mp.mpf(10) ** (-mp.mpf(DIGITS) / ORDER) / size


def value(series, h):
    total = mp.mpf(0)
    for coefficient in reversed(series):
        total = total * h + coefficient
    return total


def integrated(case, times):
    """q and omega at the times, which rise from 0."""
    q = mp.matrix(case["q0"])
    q, w, t, states = list(q / mp.norm(q)), list(map(mp.mpf, case["omega0_body"])), mp.mpf(0), []
    series = taylor(case["moments"], q, w)
    longest = step_of([*series[0], *series[1]])
    for end in times:
        while True:
            h = smallest(longest, end - t)
            ends = [[value(s, h) for s in group] for group in series]
            if h == end - t:
                states.append(ends)
                break
            t += h
            q, w = ends
            series = taylor(case["moments"], q, w)
            longest = step_of([*series[0], *series[1]])
    return states


@pytest.mark.parametrize("name", INTEGRATED)
def test_samples_are_exact_to_their_bound(cases, name):
    case = cases[name]
    samples = [sample for sample in case["samples"] if sample["t"] <= LAST_TIME]
    assert len(samples) >= 4
    with mp.workdps(DIGITS + 10):
        case["moments"] = [mp.mpf(x) for x in case["moments"]]
        states = integrated(case, [mp.mpf(sample["t"]) for sample in samples])
        for sample, (q, w) in zip(samples, states):
            exact_q, printed_q = mp.matrix(q), mp.matrix(sample["q"])
            exact_w, printed_w = mp.matrix(w), mp.matrix(sample["omega"])
            off = smallest(mp.norm(printed_q - exact_q), mp.norm(printed_q + exact_q))
            assert off <= case["bound"]
            assert mp.norm(printed_w - exact_w) <= case["bound"] * mp.norm(exact_w)


def test_a_second_run_writes_the_same_bytes(polhode, folder):
    before = {p.name: p.read_bytes() for p in folder.iterdir()}
    assert golden(polhode, folder).returncode == 0
    assert {p.name: p.read_bytes() for p in folder.iterdir()} == before


def one_line(done, returncode):
    assert (done.returncode, done.stdout) == (returncode, "")
    assert done.stderr.endswith("\n") and done.stderr.count("\n") == 1
    return done.stderr


def test_a_file_in_the_place_of_the_folder(polhode, tmp_path):
    (tmp_path / "taken").write_text("mine")
    assert "taken" in one_line(golden(polhode, tmp_path / "taken"), 2)
    assert "taken" in one_line(golden(polhode, tmp_path / "taken" / "below"), 2)
    assert (tmp_path / "taken").read_text() == "mine"


def test_a_folder_in_the_place_of_a_file(polhode, tmp_path):
    (tmp_path / "golden.csv").mkdir()
    assert "golden.csv" in one_line(golden(polhode, tmp_path), 2)
    assert not (tmp_path / "golden.json").exists()


def test_a_full_disk(polhode, tmp_path):
    (tmp_path / "golden.csv").symlink_to("/dev/full")
    assert "No space left" in one_line(golden(polhode, tmp_path), 1)
    assert not (tmp_path / "golden.json").exists()


def test_the_folder_must_be_named(polhode):
    done = subprocess.run([polhode, "golden"], text=True, stdin=subprocess.DEVNULL,
                          capture_output=True)
    assert "DIR" in one_line(done, 2)
