# SPDX-License-Identifier: MIT
"""What `polhode run` and `info` write."""

import contextlib
import json
import os
import pty
import re
import struct
import subprocess

import budgets
import h5py
import numpy
import pytest
from closeness import assert_allclose

GROUPS = {
    "q": ["qw", "qx", "qy", "qz"], "omega": ["w1", "w2", "w3"],
    "omega_inertial": ["W1", "W2", "W3"], "g": ["g1", "g2", "g3"],
    "euler": ["phi", "theta", "psi", "Phi", "Theta", "Psi"],
    "andoyer": ["l", "g", "h", "L", "G", "H"],
    "sadov": ["phi_l", "phi_g", "phi_h", "I_l", "I_g", "I_h"],
    "serret": ["g0", "t0", "T", "h", "G", "H"],
    "q_inertial": ["Qw", "Qx", "Qy", "Qz"], "omega_rel": ["w1_rel", "w2_rel", "w3_rel"],
    "convective": ["v1", "v2", "v3"],
    "andoyer_osc": ["l_osc", "g_osc", "h_osc", "L_osc", "G_osc", "H_osc"],
    "euler_osc": ["phi_osc", "theta_osc", "psi_osc", "Phi_osc", "Theta_osc", "Psi_osc"],
    "axes": ["I_f", "h_f", "I_m", "h_m", "I_r", "h_r"],
    "axes_rel": ["I_f_rel", "h_f_rel", "I_m_rel", "h_m_rel", "I_r_rel", "h_r_rel"],
    "energy": ["E", "dE"], "pole": ["pole_lon", "pole_lat"],
    "tumbler": ["P_phi", "P_psi", "P_short", "psi_max", "mode"],
    **{f"axis{i}": [f"axis{i}_x", f"axis{i}_y", f"axis{i}_z"] for i in (1, 2, 3)},
    "roll_pitch_yaw": ["roll", "pitch", "yaw"],
}


def columns(run, table, path, *extra):
    result = run.ok("run", path, *extra)
    names, rows = table(result.stdout)
    return dict(zip(names, numpy.array(rows).T, strict=True))


@pytest.mark.parametrize("group", GROUPS)
def test_columns_have_the_names_of_the_reference(run, scenario, table, group):
    assert list(columns(run, table, scenario(columns=f'"{group}"'))) == ["t", *GROUPS[group]]


def test_every_column_is_there_once(run, scenario, table):
    for order in (list(GROUPS), list(reversed(GROUPS))):
        names = list(columns(run, table, scenario(columns=", ".join(f'"{g}"' for g in order))))
        expected = ["t"]
        for group in order:
            expected += [name for name in GROUPS[group] if name not in expected]
        assert names == expected


def test_columns_agree_with_each_other(run, scenario, table):
    groups = '"q", "omega", "omega_inertial", "g", "andoyer", "serret"'
    c = columns(run, table, scenario(columns=groups))
    moments = numpy.array([1, 2, 2.5])
    g = numpy.array([c["g1"], c["g2"], c["g3"]])
    omega = numpy.array([c["w1"], c["w2"], c["w3"]])
    assert_allclose(g, omega * moments[:, None], rtol=budgets.cli_rounding)
    assert_allclose(c["G"], numpy.sqrt((g**2).sum(0)), rtol=budgets.cli_rounding)
    assert_allclose(c["T"], (g * omega).sum(0) / 2, rtol=budgets.cli_rounding)
    assert_allclose(c["L"], g[2], rtol=budgets.cli_rounding)
    w, x, y, z = c["qw"], c["qx"], c["qy"], c["qz"]
    third = numpy.array([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)])
    inertial_3 = (third * g).sum(0)
    assert_allclose(c["H"], inertial_3, rtol=budgets.cli_rounding)
    length = numpy.sqrt(c["W1"]**2 + c["W2"]**2 + c["W3"]**2)
    assert_allclose(length, numpy.sqrt((omega**2).sum(0)), rtol=budgets.cli_rounding)
    for constant in ("g0", "t0", "T", "h", "G", "H"):
        assert_allclose(c[constant], c[constant][0], atol=budgets.cli_rounding)


