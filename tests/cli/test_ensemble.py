# SPDX-License-Identifier: MIT
"""`polhode ensemble`: the same bytes for any number of threads and after kills, members that can be
run alone, and statistics that are those of their rows."""

import signal
import subprocess
import time

import budgets
import h5py
import numpy
import pytest
from ensemble_files import (
    COLLOCATION,
    TORQUE,
    VARY,
    dimensions,
    expect_other_sines_rejected,
    mark,
    rows_of,
)
from slowdown import SLOWDOWN

SECONDS = 60 * SLOWDOWN


@pytest.mark.parametrize("keep", ["statistics", "final", "rows"])
@pytest.mark.parametrize("extra", ["", TORQUE, COLLOCATION])
def test_any_number_of_threads_gives_the_same_files(run, ensemble, tmp_path, keep, extra):
    path = ensemble(f'size = 40\nchunk = 7\nkeep = "{keep}"', extra=extra,
                    columns='"q", "omega", "andoyer", "tumbler"')
    marks = set()
    for threads in (1, 2, 3):
        outs = [tmp_path / f"{threads}.csv", tmp_path / f"{threads}.h5"]
        done = run.ok("ensemble", path, "--out", outs[0], "--out", outs[1], "--threads", threads)
        assert "members           40\nvaried            state.attitude-rate.omega_body[2]: " in (
            done.stdout)
        marks.add(tuple(mark(out) for out in outs))
    assert len(marks) == 1


@pytest.mark.parametrize("keep, rows, first", [
    ("statistics", "t", "t"), ("final", "member", "member"), ("rows", "row", "member")])
def test_dimensions_have_names(run, ensemble, tmp_path, keep, rows, first):
    out = tmp_path / "e.h5"
    run.ok("ensemble", ensemble(f'size = 5\nkeep = "{keep}"'), "--out", out)
    found = dimensions(out)
    assert next(iter(found)) == first and {names[0] for names in found.values()} == {rows}
    assert all(names[1:] in ((), (f"{group}_column",)) for group, names in found.items())
    chunks = ensemble('size = 5\nchunk = 2\nkeep = "rows"')
    run.ok("ensemble", chunks, "--out", tmp_path / "c-{chunk}.h5")
    assert {names[0] for names in dimensions(tmp_path / "c-index.h5").values()} == {"chunk"}
    assert {names[0] for names in dimensions(tmp_path / "c-1.h5").values()} == {"row"}


