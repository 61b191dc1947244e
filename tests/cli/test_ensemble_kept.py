# SPDX-License-Identifier: MIT
"""What `polhode ensemble` keeps beside the statistics of columns: first events, held against those
of members that run alone, and fractions, against NumPy's of the rows."""

import itertools
import math

import budgets
import numpy
import pytest
from ensemble_files import TORQUE, VARY, mark, rows_of

EVENTS = """
[[event]]
name = "down"
column = "w1"
crossing = "falling"
[[event]]
name = "end"
column = "w2"
value = 0.19
stops = true
[[event]]
name = "never"
column = "w2"
value = 19
"""


def kept(run, ensemble, tmp_path, keep, size=200, **parts):
    """The rows of an ensemble, the same from one and from three threads, and what was printed."""
    path = ensemble(f'size = {size}\nchunk = 30\nkeep = "{keep}"', **parts)
    marks = set()
    for threads in (1, 3):
        out = tmp_path / f"{keep}{threads}.csv"
        done = run.ok("ensemble", path, "--out", out, "--threads", threads)
        marks.add(mark(out))
    assert len(marks) == 1
    return rows_of(out), done.stdout


def first_times(run, toml, tmp_path):
    """Of a run alone: the first time of each event, and its last row."""
    out, events = tmp_path / "alone.csv", tmp_path / "events.csv"
    run.ok("run", toml, "--out", out, "--events", events)
    times = {}
    for line in events.read_text().splitlines():
        name, t = line.split(",")[:2] if not line.startswith("#") else ("name", "t")
        if name != "name":
            times.setdefault(name, float(t))
    return times, rows_of(out)


def test_first_times_are_those_of_the_members_alone(run, ensemble, tmp_path):
    """Also those between the last row and `stop`, which stand in the last row."""
    for extra, span in itertools.product((EVENTS, TORQUE + EVENTS),
                                         ("stop = 4\nstep = 0.5", "stop = 3.9\nstep = 1.5")):
        parts = {"extra": extra, "time": span}
        final, _ = kept(run, ensemble, tmp_path, "final", size=60, **parts)
        rows, _ = kept(run, ensemble, tmp_path, "rows", size=60, **parts)
        path = ensemble("size = 60", **parts)
        for member in (0, 7, 23):
            toml = tmp_path / "member.toml"
            run.ok("ensemble", path, "--member", member, "--out", toml)
            times, alone = first_times(run, toml, tmp_path)
            here = rows["member"] == member
            assert (rows["w1"][here] == alone["w1"]).all()
            for name in ("down", "end", "never"):
                t = times.get(name, math.inf)
                known = final[f"{name}_first"][member]
                assert known == t if name in times else math.isnan(known)
                expected = numpy.where(alone["t"] >= t, t, math.nan)
                expected[-1] = t if name in times else math.nan
                numpy.testing.assert_array_equal(rows[f"{name}_first"][here], expected)


def test_a_member_alone_has_what_the_ensemble_keeps_of_it(run, ensemble, tmp_path):
    vary = VARY.replace("[[", 'indicators = ["mean_megno", "lyapunov"]\n[[', 1)
    parts = {"extra": TORQUE + EVENTS, "vary": vary, "time": "stop = 4\nstep = 0.5"}
    rows, _ = kept(run, ensemble, tmp_path, "rows", size=20, **parts)
    path, out = ensemble("size = 20", **parts), tmp_path / "alone.csv"
    for member in (3, 11):
        run.ok("ensemble", path, "--member", member, "--out", out)
        alone, here = rows_of(out), rows["member"] == member
        assert list(alone) == list(rows)[1:] and "down_first" in alone and "lyapunov" in alone
        for name, column in alone.items():
            numpy.testing.assert_array_equal(column, rows[name][here])
    done = run("ensemble", path, "--member", 11, "--out", out, "--resume")
    assert done.returncode == 0 and "nothing to do" in done.stdout
    assert "alone.csv: is there" in run.rejected("ensemble", path, "--member", 3, "--out", out,
                                                 "--resume")