def test_times_are_rounded_once(run, scenario, table):
    t = columns(run, table, scenario(time="start = 1\nstop = 101\nstep = 0.1"))["t"]
    from fractions import Fraction
    assert list(t) == [float(1 + k * Fraction(0.1)) for k in range(1001)]
    t = columns(run, table, scenario(time="stop = 1\ncount = 4"))["t"]
    assert list(t) == [0, 1 / 3, 2 / 3, 1]
    t = columns(run, table, scenario(time="at = [3, -1, \"1 min\"]"))["t"]
    assert list(t) == [3, -1, 60]


def test_units_of_outputs_are_those_of_the_file(run, tmp_path, table):
    def text(units, omega, stop):
        return (f"schema = 1\n[units]\n{units}\n[body]\nmoments = [1, 2, 2.5]\n"
                "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\n"
                f"omega_body = {omega}\n[time]\nstop = {stop}\ncount = 11\n"
                "[output]\ncolumns = [\"q\", \"omega\", \"andoyer\", \"serret\"]\n")
    si, other = tmp_path / "si.toml", tmp_path / "other.toml"
    si.write_text(text("", "[0.1, 0.2, 1]", 60), encoding="utf-8")
    other.write_text(text("time = \"min\"\nangle = \"deg\"",
                          "{ value = [0.1, 0.2, 1], unit = \"rad/s\" }", 1), encoding="utf-8")
    a, b = columns(run, table, si), columns(run, table, other)
    degree = numpy.pi / 180
    factor = {"t": 60, "w1": degree / 60, "w2": degree / 60, "w3": degree / 60, "l": degree,
              "g": degree, "h": degree, "g0": degree, "L": 1 / 60, "G": 1 / 60, "H": 1 / 60,
              "T": 1 / 3600, "t0": 60}
    for name, values in a.items():
        assert_allclose(b[name] * factor.get(name, 1), values, atol=budgets.cli_carried,
                        err_msg=name)


def test_a_run_continues_from_its_own_rows(run, scenario, table):
    """Numbers round-trip: a scenario made of a row of the output starts there, to the last bit."""
    c = columns(run, table, scenario(time="at = [3.7]"))
    q = [float(c[name][0]) for name in GROUPS["q"]]
    w = [float(c[name][0]) for name in GROUPS["omega"]]
    state = f"[state.attitude-rate]\nquaternion = {q}\nomega_body = {w}"
    again = columns(run, table, scenario(time="at = [0]", state=state, name="again.toml"))
    for name in GROUPS["q"] + GROUPS["omega"]:
        assert_allclose(again[name], c[name], atol=budgets.cli_rounding)


# A torque about axis 3 of a body that turns about it: the angle is w t + a t^2 / 2, and a turn at a
# fixed rate between rows a time h apart is a h^2 / 8 from it in the middle.
@pytest.mark.parametrize(("stop", "error"), [(100, 1e-3), (-100, 1e-3), (50, 1e-5)])
def test_automatic_rows_keep_the_error_between_them(run, scenario, table, stop, error):
    state = ("[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [0, 0, 0.5]\n"
             '[[perturbation]]\nkind = "constant-torque"\ntorque = [0, 0, 0.05]')  # a = 0.02
    time = f'stop = {stop}\nstep = "auto"\nerror = {error}'
    t = columns(run, table, scenario(state=state, time=time))["t"]
    assert t[0] == 0 and t[-1] == stop
    h = numpy.abs(numpy.diff(t))
    assert h.max() - h.min() < budgets.cli_rounding * abs(stop)
    found = 0.02 * h.max() ** 2 / 8
    assert 0.5 * error < found < error


@pytest.mark.parametrize(("time", "message"), [
    ('stop = 10\nstep = "aut"', 'or { value = 1, unit = "s" }, or "auto"; no number at the start'),
    ('stop = 10\nstep = 1\nerror = 0.1', 'time.error: got 0.1; expected step = "auto" together'),
    ('stop = 10\nstep = "auto"\nerror = 0', "time.error: got 0; expected a positive"),
    ('stop = 1e9\nstep = "auto"\nerror = 1e-30', "expected an error that 1e8 rows can keep"),
])
def test_what_is_wrong_with_automatic_rows(run, scenario, time, message):
    result = run("run", scenario(time=time), "--out", "-")
    assert result.returncode == 2 and message in result.stderr, result.stderr
    assert result.stderr.count("\n") == 1