@pytest.mark.parametrize("keep", ["statistics", "final", "rows"])
def test_an_ensemble_survives_kills(polhode, run, ensemble, tmp_path, keep):
    path = ensemble(f'size = 300\nchunk = 10\nkeep = "{keep}"', extra=TORQUE,
                    time="stop = 400\nstep = 4")
    whole, out, table = tmp_path / "whole.csv", tmp_path / "part.csv", tmp_path / "part.h5"
    run.ok("ensemble", path, "--out", whole)
    command = [polhode, "ensemble", path, "--out", out, "--out", table, "--resume",
               "--checkpoint", "0"]
    for threads, pause in (("1", 0.2), ("2", 0.3), ("3", 0.2)):
        process = subprocess.Popen([*command, "--threads", threads], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        time.sleep(pause)
        process.kill()
        process.wait()
    if out.exists():  # it was complete when the last kill came
        assert out.read_bytes() == whole.read_bytes()
    run.ok(*command[1:])
    assert out.read_bytes() == whole.read_bytes()
    assert {one.name for one in tmp_path.iterdir()} == {
        "body.toml", "whole.csv", "part.csv", "part.h5"}
    again = run(*command[1:])
    assert "nothing to do: complete" in again.stdout
    straight = tmp_path / "straight.h5"
    run.ok("ensemble", path, "--out", straight)
    assert mark(straight) == mark(table)


def test_ctrl_c_keeps_the_members(polhode, run, ensemble, tmp_path):
    path = ensemble("size = 100000\nchunk = 10", extra=TORQUE, time="stop = 400\nstep = 4")
    out = tmp_path / "out.csv"
    process = subprocess.Popen([polhode, "ensemble", path, "--out", out, "--checkpoint", "0"],
                               text=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    checkpoint = tmp_path / "out.csv.checkpoint"
    until = time.monotonic() + SECONDS
    while not checkpoint.exists() and time.monotonic() < until:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=SECONDS)
    assert process.returncode == 128 + signal.SIGINT
    assert "stopped after" in error and "of 100000 members; continue with: " in error
    assert "ensemble" in error and error.rstrip().endswith("--resume")
    done = run("ensemble", path, "--out", out)
    assert done.returncode != 0 and "an unfinished ensemble is there" in done.stderr
    path.write_text(path.read_text().replace("seed = 1", "").replace("size = 100000",
                                                                     "size = 100000\nseed = 2"))
    done = run("ensemble", path, "--out", out, "--resume")
    assert "is of another ensemble: scenario was" in done.stderr


def test_a_machine_with_other_sines_does_not_go_on_unless_told(polhode, elsewhere, tmp_path):
    out = tmp_path / "out.csv"
    words = ["ensemble", "examples/apophis-ensemble.toml", "--set", "ensemble.size=6000", "--set",
             "ensemble.chunk=100", "--checkpoint", "0", "--out", out]
    expect_other_sines_rejected(polhode, elsewhere, words, out)


@pytest.mark.parametrize("extra", ["", TORQUE, COLLOCATION])
def test_a_member_alone_is_that_of_the_ensemble(run, ensemble, tmp_path, extra):
    vary = VARY + """
[[ensemble.vary]]
kind = "log-uniform"
key = "body.moments[2]"
low = 2.3
high = 2.5
"""
    path = ensemble('size = 50\nkeep = "final"', vary=vary, extra=extra,
                    body='moments = ["1 kg m2", "2 kg m2", "2.5 kg m2"]')
    path.write_text(path.read_text().replace("[body]", "units.moment = \"kg m2\"\n[body]"))
    final = tmp_path / "final.csv"
    run.ok("ensemble", path, "--out", final)
    last = rows_of(final)
    for member in (0, 17, 49):
        out, toml = tmp_path / f"{member}.csv", tmp_path / f"{member}.toml"
        run.ok("ensemble", path, "--member", member, "--out", out, "--out", toml)
        alone = rows_of(out)
        for name, column in alone.items():
            assert column[-1] == last[name][member], name
        again = tmp_path / f"again-{member}.csv"
        run.ok("run", toml, "--out", again)
        assert all((rows_of(again)[name] == column).all() for name, column in alone.items())
        assert toml.read_text() == run("ensemble", path, "--member", member).stdout
        assert toml.read_text().startswith(f"# Member {member} of body.toml, 50 members, seed 1\n")
        assert "[ensemble" not in toml.read_text()


def test_statistics_are_those_of_the_rows(run, ensemble, tmp_path):
    parts = {"columns": '"q", "omega", "andoyer", "tumbler"', "time": "stop = 3\nstep = 0.5"}
    vary = VARY.replace('kind = "attitude"\nkeys = ["state.attitude-rate.quaternion"]',
                        'kind = "uniform"\nkey = "state.attitude-rate.quaternion[1]"\n'
                        "low = -0.1\nhigh = 0.1")
    kept = {}
    for keep in ("statistics", "rows"):
        path = ensemble(f'size = 200\nkeep = "{keep}"\nquantiles = [0.025, 0.5, 0.9]', vary=vary,
                        **parts)
        run.ok("ensemble", path, "--out", tmp_path / f"{keep}.csv")
        kept[keep] = rows_of(tmp_path / f"{keep}.csv")
    base = tmp_path / "base.csv"
    run.ok("run", path, "--out", base)
    base, found, rows = rows_of(base), kept["statistics"], kept["rows"]
    times = found["t"]
    assert (found["members"] == 200).all() and len(times) == 7
    for k, t in enumerate(times):
        here = rows["t"] == t
        for name in ("w1", "w2", "w3", "l", "g", "h", "L", "G", "H", "P_phi", "P_psi"):
            x = rows[name][here]
            if name in ("l", "g", "h"):
                center = base[name][k]
                x = center + numpy.remainder(x - center + numpy.pi, 2 * numpy.pi) - numpy.pi
            scale = abs(x).max()
            assert found[f"{name}_members"][k] == 200
            for what, value in (("mean", x.mean()), ("deviation", x.std(ddof=1)),
                                ("least", x.min()), ("greatest", x.max()),
                                ("p2.5", numpy.quantile(x, 0.025)), ("p50", numpy.median(x)),
                                ("p90", numpy.quantile(x, 0.9))):
                error = abs(found[f"{name}_{what}"][k] - value)
                assert error <= budgets.ensemble_statistics * scale, (name, what, t)
        mode = rows["mode"][here]
        assert found["mode_SAM"][k] == (mode == 1).mean()
        assert found["mode_LAM"][k] == (mode == -1).mean()
        q = numpy.array([rows[f"q{x}"][here] for x in "wxyz"]).T
        mean, covariance = frechet(q)
        told = numpy.array([found[f"q_mean_{x}"][k] for x in "wxyz"])
        away = 2 * numpy.linalg.norm(product(mean * [1, -1, -1, -1], told)[1:])
        assert away <= found["q_mean_error"][k] < budgets.ensemble_frechet
        pairs = [(0, 0, "11"), (0, 1, "12"), (0, 2, "13"), (1, 1, "22"), (1, 2, "23"), (2, 2, "33")]
        for i, j, pair in pairs:
            error = abs(found[f"q_cov_{pair}"][k] - covariance[i, j])
            assert error <= found["q_cov_error"][k] < budgets.ensemble_frechet


def product(a, b):
    w = a[..., :1] * b[..., :1] - (a[..., 1:] * b[..., 1:]).sum(-1, keepdims=True)
    v = a[..., :1] * b[..., 1:] + b[..., :1] * a[..., 1:] + numpy.cross(a[..., 1:], b[..., 1:])
    return numpy.concatenate([w, v], -1)


def frechet(q):
    """Mean and covariance of the rotation vectors about it, by iteration."""
    mean = q[0]
    for _ in range(50):
        v = product(mean * [1, -1, -1, -1], q)
        v = v * numpy.where(v[:, :1] < 0, -1, 1)
        size = numpy.linalg.norm(v[:, 1:], axis=1, keepdims=True)
        angle = 2 * numpy.arctan2(size, v[:, :1])
        w = v[:, 1:] / numpy.where(size > 0, size, 1) * angle
        d = w.mean(0)
        half = numpy.linalg.norm(d) / 2
        if half > 0:
            step = numpy.concatenate([[numpy.cos(half)], numpy.sin(half) * d / (2 * half)])
            mean = product(mean, step)
    return mean, numpy.cov(w.T)


def test_quantiles_from_bins_are_within_their_error(run, ensemble, tmp_path):
    """40,000 members, 50 times and 6 columns are too many numbers to be kept: bins, also those of a
    histogram, are over the range of the first 1024 members."""
    vary = """
[[ensemble.histogram]]
name = "bins"
columns = ["L"]
[[ensemble.vary]]
kind = "normal"
key = "state.attitude-rate.omega_body[2]"
sigma = 0.05
"""
    out, table = tmp_path / "out.h5", tmp_path / "rows.h5"
    parts = {"columns": '"andoyer"', "time": "stop = 10\ncount = 50"}
    path = ensemble("size = 40000\nchunk = 1000", vary=vary, **parts)
    run.ok("ensemble", path, "--out", out)
    path = ensemble('size = 40000\nkeep = "rows"', vary=vary, **parts)
    run.ok("ensemble", path, "--out", table)
    with h5py.File(out) as file, h5py.File(table) as rows:
        L = rows["andoyer"][:].reshape(40000, 50, 6)
        last = dict(zip(file["L"].attrs["columns"], file["L"][-1]))
        x = L[:, -1, 3]
        error = last["L_p_error"]
        assert 0 < error < 0.01 * (x.max() - x.min())
        for name, p in (("L_p5", 0.05), ("L_p50", 0.5), ("L_p95", 0.95)):
            assert abs(last[name] - numpy.quantile(x, p)) <= error
    with h5py.File(tmp_path / "out.bins.h5") as file:
        low, high = file["L"][:].T
        first = x[:1024]
        margin = 0.1 * (first.max() - first.min())
        assert (low[1], high[-2]) == (first.min() - margin, first.max() + margin)
        assert (file["members"][1:-1, 0] == numpy.histogram(x, low[1:])[0]).all()
        assert file["members"][:, 0].sum() == 40000


def test_phases_of_free_tumblers_spread_linearly(run, scenario, tmp_path):
    """An axisymmetric body: l goes evenly, at a rate that is linear in the spin about its axis."""
    path = scenario(body="moments = [2, 2, 1]", time="stop = 40\ncount = 5", columns='"andoyer"')
    path.write_text(path.read_text() + """
[ensemble]
size = 4000
draws = "sobol"
[[ensemble.vary]]
kind = "normal"
key = "state.attitude-rate.omega_body[2]"
sigma = 0.01
""")
    out = tmp_path / "out.csv"
    run.ok("ensemble", path, "--out", out)
    found = rows_of(out)
    # l goes at (1/I3 - 1/I1) L, L = I3 w3, from where it is: (1 - I3/I1) w3 t
    expected = abs(1 - 1 / 2) * 0.01 * found["t"]
    error = abs(found["l_deviation"] - expected)
    assert (error <= budgets.ensemble_spreading * expected[-1]).all()


FAILING = """
[[ensemble.vary]]
kind = "uniform"
key = "body.moments[1]"
low = 1.4
high = 2.4
"""


def test_members_that_cannot_be_are_counted_and_left_out(run, ensemble, tmp_path):
    """I3 = 2.5 > I1 + I2 where I2 < 1.5."""
    path = ensemble("size = 400", vary=FAILING)
    out = tmp_path / "out.csv"
    done = run.ok("ensemble", path, "--out", out)
    failed = int(done.stdout.split("failed            ")[1].split(",")[0])
    assert 20 < failed < 60
    assert "  member " in done.stdout and "body.moments" in done.stdout
    assert (rows_of(out)["members"] == 400 - failed).all()
    member = done.stdout.split("  member ")[1].split(":")[0]
    alone = run("ensemble", path, "--member", member, "--out", tmp_path / "alone.csv")
    assert alone.returncode != 0 and "body.moments" in alone.stderr
    path.write_text(path.read_text().replace("size = 400", 'size = 400\nkeep = "final"'))
    run.ok("ensemble", path, "--out", tmp_path / "final.csv")
    final = rows_of(tmp_path / "final.csv")
    assert numpy.isnan(final["w1"]).sum() == failed
    assert (numpy.isnan(final["w1"]) == (final["body.moments[1]"] < 1.5)).all()


def test_an_event_that_stops_members_ends_their_part(run, ensemble, tmp_path):
    event = '[[event]]\nname = "end"\ncolumn = "w1"\nvalue = 0\nstops = true\n'
    for extra in (event, TORQUE + event):
        path = ensemble('size = 100\nkeep = "final"', extra=extra)
        run.ok("ensemble", path, "--out", tmp_path / "final.csv")
        ends = rows_of(tmp_path / "final.csv")["t"]
        path = ensemble("size = 100", extra=extra)
        done = run.ok("ensemble", path, "--out", tmp_path / "s.csv")
        found = rows_of(tmp_path / "s.csv")
        assert found["members"][-1] == 0
        assert "  w1              no members\n" in done.stdout and "nan" not in done.stdout
        assert len(set(ends)) > 10
        assert [(ends >= t).sum() for t in found["t"]] == found["members"].tolist()


def test_a_branch_that_is_noted_is_of_the_files_own_run(run, ensemble, tmp_path):
    path = ensemble('size = 3\nkeep = "final"', columns='"sadov", "andoyer"')
    run.ok("ensemble", path, "--out", tmp_path / "final.csv")
    notes = [line for line in (tmp_path / "final.csv").read_text().splitlines() if "sadov" in line]
    assert "# sadov: region" in notes[0] and "is that of the file's own run" in notes[1]


def test_an_ensemble_of_spin_axes(run, tmp_path, root):
    text = (root / "examples/mars-obliquity.toml").read_text()
    text = text[:text.index("[time]")] + """[time]
stop = -100
step = -20
[output]
columns = ["obliquity", "precession"]
[ensemble]
size = 12
keep = "final"
[[ensemble.vary]]
kind = "normal"
key = "planet.pole.dec"
sigma = 0.5
"""
    path = tmp_path / "mars.toml"
    path.write_text(text)
    marks = set()
    for threads in (1, 3):
        out = tmp_path / f"{threads}.csv"
        run.ok("ensemble", path, "--out", out, "--threads", threads)
        marks.add(mark(out))
    assert len(marks) == 1 and len(set(rows_of(out)["obliquity"])) == 12
    alone = tmp_path / "alone.csv"
    run.ok("ensemble", path, "--member", 5, "--out", alone)
    assert rows_of(alone)["obliquity"][-1] == rows_of(out)["obliquity"][5]


def one(kind, keys, more=""):
    key = f'key = "{keys}"' if isinstance(keys, str) else f"keys = {keys}".replace("'", '"')
    return f'[[ensemble.vary]]\nkind = "{kind}"\n{key}\n{more}\n'


OMEGA = "state.attitude-rate.omega_body"
REFUSED = [
    ("size = 0", one("normal", OMEGA + "[0]", "sigma = 1"),
     ":15:8: ensemble.size: got 0; expected a whole number from 1 to 1e12"),
    ("size = 5\nseed = -1", one("normal", OMEGA + "[0]", "sigma = 1"),
     "ensemble.seed: got -1; expected a whole number from 0"),
    ("size = 5\nchunk = 0", one("normal", OMEGA + "[0]", "sigma = 1"),
     "ensemble.chunk: got 0; expected a whole number from 1 to 1e6"),
    ("size = 5\nquantiles = [0.5, 0.4]", one("normal", OMEGA + "[0]", "sigma = 1"),
     "ensemble.quantiles: got [0.5, 0.4]; expected numbers from 0 to 1, each above"),
    ("size = 5", "", "ensemble.vary: got nothing; expected tables [[vary]]"),
    ("size = 5", one("normal", "state.attitude-rate.omega_bdy[0]", "sigma = 1"),
     'ensemble.vary[0].key: got "state.attitude-rate.omega_bdy[0]"; expected a key that holds a '
     "number and stands in this file or has a fallback, such as state.euler.theta or "
     "body.moments[1]; did you mean state.attitude-rate.omega_body[0]?"),
    ("size = 5", one("normal", OMEGA, "sigma = 1"), "did you mean " + OMEGA + "[0]?"),
    ("size = 5", one("normal", "time.stop", "sigma = 1"), "expected no key of [time]"),
    ("size = 5", one("normal", "ensemble.size", "sigma = 1"), "expected a key that holds"),
    ("size = 5", one("normal", OMEGA + "[0]", "sigma = 1") * 2,
     "ensemble.vary[1].key: got \"" + OMEGA + "[0]\"; expected keys that no other table varies; "
     + OMEGA + "[0] comes twice"),
    ("size = 5", one("normal", OMEGA + "[0]", "sigma = -1"),
     "ensemble.vary[0].sigma: got -1; expected a number that is not negative"),
    ("size = 5", one("normal", OMEGA + "[0]", "sigma = 1\nlow = 3\nhigh = 2"),
     "ensemble.vary[0].low: got 3; "),
    ("size = 5", one("normal", OMEGA + "[0]", "mean = 1\nsigma = 0\nlow = 2"),
     "ensemble.vary[0].low: got 2; "),
    ("size = 5", one("uniform", OMEGA + "[0]", "low = 3\nhigh = 2"),
     "ensemble.vary[0].low: got 3; "),
    ("size = 5", one("uniform", OMEGA + "[0]", "low = 3"), "ensemble.vary[0].high: got nothing"),
    ("size = 5", one("log-uniform", OMEGA + "[0]", "low = -3\nhigh = 2"),
     "ensemble.vary[0].low: got -3; "),
    ("size = 5", one("joint-normal", [OMEGA], "covariance = [[1, 2, 0], [2, 1, 0], [0, 0, 1]]"),
     "ensemble.vary[0].covariance: got [[1, 2, 0], [2, 1, 0], [0, 0, 1]]; "),
    ("size = 5", one("joint-normal", [OMEGA], "covariance = [[1, 0], [0, 1]]"),
     "expected 3 rows of 3 numbers, one for each of keys"),
    ("size = 5", one("joint-normal", [OMEGA], "covariance = [[1, 0], [0, 1, 2]]"),
     "expected a square matrix, [[a, b], [b, c]]"),
    ("size = 5", one("joint-normal", [OMEGA + "[7]"], "covariance = [[1]]"),
     OMEGA + "[7] is none"),
    ("size = 5", one("direction", [OMEGA + "[0]", OMEGA + "[1]"]),
     "expected three components of a vector, or two angles"),
    ("size = 5", one("attitude", [OMEGA]), "expected the four components of a quaternion"),
    ("size = 5", one("grid", OMEGA + "[0]", "from = 0\nto = 1\ncount = 0"),
     "ensemble.vary[0].count: got 0; "),
    ("size = 5", one("table", [OMEGA], 'file = "none.csv"'), "none.csv"),
    ("size = 5", one("table", [OMEGA], 'file = "three.csv"'),
     "ensemble.size: got 5; expected at most 3, the rows of the shortest table"),
    ("size = 5", one("table", [OMEGA], 'file = "three.csv"\ncolumns = ["a", "b"]'),
     "expected 3 columns, one for each of keys"),
    ("size = 5", one("table", [OMEGA], 'file = "three.csv"\ncolumns = ["a", "b", "x"]'), "x"),
    ("size = 5", one("cauchy", OMEGA + "[0]"), "ensemble.vary[0].kind: got \"cauchy\"; expected"),
    ("size = 5\nkeep = \"all\"", one("normal", OMEGA + "[0]", "sigma = 1"), "ensemble.keep: got"),
]


@pytest.mark.parametrize(("head", "vary", "message"), REFUSED)
def test_what_is_no_ensemble_is_refused_at_its_place(run, ensemble, tmp_path, head, vary, message):
    (tmp_path / "three.csv").write_text("a,b,c\n1,2,3\n4,5,6\n7,8,9\n")
    path = ensemble(head, vary=vary)
    done = run("ensemble", path, "--out", tmp_path / "out.csv")
    assert done.returncode != 0 and message in done.stderr, done.stderr
    assert done.stderr.startswith("polhode") or "body.toml:" in done.stderr
    assert not (tmp_path / "out.csv").exists()


def test_other_things_that_are_refused(run, scenario, ensemble, tmp_path):
    done = run("ensemble", scenario())
    assert "ensemble: got nothing; expected a table [ensemble]" in done.stderr
    path = ensemble("size = 5")
    done = run("ensemble", path, "--member", 5)
    assert done.returncode != 0 and "got member 5; expected 0 to 4" in done.stderr
    done = run("ensemble", path, "--member", -1)
    assert 'got "-1"; expected the index of a member, 0 or more' in done.stderr
    assert "named twice" in run("ensemble", path, "--out", "a.csv", "--out", "a.csv").stderr
    done = run("ensemble", path, "--out", tmp_path / "out.aem")
    assert done.returncode == 2
    assert "out.aem: an AEM holds one motion; expected PATH.csv or PATH.h5" in done.stderr


def test_tables_grids_and_directions(run, ensemble, tmp_path):
    (tmp_path / "draws.csv").write_text("x,y\n" + "".join(f"{k},{-k}\n" for k in range(1, 7)))
    vary = (one("table", [OMEGA + "[0]", OMEGA + "[1]"],
                'file = "draws.csv"\ncolumns = ["y", "x"]')
            + one("grid", "body.moments[1]", "from = 1.6\nto = 2.2\ncount = 2")
            + one("direction", ["state.attitude-rate.quaternion[1]",
                                "state.attitude-rate.quaternion[2]",
                                "state.attitude-rate.quaternion[3]"])
            + one("grid", "body.moments[2]", "from = 2.3\nto = 2.5\ncount = 3"))
    path = ensemble('size = 6\nkeep = "final"', vary=vary)
    done = run("ensemble", path, "--out", tmp_path / "final.csv")
    assert "expected a vector whose length in the file is not 0" in done.stderr
    path.write_text(path.read_text().replace("[1, 0, 0, 0]", "[1, 0, 0, 2]"))
    run.ok("ensemble", path, "--out", tmp_path / "final.csv")
    found = rows_of(tmp_path / "final.csv")
    assert found[OMEGA + "[0]"].tolist() == [-1, -2, -3, -4, -5, -6]
    assert found[OMEGA + "[1]"].tolist() == [1, 2, 3, 4, 5, 6]
    assert found["body.moments[1]"].tolist() == [1.6] * 3 + [2.2] * 3
    assert found["body.moments[2]"].tolist() == [2.3, 2.4, 2.5] * 2
    vector = numpy.array([found[f"state.attitude-rate.quaternion[{k}]"] for k in (1, 2, 3)])
    assert (abs(numpy.linalg.norm(vector, axis=0) - 2) <= budgets.ensemble_statistics).all()


def test_a_pole_on_the_sky(run, root, tmp_path):
    text = (root / "examples/apophis.toml").read_text()
    path = tmp_path / "apophis.toml"
    path.write_text(text + """
[ensemble]
size = 500
keep = "final"
[[ensemble.vary]]
kind = "direction"
keys = ["state.tumbler.pole.longitude", "state.tumbler.pole.latitude"]
""")
    out = tmp_path / "out.csv"
    run.ok("ensemble", path, "--out", out)
    found = rows_of(out)
    longitude, latitude = (found[f"state.tumbler.pole.{x}"] for x in ("longitude", "latitude"))
    assert (longitude >= 0).all() and (longitude < 360).all() and longitude.std() > 80
    assert abs(numpy.sin(numpy.radians(latitude)).mean()) < 0.1
    alone = run("ensemble", path, "--member", 3)
    assert "longitude = " in alone.stdout and "[ensemble]" not in alone.stdout


# A limit on the size of files stands for a full disk.
@pytest.mark.parametrize("keep", ["rows", "final"])
def test_a_disk_that_fills_up_keeps_the_members(polhode, run, ensemble, tmp_path, keep):
    path = ensemble(f'size = 600\nkeep = "{keep}"', extra=TORQUE)
    whole, out = tmp_path / "whole.csv", tmp_path / "m.csv"
    run.ok("ensemble", path, "--out", whole)
    assert whole.stat().st_size > 64 * 1024
    for kilobytes, status in ((32, 1), (64, 1), (None, 0)):
        limit = f"ulimit -f {kilobytes}; exec \"$@\"" if kilobytes else "exec \"$@\""
        done = subprocess.run(
            ["bash", "-c", limit, "bash", polhode, "ensemble", path, "--out", out, "--resume",
             "--checkpoint", "0"], text=True, capture_output=True)
        assert done.returncode == status, done.stderr
        if status:
            line = done.stderr.splitlines()[-1]
            assert ": cannot be written: File too large; raise the " in line
    assert out.read_bytes() == whole.read_bytes()


def test_draws_that_are_others_do_not_go_on(polhode, run, ensemble, tmp_path):
    draws, out = tmp_path / "draws.csv", tmp_path / "m.csv"
    draws.write_text("x\n" + "".join(f"{1 + k / 1e6}\n" for k in range(100000)))
    path = ensemble("size = 100000\nchunk = 10", vary=one("table", [OMEGA + "[2]"],
                                                          'file = "draws.csv"'),
                    extra=TORQUE, time="stop = 400\nstep = 4")
    process = subprocess.Popen([polhode, "ensemble", path, "--out", out, "--checkpoint", "0"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    checkpoint = tmp_path / "m.csv.checkpoint"
    until = time.monotonic() + SECONDS
    while not checkpoint.exists() and time.monotonic() < until:
        time.sleep(0.02)
    process.kill()
    process.wait()
    draws.write_text(draws.read_text().replace("1.000001\n", "1.000002\n"))
    assert "is of another ensemble: files of the scenario" in run.rejected("ensemble", path,
                                                                           "--out", out, "--resume")


@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_a_complete_run_is_no_complete_ensemble(run, ensemble, tmp_path, extension):
    path, out = ensemble("size = 10"), tmp_path / f"a.{extension}"
    for first, second in (("run", "ensemble"), ("ensemble", "run")):
        run.ok(first, path, "--out", out, "--restart")
        before = out.read_bytes()
        assert "is there, of another run" in run.rejected(second, path, "--out", out, "--resume")
        assert out.read_bytes() == before
        assert "nothing to do" in run(first, path, "--out", out, "--resume").stdout