def test_parts_count_members_that_an_event_has_stopped(run, ensemble, tmp_path):
    for time in ("stop = 4\nstep = 0.5", "stop = -4\nstep = -0.5"):
        final, _ = kept(run, ensemble, tmp_path, "final", extra=EVENTS, time=time)
        found, text = kept(run, ensemble, tmp_path, "statistics", extra=EVENTS, time=time)
        sign = math.copysign(1, found["t"][-1])
        for name in ("down", "end", "never"):
            first = sign * final[f"{name}_first"]
            expected = [(first <= sign * t).mean() for t in found["t"]]
            assert found[f"{name}_part"].tolist() == expected
            assert f"{name}_mean" not in found and f"{name}_first_mean" not in found
        ended = sorted(sign * final["end_first"])
        assert found["end_part"][-1] > 0.3
        by = text.split("event             end: part ")[1].splitlines()[0].split(", ")
        assert by[0] == f"{found['end_part'][-1]:.4g} of the members"
        assert by[1] == f"0.05 by {sign * ended[9]:.10g} s"
        assert "event             never: part 0 of the members\n" in text


def test_members_that_fail_are_no_part_of_any(run, ensemble, tmp_path):
    vary = """
[[ensemble.vary]]
kind = "uniform"
key = "body.moments[1]"
low = 1.4
high = 2.4
"""
    final, _ = kept(run, ensemble, tmp_path, "final", extra=EVENTS, vary=vary)
    found, _ = kept(run, ensemble, tmp_path, "statistics", extra=EVENTS, vary=vary)
    went = ~numpy.isnan(final["t"])
    assert 0 < (~went).sum() < 50
    assert found["down_part"][-1] == numpy.isfinite(final["down_first"][went]).mean()


FRACTIONS = """
[[ensemble.fraction]]
name = "fast"
column = "w3"
low = 1
[[ensemble.fraction]]
name = "band"
column = "w1"
low = -0.05
high = 0.05
[[ensemble.fraction]]
name = "around"
column = "g"
low = 150
high = 210
[[ensemble.fraction]]
name = "upper"
column = "l"
high = 0
[[ensemble.fraction]]
name = "early"
column = "down_first"
high = 1
[[ensemble.fraction]]
name = "short"
column = "mode"
low = 0.5
high = 1.5
"""


def test_fractions_are_those_of_the_rows(run, ensemble, tmp_path):
    parts = {"columns": '"omega", "andoyer", "tumbler"', "time": "stop = 40\nstep = 4",
             "vary": FRACTIONS + VARY, "extra": EVENTS.split("[[event]]\nname = \"end\"")[0],
             "body": "moments = [1, 2, 2.5]\n[units]\nangle = \"deg\"\ntime = \"s\""}
    rows, _ = kept(run, ensemble, tmp_path, "rows", **parts)
    found, text = kept(run, ensemble, tmp_path, "statistics", **parts)
    some = set()
    for k, t in enumerate(found["t"]):
        here = {name: column[rows["t"] == t] for name, column in rows.items()}
        first = here["down_first"]
        expected = {"fast": here["w3"] >= 1, "band": abs(here["w1"]) < 0.05,
                    "around": numpy.cos(numpy.radians(here["g"] - 180)) > numpy.cos(numpy.pi / 6),
                    "upper": here["l"] < 0, "early": (first < 1)[~numpy.isnan(first)],
                    "short": here["mode"] == 1}
        for name, within in expected.items():
            assert found[f"{name}_members"][k] == len(within)
            if len(within) > 0:
                assert found[f"{name}_part"][k] == within.mean()
            some.add(name if len(within) > 0 and 0.05 < within.mean() < 0.95 else "")
    assert some >= {"fast", "band", "around", "upper"}
    last = f"{found['band_part'][-1]:.4g} of 200 members\n"
    assert f"  band_part       {last}" in text