def test_members_of_an_ensemble_share_the_automatic_rows(run, scenario, ensemble, table, tmp_path):
    time = 'stop = 10\nstep = "auto"\nerror = 1e-3'
    t = columns(run, table, scenario(time=time))["t"]
    run.ok("ensemble", ensemble('size = 6\nkeep = "statistics"', time=time), "--out",
           tmp_path / "e.csv")
    names, rows = table((tmp_path / "e.csv").read_text(encoding="utf-8"))
    assert names[0] == "t" and [row[0] for row in rows] == list(t)


def test_hdf5_holds_what_csv_holds(run, scenario, table, tmp_path):
    path = scenario(columns='"q", "serret", "andoyer"', time="stop = 5000\nstep = 1")
    result = run("run", path, "--out", tmp_path / "a.csv", "--out", tmp_path / "a.h5")
    assert result.returncode == 0 and "short-axis mode" in result.stdout
    names, rows = table((tmp_path / "a.csv").read_text(encoding="utf-8"))
    with h5py.File(tmp_path / "a.h5") as file:
        groups = {"q", "serret", "andoyer"}
        assert set(file) == {"t", *groups, *(f"{name}_column" for name in groups)}
        for name in groups:  # named dimensions and coordinates, as NetCDF-4 has them
            time, column = file[name].dims
            assert time["t"] == file["t"] and file["t"].is_scale
            assert list(column[f"{name}_column"].asstr()) == list(file[name].attrs["columns"])
        assert list(file["andoyer"].attrs["columns"]) == ["l", "g", "L"]
        assert list(file["serret"].attrs["units"]) == ["rad", "s", "1/s2", "rad", "1/s", "1/s"]
        assert file["t"].shape == (5001,)
        assert file.attrs["title"] == "A body"
        assert file.attrs["scenario"] == path.read_text(encoding="utf-8")
        assert file.attrs["polhode"].count(".") == 2
        assert "Gurfil" in file.attrs["citations"][0]
        both = numpy.column_stack([file["t"], file["q"], file["serret"], file["andoyer"]])
    assert names == ["t", "qw", "qx", "qy", "qz", "g0", "t0", "T", "h", "G", "H", "l", "g", "L"]
    assert numpy.array_equal(both, numpy.array(rows))


@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_equal_runs_give_equal_files(run, scenario, tmp_path, extension):
    path = scenario()
    for name in ("a", "b"):
        run.ok("run", path, "--out", tmp_path / f"{name}.{extension}")
    first = (tmp_path / f"a.{extension}").read_bytes()
    assert first == (tmp_path / f"b.{extension}").read_bytes()
    assert not list(tmp_path.glob("*.part"))


def test_csv_carries_its_scenario(run, scenario, tmp_path):
    path = scenario()
    head = [line for line in run("run", path).stdout.splitlines() if line.startswith("#")]
    kept = "".join(line.removeprefix("# | ") + "\n" for line in head if line.startswith("# | "))
    assert kept == path.read_text(encoding="utf-8")
    assert head[0].startswith("# polhode ") and "# A body" in head
    assert "# units: t [s], qw [1], qx [1], qy [1], qz [1], w1 [rad/s], w2 [rad/s]" in head[-1]


def test_standard_output_holds_rows_or_the_table_never_both(run, scenario, tmp_path):
    path = scenario()
    assert run("run", path).stdout == run("run", path, "--out", "-").stdout
    assert "mode  " not in run("run", path).stdout
    assert "t,qw" not in run("run", path, "--out", tmp_path / "a.csv").stdout
    assert run("run", "-", stdin=path.read_text(encoding="utf-8")).stdout.count("\n") > 21


def everything_read(leader):
    """What a terminal was sent: it comes in pieces, and Linux ends it with an error (EIO)."""
    pieces = []
    with contextlib.suppress(OSError):
        while piece := os.read(leader, 65536):
            pieces.append(piece)
    return b"".join(pieces).decode()


def test_a_terminal_gets_the_table(polhode, scenario):
    leader, follower = pty.openpty()
    with subprocess.Popen([polhode, "run", scenario()], stdout=follower) as process:
        os.close(follower)
        text = everything_read(leader)
    os.close(leader)
    assert process.returncode == 0
    assert "short-axis mode" in text and "t,qw" not in text and "--out" in text


