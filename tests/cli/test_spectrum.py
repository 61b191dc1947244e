# SPDX-License-Identifier: MIT
"""`polhode spectrum`. Oracle: sums of lines that are known."""

import math

import budgets
import pytest

LINES = [(0.31, 2.0, 0.4), (0.73, 0.5, -1.0)]


def signal(t):
    return 3.0 + sum(a * math.cos(nu * t + phase) for nu, a, phase in LINES)


@pytest.fixture
def rows(tmp_path):
    path = tmp_path / "rows.csv"
    times = [2.0 * k for k in range(-100, 1901)]
    text = "# units: t [kyr], x [deg], y [1]\nt,x,y\n"
    text += "".join(f"{t!r},{signal(t)!r},{0.1 * math.sin(0.2 * t)!r}\n" for t in times)
    path.write_text(text, encoding="utf-8")
    return path


def test_the_lines_of_a_column(run, rows, table):
    done = run.ok("spectrum", rows, "--column", "x", "--unit", "rad/kyr", "--csv")
    names, found = table(done.stdout)
    assert names[:4] == ["frequency", "period", "amplitude", "phase"]
    for line, (nu, amplitude, phase) in zip(found, LINES, strict=True):
        assert abs(line[0] - nu) < budgets.spectrum_cli
        assert abs(line[1] - 2 * math.pi / nu) < 1e3 * budgets.spectrum_cli
        assert abs(line[2] - amplitude) < budgets.spectrum_amplitude
        assert abs(line[3] - phase) < budgets.spectrum_phase
    assert "frequency [rad/kyr], period [kyr]" in done.stdout


def test_people_get_a_table(run, rows):
    text = run("spectrum", rows, "--column", "x").stdout
    assert "mean 3 deg" in text and "frequency in arcsec/yr, period in kyr" in text
    assert f"{math.degrees(0.31 / 1000) * 3600:.10f}" in text
    assert "residual" in text


def test_a_column_with_an_imaginary_part(run, tmp_path, table):
    path = tmp_path / "z.txt"
    path.write_text("".join(f"{k} {math.cos(0.4 * k)!r} {-math.sin(0.4 * k)!r}\n"
                            for k in range(2000, 0, -1)), encoding="utf-8")
    done = run("spectrum", path, "--time", 1, "--column", 2, "--imaginary", 3, "--csv")
    found = table(done.stdout)[1]
    assert len(found) == 1 and abs(found[0][0] + 0.4) < budgets.spectrum_cli
    assert "rad per unit of t" in done.stdout


def test_close_lines_get_a_warning(run, tmp_path):
    path = tmp_path / "close.txt"
    path.write_text("t x\n" + "".join(f"{k} {math.cos(0.4 * k) + math.cos(0.42 * k)!r}\n"
                                      for k in range(1000)), encoding="utf-8")
    done = run("spectrum", path, "--column", "x", "--lines", 2)
    assert done.returncode == 0 and "* closer than 0.0" in done.stdout
    done = run("spectrum", path, "--column", "x", "--lines", 2, "--csv")
    assert "warning: spectrum: 2 lines are closer than 10 turns" in done.stderr


@pytest.mark.parametrize(("arguments", "said"), [
    (["--column", "z"], "z"),
    (["--column", "x", "--unit", "kg"], '--unit: got "kg"'),
    (["--column", "x", "--time-unit", "yr"], 'the file says "kyr"'),
    (["--column", "x", "--window", "9"], "got window 9; expected 0 to 5"),
    (["--column", "x", "--lines", "5000"], "expected 8 samples or more, and 1 to 667 lines"),
])
def test_what_is_wrong_is_named(run, rows, arguments, said):
    assert said in run.rejected("spectrum", rows, *arguments)


def test_hdf5_is_read_as_csv_is(run, tmp_path):
    path = tmp_path / "earth.toml"
    path.write_text('schema = 1\nkind = "obliquity"\nunits = { time = "kyr", angle = "deg" }\n'
                    '[planet]\nname = "earth"\norbit = "earth"\n[orbit.earth]\n'
                    'kind = "shipped"\nname = "earth"\n[time]\nstop = -500\nstep = 1\n',
                    encoding="utf-8")
    csv, h5 = tmp_path / "earth.csv", tmp_path / "earth.h5"
    run.ok("run", path, "--out", csv, "--out", h5)
    of_csv = run("spectrum", csv, "--column", "obliquity", "--lines", 3)
    of_h5 = run("spectrum", h5, "--column", "obliquity", "--lines", 3)
    assert of_csv.returncode == 0 and of_csv.stdout == of_h5.stdout
    assert "frequency in arcsec/yr, period in kyr" in of_h5.stdout
    said = run("spectrum", h5, "--column", "oblikwity").stderr
    assert "has no column oblikwity; expected climatic_precession, obliquity" in said
    assert "No such file" in run("spectrum", tmp_path / "no.h5", "--column", "x").stderr
    (tmp_path / "bad.h5").write_text("no", encoding="utf-8")
    assert "is no HDF5 file" in run("spectrum", tmp_path / "bad.h5", "--column", "x").stderr


def test_times_must_be_even(run, tmp_path):
    path = tmp_path / "uneven.txt"
    path.write_text("t x\n" + "".join(f"{k + 0.1 * (k == 7)} {k % 3}\n" for k in range(20)),
                    encoding="utf-8")
    assert "row 8: time 7.1 is not evenly spaced" in run.rejected("spectrum", path, "--column", "x",
                                                                  "--lines", 1)
    assert "expected --time-unit" in run.rejected("spectrum", path, "--column", "x", "--unit",
                                                  "deg/d")


def test_an_angle_that_jumps_is_refused(run, tmp_path):
    path = tmp_path / "angle.csv"
    path.write_text("# units: t [ka], x [deg]\nt,x\n" + "".join(
        f"{k},{(7 * k + 180) % 360 - 180}\n" for k in range(200)), encoding="utf-8")
    assert "row 27: this angle jumps by more than" in run.rejected("spectrum", path, "--column",
                                                                   "x")
    path.write_text("# units: t [ka], x [deg]\nt,x\n" + "".join(
        f"{k},{10 * math.sin(0.7 * k)!r}\n" for k in range(200)), encoding="utf-8")
    done = run("spectrum", path, "--column", "x", "--unit", "cycles/ka", "--csv")
    assert f"\n{0.7 / (2 * math.pi):.9f}" in done.stdout, done.stdout + done.stderr
    # a unit of ages shows arcseconds a year
    assert "frequency [arcsec/yr], period [ka]" in run("spectrum", path, "--column", "x",
                                                       "--csv").stdout