CHAOS = """
[[perturbation]]
kind = "gravity-gradient"
orbit = "saturn"
[orbit.saturn]
gm = "37931207.7 km3/s2"
semi_major_axis = 1480795.441
eccentricity = 0.1
"""
HYPERION = {"body": 'moments = [34021, 49096, 57125]\n[units]\ntime = "d"\nangle = "deg"\n'
                    'length = "km"',
            "state": "[state.attitude-rate]\neuler = { phi = 0, theta = 0, psi = 0 }\n"
                     "omega_body = [0, 0, 22]",
            "columns": '"omega"'}
GRID = """key = "state.attitude-rate.omega_body[2]"
from = 5
to = 50
count = 4
"""


def test_indicators_are_those_of_a_map(run, ensemble, scenario, tmp_path):
    parts = {"extra": CHAOS, "time": "stop = 400\ncount = 9", **HYPERION}
    path = scenario(**{key: part for key, part in parts.items() if key != "extra"})
    path.write_text(path.read_text() + CHAOS + '[map]\nkind = "chaos"\n[[map.axis]]\n' + GRID)
    run.ok("map", path, "--out", tmp_path / "map.csv")
    cells = rows_of(tmp_path / "map.csv")
    names = ("lyapunov", "mean_megno")
    vary = 'indicators = ["lyapunov", "mean_megno"]\n[[ensemble.vary]]\nkind = "grid"\n' + GRID
    chaotic = '[[ensemble.fraction]]\nname = "chaotic"\ncolumn = "mean_megno"\nlow = 3\n'
    final, _ = kept(run, ensemble, tmp_path, "final", size=4, vary=vary, **parts)
    assert list(final)[-2:] == list(names)
    for name in names:
        assert (final[name] == cells[name]).all()
    assert final["mean_megno"].max() > 3 > final["mean_megno"].min()
    rows, _ = kept(run, ensemble, tmp_path, "rows", size=4, vary=vary, **parts)
    found, _ = kept(run, ensemble, tmp_path, "statistics", size=4, vary=vary + chaotic, **parts)
    for k, t in enumerate(found["t"]):
        megno = rows["mean_megno"][rows["t"] == t]
        assert found["mean_megno_least"][k] == megno.min()
        assert found["chaotic_part"][k] == (megno >= 3).mean()


def test_indicators_end_where_an_event_stops_the_run(run, ensemble, tmp_path):
    vary = VARY.replace("[[", 'indicators = ["mean_megno"]\n[[', 1)
    for extra in (EVENTS, TORQUE + EVENTS):
        parts = {"extra": extra, "vary": vary, "time": "stop = 4\nstep = 0.5"}
        rows, _ = kept(run, ensemble, tmp_path, "rows", size=20, **parts)
        final, _ = kept(run, ensemble, tmp_path, "final", size=20, **parts)
        for member in range(20):
            here = rows["member"] == member
            assert numpy.isfinite(rows["mean_megno"][here]).all()
            assert rows["mean_megno"][here][-1] == final["mean_megno"][member]
        assert rows["mean_megno"][rows["t"] == 0].tolist() == [0] * 20
        assert len(set(final["t"])) > 3


def fraction(**keys):
    lines = [f"{key} = {value!r}".replace("'", '"') for key, value in keys.items()]
    return "[[ensemble.fraction]]\n" + "\n".join(lines) + "\n"


REFUSED = [
    (fraction(name="a", column="w4", low=1),
     'ensemble.fraction[0].column: got "w4"; expected a column of [output] columns; w4 is none'),
    (fraction(name="a", column="t", low=1), "; t is none"),
    (fraction(name="a", column="body.moments[1]", low=1), "body.moments[1] is none"),
    (fraction(name="a", column="w3"), "ensemble.fraction[0]: expected low, high or both"),
    (fraction(name="a", column="w3", low=2, high=2),
     "ensemble.fraction[0].low: got 2; expected less than high"),
    (fraction(name="a", column="w3", low=2) * 2,
     'ensemble.fraction[1].name: got "a"; expected a name of its own'),
    (fraction(name="down", column="w3", low=2),
     'ensemble.fraction[0].name: got "down"; expected a name of its own, since an event has'),
    (fraction(name="w3", column="w3", low=2),
     'ensemble.fraction[0].name: got "w3"; expected a name of its own, since a column has'),
    (fraction(name="a b", column="w3", low=2), 'ensemble.fraction[0].name: got "a b"; expected'),
    (fraction(column="w3", low=2), "ensemble.fraction[0].name: got nothing; expected"),
    (fraction(name="a", column="w3", low="nan"), "ensemble.fraction[0].low: got "),
]


