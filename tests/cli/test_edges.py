# SPDX-License-Identifier: MIT
"""What `info` and `convert` print is read back, at the edges of every chart too."""

import json
import math

import budgets
import pytest

TUMBLER = """[units]
angle = "deg"
[state.tumbler]
precession_period = {P_phi!r}
rotation_period = {P_psi!r}
mode = "SAM"
phi0 = {phi0!r}
psi0 = {psi0!r}
pole = {{ longitude = 20.0, latitude = 30.0 }}"""
NEXT_TO_THE_MIDDLE_AXIS = [(1e-20, 1.0, 0.0), (0.0, 1.0, 1e-60), (1e-20, -1.0, 1e-21),
                           (1e-9, 1.0, -1e-9), (1e-12, 1.0, 2e-17)]
NEXT_TO_OTHERS = [(1.0, 1e-20, 0.0), (1e-100, 1e-101, -1.0), (1.0, 0.0, 1e-9)]
BODY = "1,1.7,2.1"


def rotor_rows(momenta, t=0.25):
    lines = ["t,qw,qx,qy,qz,g1,g2,g3"]
    lines += [",".join(map(repr, (t, 0.5, -0.5, 0.1, 0.7, *g))) for g in momenta]
    return "\n".join(lines) + "\n"


def converted(run, there, back, text, moments=BODY):
    result = run.ok("convert", "--from", there, "--to", back, "--moments", moments, stdin=text)
    return result.stdout


def expect_back(run, table, chart, momenta, moments=BODY, t=0.25):
    text = rotor_rows(momenta, t)
    there = converted(run, "rotor", chart, text, moments)
    back = converted(run, chart, "rotor", there, moments)
    for first, last in zip(table(text)[1], table(back)[1], strict=True):
        size = math.hypot(*first[5:])
        assert math.dist(first[5:], last[5:]) < budgets.cli_half_the_digits * size, there
        a, b = ([x / math.hypot(*row[1:5]) for x in row[1:5]] for row in (first, last))
        overlap = abs(sum(x * y for x, y in zip(a, b, strict=True)))
        assert 1.0 - overlap < budgets.cli_half_the_digits ** 2, there


@pytest.mark.parametrize("chart", ["serret", "andoyer", "poincare-0-0", "euler", "matrix"])
def test_states_next_to_an_axis_come_back(run, table, chart):
    expect_back(run, table, chart, NEXT_TO_THE_MIDDLE_AXIS + NEXT_TO_OTHERS)


@pytest.mark.parametrize("chart", ["sadov", "andoyer", "poincare-0-0", "euler", "matrix"])
@pytest.mark.parametrize("size", [1e300, 1e-290])
def test_momenta_of_any_size_come_back(run, table, chart, size):
    momenta = [(0.3 * size, -0.2 * size, 0.7 * size), (0.9 * size, 0.1 * size, 0.2 * size)]
    expect_back(run, table, chart, momenta)


@pytest.mark.parametrize("chart", ["serret", "sadov", "andoyer"])
def test_needles_come_back(run, table, chart):
    # rates of 1e155: Serret's t0 holds a place on the polhode at t = 0 alone
    expect_back(run, table, chart, [(0.3, -0.2, 0.7), (0.9, 0.1, 0.2)], "1e-155,1,1", t=0.0)


def test_an_energy_that_no_double_holds_is_refused(run):
    result = run("convert", "--from", "rotor", "--to", "serret", "--moments", BODY,
                 stdin=rotor_rows([(1e-160, 2e-160, 3e-160)]))
    assert result.returncode == 2
    assert result.stderr.count("\n") == 1
    assert "to_serret: T = " in result.stderr and "must be within double range" in result.stderr


def read(run, path, *flags):
    result = run.ok("info", path, *flags)
    return result.stdout


def printed_psi_max(text):
    (line,) = [line for line in text.splitlines() if line.startswith("psi_max")]
    return float(line.split()[1])


@pytest.mark.parametrize("P_psi", [263.0, 201.5, 222.2, 300.3, 410.0, 555.5])
def test_psi_max_as_info_prints_it_is_a_psi0(run, scenario, P_psi):
    def state(psi0):
        return TUMBLER.format(P_phi=30.56, P_psi=P_psi, phi0=10.0, psi0=psi0)

    def info(psi0, *flags):
        return read(run, scenario("moments = [0.61, 0.965, 1]", state=state(psi0)), *flags)

    table = printed_psi_max(info(0.0))
    every_digit = json.loads(info(0.0, "--json"))["psi_max"]["value"]
    assert 0.0 <= every_digit - table <= budgets.cli_printed_digits * every_digit
    for psi0 in (table, -table, every_digit, -every_digit):
        assert abs(printed_psi_max(info(psi0)) - table) <= budgets.cli_printed_digits * table


def test_periods_as_info_prints_them_are_read_back_next_to_the_middle_axis(run, scenario):
    body = "moments = [1, 1.7, 2.1]"
    near = scenario(body, state="[units]\nangle = \"deg\"\n"
                                "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\n"
                                "momentum_body = [0, 1, 1e-60]")
    lines = json.loads(read(run, near, "--json"))
    values = {key: lines[key]["value"] for key in
              ("precession_period", "rotation_period", "psi_max", "complement")}
    again = scenario(body, state=TUMBLER.format(
        P_phi=values["precession_period"], P_psi=values["rotation_period"], phi0=10.0,
        psi0=values["psi_max"]))
    lines = json.loads(read(run, again, "--json"))
    for key in ("precession_period", "rotation_period", "psi_max"):
        assert lines[key]["value"] == pytest.approx(values[key], rel=budgets.cli_carried)
