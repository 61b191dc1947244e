# SPDX-License-Identifier: MIT
"""What `polhode ensemble` says of members that fail, of angles, and of what it does not take."""

import h5py
import numpy
import pytest
from ensemble_files import rows_of

MOMENT, OMEGA = "body.moments[1]", "state.attitude-rate.omega_body"
# I3 = 2.5 is more than I1 + I2 where I2 < 1.5
SOME_FAIL = f'[[ensemble.vary]]\nkind = "uniform"\nkey = "{MOMENT}"\nlow = 1.4\nhigh = 2.4\n'
ALL_FAIL = f'[[ensemble.vary]]\nkind = "uniform"\nkey = "{MOMENT}"\nlow = 0.5\nhigh = 1.4\n'
HISTOGRAM = f'[[ensemble.histogram]]\nname = "shapes"\ncolumns = ["{MOMENT}"]\n'
FRACTION = '[[ensemble.fraction]]\nname = "low"\ncolumn = "w1"\nlow = 0\n'


@pytest.mark.parametrize("keep", ["statistics", "final", "rows"])
def test_an_ensemble_of_which_nobody_is_left_ends_with_an_error(run, ensemble, tmp_path, keep):
    path = ensemble(f'size = 12\nkeep = "{keep}"', vary=ALL_FAIL, columns='"q", "tumbler"')
    out, table = tmp_path / "out.csv", tmp_path / "out.h5"
    done = run("ensemble", path, "--out", out, "--out", table)
    assert done.returncode == 1 and done.stdout == ""
    assert "all 12 members failed, so that there are no results\n  member 0: " in done.stderr
    assert done.stderr.count("  member ") == 3 and "body.moments" in done.stderr
    assert "nan" not in done.stderr and not out.exists() and not table.exists()
    assert not list(tmp_path.glob("*.checkpoint"))
    printed = run("ensemble", path)
    assert printed.returncode == 1 and "-nan" not in printed.stdout
    run.ok("ensemble", path, "--set", "body.moments=[1, 2, 2.5]", "--set",
           "ensemble.vary.0.low=1.6", "--set", "ensemble.vary.0.high=2", "--out", out)


@pytest.mark.parametrize("keep", ["statistics", "final", "rows"])
def test_a_file_says_which_members_failed_and_why(run, ensemble, tmp_path, keep):
    path = ensemble(f'size = 60\nkeep = "{keep}"\nchunk = 7', vary=SOME_FAIL)
    out, table = tmp_path / "out.csv", tmp_path / "out.h5"
    done = run.ok("ensemble", path, "--out", out, "--out", table)
    failed = int(done.stdout.split("failed            ")[1].split(",")[0])
    said = [line[10:] for line in out.read_text().splitlines() if line.startswith("# failed: ")]
    assert said[0] == f"{failed} of 60 members" and len(said) == 1 + (failed if failed < 20 else 20)
    assert all("member " in line and "body.moments" in line for line in said[1:])
    with h5py.File(table) as file:
        assert list(file.attrs["failed"]) == said
        names = [name for group in file.attrs["groups"] for name in file[group].attrs["columns"]]
    assert names == list(rows_of(out))
    one = run("ensemble", path, "--member", said[1].split(":")[0][7:], "--out", tmp_path / "a.csv")
    assert one.returncode != 0 and "body.moments" in one.stderr
    one_thread = tmp_path / "again.csv"
    run.ok("ensemble", path, "--out", one_thread, "--threads", 1)
    assert one_thread.read_bytes() == out.read_bytes()


def test_files_of_chunks_say_who_failed_in_them(run, ensemble, tmp_path):
    path = ensemble('size = 40\nkeep = "final"\nchunk = 10', vary=SOME_FAIL)
    run.ok("ensemble", path, "--out", tmp_path / "e-{chunk}.csv")
    index = rows_of(tmp_path / "e-index.csv")
    for k, failed in enumerate(index["failed"]):
        text = (tmp_path / f"e-{k}.csv").read_text()
        assert (f"# failed: {failed:.0f} of 10 members\n" in text) == (failed > 0)
    assert f"# failed: {index['failed'].sum():.0f} of 40" in (tmp_path / "e-index.csv").read_text()


def test_columns_without_numbers_are_not_shown_as_nan(run, ensemble, tmp_path):
    """A long-axis rotor has no psi_max."""
    state = "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [1, 0.1, 0.1]"
    vary = f'[[ensemble.vary]]\nkind = "normal"\nkey = "{OMEGA}[0]"\nsigma = 0.01\n'
    path = ensemble("size = 9", vary=vary, state=state,
                    columns='"q", "omega", "andoyer", "energy", "tumbler"')
    done = run.ok("ensemble", path, "--out", tmp_path / "out.csv")
    assert "nan" not in done.stdout
    assert "  mode            0 SAM, 1 LAM, 0 others\n" in done.stdout  # behind 12 columns
    few = run("ensemble", path, "--set", "ensemble.size=1", "--set",
              'output.columns=["tumbler"]', "--out", tmp_path / "few.csv")
    assert "  psi_max         no members\n" in few.stdout and "of one member" in few.stdout
    assert "nan" not in few.stdout


def test_what_another_keep_leaves_out_is_said(run, ensemble, tmp_path):
    path = ensemble('size = 4\nkeep = "final"', vary=SOME_FAIL + HISTOGRAM + FRACTION)
    done = run.ok("ensemble", path, "--out", tmp_path / "out.csv")
    for table in ("histogram", "fraction"):
        assert (f'body.toml: note: [[ensemble.{table}]] is left out: it goes with keep = '
                '"statistics", and this is keep = "final"\n') in done.stderr
    done = run("ensemble", path, "--set", 'ensemble.keep="statistics"', "--out",
               tmp_path / "all.csv")
    assert done.returncode == 0 and "note" not in done.stderr
    assert (tmp_path / "all.shapes.csv").exists()