def test_where_there_are_no_indicators(run, ensemble, tmp_path, root):
    vary = VARY.replace("[[", 'indicators = ["mean_megno"]\n[[', 1)
    for parts, message in (
            ({"time": "start = -2\nstop = 4\nstep = 1"}, "or rows on one side of t = 0, where"),
            ({"time": "at = [0, 2, 1]"}, "or times in order, away from t = 0"),
            ({"extra": '[[perturbation]]\nkind = "kane-damper"\nsphere_moment = 0.1\n'
                       'friction = 0.1\n'},
             "since the state of a Kane damper has no indicator of chaos")):
        done = run("ensemble", ensemble("size = 5", vary=vary, **parts))
        assert done.returncode == 2 and message in done.stderr, done.stderr
        assert 'ensemble.indicators: got ["mean_megno"]; expected no indicators' in done.stderr
    path = ensemble("size = 5", vary=vary.replace("mean_megno", "megno"))
    assert 'ensemble.indicators: got "megno"; expected' in run("ensemble", path).stderr
    text = (root / "examples/mars-obliquity.toml").read_text()
    path = tmp_path / "mars.toml"
    path.write_text(text + "[ensemble]\nsize = 3\nindicators = [\"lyapunov\"]\n"
                    "[[ensemble.vary]]\nkind = \"normal\"\nkey = \"planet.pole.dec\"\nsigma = 1\n")
    assert 'those of a file of kind "rotation"' in run("ensemble", path).stderr


@pytest.mark.parametrize(("tables", "message"), REFUSED)
def test_what_cannot_be_kept_is_refused_at_its_place(run, ensemble, tmp_path, tables, message):
    path = ensemble("size = 5", vary=tables + VARY, extra=EVENTS)
    done = run("ensemble", path, "--out", tmp_path / "out.csv")
    assert done.returncode == 2 and message in done.stderr, done.stderr
    assert "body.toml:" in done.stderr and not (tmp_path / "out.csv").exists()


def test_statistics_of_the_obliquity_of_mars(run, tmp_path, root):
    text = (root / "examples/mars-obliquity.toml").read_text()
    text = text[:text.index("[time]")] + """[time]
at = [-10, -40, -70]
[output]
columns = ["obliquity", "precession"]
[ensemble]
size = 12
keep = "rows"
[[ensemble.fraction]]
name = "steep"
column = "obliquity"
low = 24
[[ensemble.histogram]]
name = "obliquity"
columns = ["planet.pole.dec", "obliquity"]
bins = 3
times = "all"
[[ensemble.vary]]
kind = "normal"
key = "planet.pole.dec"
sigma = 3
"""
    path, out = tmp_path / "mars.toml", tmp_path / "out.csv"
    path.write_text(text)
    run.ok("ensemble", path, "--out", tmp_path / "rows.csv")
    run.ok("ensemble", path, "--set", "ensemble.keep=statistics", "--out", out)
    rows, found, table = (rows_of(tmp_path / name)
                          for name in ("rows.csv", "out.csv", "out.obliquity.csv"))
    assert found["t"].tolist() == [-10, -40, -70]
    for k, t in enumerate(found["t"]):
        x = rows["obliquity"][rows["t"] == t]
        assert (found["obliquity_least"][k], found["obliquity_greatest"][k]) == (x.min(), x.max())
        assert abs(found["obliquity_mean"][k] - x.mean()) <= budgets.ensemble_statistics * x.max()
        assert found["steep_part"][k] == (x >= 24).mean()
        here = table["t"] == t
        assert here.sum() == 25 and table["members"][here].sum() == 12
        assert table["obliquity_high"][here].max() == numpy.inf
        assert numpy.unique(table["obliquity_low"][here])[[1, -1]].tolist() == [x.min(), x.max()]
    assert 0 < found["steep_part"][-1] < 1