def test_info_as_json(run, scenario):
    table = json.loads(run("info", scenario(), "--json").stdout)
    assert table["mode"] == "short-axis mode (SAM)"
    assert table["moments"] == {"value": [1, 2, 2.5], "unit": "1"}
    assert table["angular_velocity" if "angular_velocity" in table else "momentum"]["unit"] == "1/s"
    energy = (0.1**2 + 2 * 0.2**2 + 2.5) / 2
    assert table["energy"]["value"] == pytest.approx(energy, rel=budgets.cli_rounding)
    both = table["modulus"]["value"] + table["complement"]["value"]
    assert both == pytest.approx(1, rel=budgets.cli_rounding)


def test_body_axes_of_a_tensor(run, scenario, table):
    """A body described in turned axes moves as the same body in principal axes."""
    c, s = numpy.cos(0.4), numpy.sin(0.4)
    turn = numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])  # principal to file axes
    tensor = turn @ numpy.diag([1, 2, 2.5]) @ turn.T
    tensor = (tensor + tensor.T) / 2
    omega = turn @ [0.1, 0.2, 1]
    half = [numpy.cos(0.2), 0, 0, -numpy.sin(0.2)]  # file axes to inertial = principal at t = 0
    state = (f"[state.attitude-rate]\nquaternion = {[float(x) for x in half]}\n"
             f"omega_body = {[float(x) for x in omega]}")
    body = f"tensor = {[[float(x) for x in row] for row in tensor]}"
    groups = '"omega_inertial", "omega", "q"'
    a = columns(run, table, scenario(columns=groups))
    b = columns(run, table, scenario(columns=groups, body=body, state=state, name="turned.toml"))
    for name in GROUPS["omega_inertial"]:
        assert_allclose(b[name], a[name], atol=budgets.cli_rounding)
    turned = turn @ numpy.array([a["w1"], a["w2"], a["w3"]])
    assert_allclose([b["w1"], b["w2"], b["w3"]], turned, atol=budgets.cli_rounding)


def test_help_shows_an_example_everywhere(run):
    for command in ("run", "fit", "simulate", "info", "convert", "init", "cite", "schema"):
        result = run(command, "--help")
        assert result.returncode == 0 and f"Example:\n  polhode {command}" in result.stdout
    run.ok("--help")
    assert run("--version").stdout.startswith("polhode 0.")


def test_every_template_runs(run, table):
    from_help = run("init", "--help").stdout
    for chart in ("tumbler", "attitude-rate", "euler", "andoyer", "serret", "sadov"):
        assert chart in from_help
        template = run("init", chart).stdout
        assert f"[state.{chart}]" in template
        names, rows = table(run("run", "-", stdin=template).stdout)
        assert len(rows) == 1441 and "l" in names
    for kind in ("gravity-gradient", "constant-torque", "damping", "fit", "kepler", "splitting"):
        assert kind in from_help
        template = run("init", kind).stdout
        assert f"kind = \"{kind}\"" in template
        names, rows = table(run("run", "-", stdin=template).stdout)
        assert len(rows) == 1441


def test_cite_follows_the_scenario(run, scenario):
    plain = run("cite", scenario()).stdout
    assert "gurfil2007" in plain and "sadov1970" not in plain
    assert "sadov1970" in run("cite", scenario(columns='"sadov"')).stdout


def test_cite_prints_entries_for_bibtex(run, scenario):
    text = run("cite", scenario(columns='"sadov"'), "--bibtex").stdout
    assert text.startswith("% For the equations and the notation.\n@article{gurfil2007,\n")
    keys = re.findall(r"^\[(\w+)\]", run("cite", scenario(columns='"sadov"')).stdout, re.M)
    assert re.findall(r"^@\w+\{(\w+),$", text, re.M) == keys
    assert "nodoi" not in text


def test_numbers_are_the_shortest_that_read_back(run, scenario):
    text = run("run", scenario(columns='"q"')).stdout
    fields = text.splitlines()[-1].split(",")
    for field in fields:
        assert struct.pack("d", float(field)) == struct.pack("d", float(repr(float(field))))
        assert len(field) <= len(repr(float(field))) + 1