def test_a_direction_goes_by_the_names_of_its_angles(run, root, tmp_path):
    text = (root / "examples/apophis.toml").read_text()
    path, out = tmp_path / "apophis.toml", tmp_path / "out.csv"
    sky = [f"state.tumbler.pole.{end}" for end in ("longitude", "latitude")]
    for keys in (sky, sky[::-1]):
        path.write_text(text + '\n[ensemble]\nsize = 400\nkeep = "final"\n[[ensemble.vary]]\n'
                        f'kind = "direction"\nkeys = ["{keys[0]}", "{keys[1]}"]\n')
        run.ok("ensemble", path, "--out", out)
        found = rows_of(out)
        assert (abs(found[sky[1]]) <= 90).all() and found[sky[1]].min() < -60
        assert (found[sky[0]] >= 0).all() and found[sky[0]].max() > 300
        assert list(found)[1:3] == keys
    path.write_text(path.read_text().replace(sky[0], "state.tumbler.phi0"))
    text = path.read_text().replace(sky[1], "state.tumbler.psi0")
    path.write_text(text)
    done = run("ensemble", path, "--out", out)
    assert done.returncode == 2 and "expected a longitude, ra or node and a latitude" in done.stderr


NODE, INCLINATION = "orbit.sun.node", "orbit.sun.inclination"


def test_planes_of_orbits_lie_every_way(run, ensemble, tmp_path):
    orbit = ('[orbit.sun]\nkind = "kepler"\ngm = 1\nsemi_major_axis = 9\n'
             'inclination = "0.3 rad"\nnode = "0 rad"\n')
    for keys in ((NODE, INCLINATION), (INCLINATION, NODE)):
        vary = f'[[ensemble.vary]]\nkind = "direction"\nkeys = ["{keys[0]}", "{keys[1]}"]\n'
        path = ensemble('size = 400\nkeep = "final"', vary=vary, extra=orbit)
        run.ok("ensemble", path, "--out", tmp_path / "out.csv")
        tilt = rows_of(tmp_path / "out.csv")[INCLINATION]
        assert (tilt >= 0).all() and (tilt <= numpy.pi).all()
        assert abs(numpy.cos(tilt).mean()) < 0.15 and (tilt > numpy.pi / 2).mean() > 0.4


SPREAD = f'[[ensemble.vary]]\nkind = "normal"\nkey = "{OMEGA}[2]"\n'


@pytest.mark.parametrize(("vary", "message"), [
    (SPREAD + 'sigma = "1 h"',
     'sigma: got "1 h"; expected a number in the unit of the key that varies'),
    (SPREAD + "sigma = 1\nlow = 100", "low: got 100; low 100 must be at most 37 sigma above"),
    (f'[[ensemble.vary]]\nkind = "joint-normal"\nkeys = ["{OMEGA}[0]", "{OMEGA}[1]"]\n'
     "covariance = [[1, 2], [3, 4]]", "covariance: got [[1, 2], [3, 4]]; covariance[0][1] = 2"),
    (f'[[ensemble.vary]]\nkind = "joint-normal"\nkeys = ["{OMEGA}[0]", "{OMEGA}[1]"]\n'
     "covariance = [1, 2]", "expected a square matrix, [[a, b], [b, c]]"),
    (f'[[ensemble.vary]]\nkind = "grid"\nkey = "{OMEGA}[0]"\nfrom = 0\nto = 1\ncount = 0',
     "count: got 0; count 0 must be 1 or more"),
    ('[[ensemble.vary]]\nkind = "uniform"\nkey = "ensemble.seed"\nlow = 0\nhigh = 1',
     "ensemble.seed cannot vary"),
    ('[[ensemble.vary]]\nkind = "uniform"\nkey = "schema"\nlow = 0\nhigh = 1',
     "schema cannot vary"),
    ('[[ensemble.vary]]\nkind = "uniform"\nkey = "title"\nlow = 0\nhigh = 1',
     "title cannot vary: make a file for each of its values"),
])
def test_messages_are_sentences_about_the_file(run, ensemble, tmp_path, vary, message):
    done = run("ensemble", ensemble("size = 5", vary=vary), "--out", tmp_path / "out.csv")
    assert done.returncode == 2 and message in done.stderr, done.stderr
    assert not any(name in done.stderr for name in ("Normal:", "DrawGrid", "Uniform:"))


def test_the_branch_of_a_tumbler_does_not_vary(run, root):
    done = run("ensemble", root / "examples/apophis-ensemble.toml", "--set",
               'ensemble.vary.0.key="state.tumbler.branch"')
    assert done.returncode == 2
    assert "state.tumbler.branch cannot vary: make a file for each of its values" in done.stderr


def test_options_that_would_do_nothing_are_refused(run, ensemble, tmp_path):
    path = ensemble("size = 5")
    for more in (["--resume"], ["--restart"], ["--resume", "--out", tmp_path / "m.toml"]):
        done = run("ensemble", path, "--member", 3, *more)
        assert done.returncode == 2 and done.stdout == ""
        assert "which has nothing to go on from" in done.stderr
    done = run("ensemble", path, "--out", tmp_path / "x.txt")
    assert done.returncode == 2 and "expected .csv or .h5, or - for CSV" in done.stderr
    assert ".aem" not in done.stderr
