# SPDX-License-Identifier: MIT
"""The examples, and what is known of their bodies."""

import json
import math
import pathlib
import re

import budgets
import numpy
import pytest
from closeness import assert_allclose, largest, smallest

EXAMPLES = sorted((pathlib.Path(__file__).resolve().parents[2] / "examples").glob("*.toml"))


def info(run, root, name):
    result = run.ok("info", root / "examples" / name, "--json")
    return json.loads(result.stdout)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.stem)
def test_every_example_runs_and_names_its_source(run, table, path):
    result = run.ok("run", path)
    text = path.read_text(encoding="utf-8")
    # without the lines of progress
    printed = re.sub(r"^ *\d+ %, .*\n", "", result.stderr, flags=re.MULTILINE)
    assert printed == "".join(
        f"{path.name}: note: {table} is not used; polhode {command} uses it\n"
        for table, command in (("[map]", "map"), ("[ensemble]", "ensemble"),
                               ("[[observation]]", "fit"))
        if re.search("^" + re.escape(table), text, re.MULTILINE))
    names, rows = table(result.stdout)
    assert len(rows) > 100 and all(len(row) == len(names) for row in rows)
    assert "Source:" in text or "standing in" in text


def test_apophis_has_the_published_periods_and_energy(run, root):
    """Pravec et al. (2014): P_phi = 27.38 h, which is of the short axis; E/E0 = 1.024, E0 the least
    energy for its angular momentum, here to what the last digits of the moments leave."""
    body = info(run, root, "apophis.toml")
    assert body["mode"] == "short-axis mode (SAM)"
    assert body["precession_period"]["value"] == pytest.approx(30.56, rel=budgets.cli_rounding)
    assert round(body["short_axis_period"]["value"], 2) == 27.38
    assert body["rotation_period"]["value"] == pytest.approx(263, rel=budgets.cli_rounding)
    ratio = 2 * body["energy"]["value"] / body["momentum"]["value"] ** 2
    assert abs(ratio - 1.024) < 0.0013


def test_toutatis_is_in_long_axis_mode(run, root):
    body = info(run, root, "toutatis.toml")
    assert body["mode"] == "long-axis mode (LAM)"
    assert body["precession_period"]["value"] == pytest.approx(7.35, rel=budgets.cli_rounding)
    assert body["rotation_period"]["value"] == pytest.approx(5.41, rel=budgets.cli_rounding)


def test_the_earth_wobbles_in_304_sidereal_days(run, root):
    body = info(run, root, "earth-wobble.toml")
    sidereal_days = body["rotation_period"]["value"] * 1.00273781191135448
    assert round(sidereal_days, 2) == 304.46
    assert sidereal_days == pytest.approx((1 - 0.0032737548) / 0.0032737548,
                                          rel=budgets.cli_carried)


def test_the_wing_nut_turns_over(run, root, table):
    names, rows = table(run("run", root / "examples/wing-nut.toml").stdout)
    w2 = [row[names.index("w2")] for row in rows]
    assert smallest(w2) < -359 and largest(w2) > 359
    flips = sum(1 for a, b in zip(w2, w2[1:], strict=False) if a * b < 0)
    period = info(run, root, "wing-nut.toml")["rotation_period"]["value"]
    assert flips == int(2 * 30 / period)


def test_the_satellite_spins_evenly(run, root, table):
    names, rows = table(run("run", root / "examples/axisymmetric-satellite.toml").stdout)
    g1 = [row[names.index("g1")] for row in rows]
    assert largest(g1) - smallest(g1) <= budgets.cli_rounding * g1[0]
    spin = 750 * 2 * math.pi / 60
    assert g1[0] == pytest.approx(0.04415 * spin, rel=budgets.cli_rounding)


def columns(run, table, path):
    result = run.ok("run", path)
    names, rows = table(result.stdout)
    return dict(zip(names, numpy.array(rows).T, strict=True))


# Final state of W1 by an 80-bit Taylor integration of order 30.
W1_Q = [-0.945141005522282568, 0.146971342460127602, -0.006995745106435133, -0.291648699167684123]
W1_OMEGA = [5.695139354984758640, -1.488713522467818403, 7.907221117809389845]


def test_w1_ends_where_it_must(run, root, table):
    c = columns(run, table, root / "examples/gravity-gradient-w1.toml")
    assert c["t"][-1] == 6283.185307179586
    q = numpy.array([c[name][-1] for name in ("qw", "qx", "qy", "qz")])
    chord = smallest(numpy.linalg.norm(q - W1_Q), numpy.linalg.norm(q + W1_Q))
    assert 4 * math.asin(chord / 2) < budgets.cli_thousand_orbits
    for name, value in zip(("w1", "w2", "w3"), W1_OMEGA, strict=True):
        assert abs(c[name][-1] - value) < budgets.cli_thousand_orbits * abs(value)


def test_unperturbed_formula_gives_the_inertial_rate(run, root, table, tmp_path):
    """The theorem: Andoyer variables of a precessing frame give omega of the inertial frame, the
    osculating ones the relative rate."""
    path = root / "examples/precessing-frame.toml"
    text = path.read_text(encoding="utf-8")
    moving = columns(run, table, path)
    start, stop = text.index("[frame.precessing]"), text.index("[state.attitude-rate]")
    inertial = tmp_path / "inertial.toml"
    inertial.write_text(text[:start] + text[stop:], encoding="utf-8")
    fixed = columns(run, table, inertial)
    for name in ("w1", "w2", "w3", "L", "G"):
        assert_allclose(moving[name], fixed[name], atol=budgets.cli_rounding)
    moments = numpy.array([1, 2, 2.5])

    def rate(suffix):
        length, axial, angle = (moving[name + suffix] for name in ("G", "L", "l"))
        across = numpy.sqrt(length**2 - axial**2)
        g = numpy.array([across * numpy.sin(angle), across * numpy.cos(angle), axial])
        return g / moments[:, None]

    inertial_rate = numpy.array([moving[f"w{i}"] for i in (1, 2, 3)])
    relative_rate = numpy.array([moving[f"w{i}_rel"] for i in (1, 2, 3)])
    convective = numpy.array([moving[f"v{i}"] for i in (1, 2, 3)])
    assert_allclose(rate(""), inertial_rate, atol=budgets.cli_carried)
    assert_allclose(rate("_osc"), relative_rate, atol=budgets.cli_carried)
    assert_allclose(inertial_rate + convective, relative_rate, atol=budgets.cli_rounding)
    assert_allclose(numpy.linalg.norm(convective, axis=0), 0.3, rtol=budgets.cli_rounding)
    assert abs(moving["L"] - moving["L_osc"]).max() > 0.1  # they do differ
    assert abs(moving["h"] - fixed["h"]).max() > 0.1       # and so do the frames
    assert_allclose(moving["dE"], 0, atol=budgets.cli_rounding)


def test_the_satellite_librates_about_the_vertical(run, root, table):
    """Pitch is a pendulum of 3 deg: rate n sqrt(3 (I2 - I1)/I3) agm(1, cos 3 deg)."""
    c = columns(run, table, root / "examples/gravity-gradient-satellite.toml")
    n = math.sqrt(398600.4418 / 7178.137**3)
    turn = 2 * numpy.arctan2(c["qz"], c["qw"]) - n * c["t"]
    pitch = numpy.remainder(turn + numpy.pi, 2 * numpy.pi) - numpy.pi
    amplitude = math.radians(3)
    assert abs(pitch).max() == pytest.approx(amplitude, rel=budgets.libration_frequency)
    assert abs(c["qx"]).max() == 0 and abs(c["qy"]).max() == 0  # it stays in the plane
    zeros = [t - p * (c["t"][k + 1] - t) / (pitch[k + 1] - p)
             for k, (t, p) in enumerate(zip(c["t"][:-1], pitch[:-1], strict=True))
             if p * pitch[k + 1] < 0]
    assert len(zeros) > 400
    a, b = 1.0, math.cos(amplitude)
    for _ in range(6):
        a, b = (a + b) / 2, math.sqrt(a * b)
    rate = math.pi * (len(zeros) - 1) / (zeros[-1] - zeros[0])
    linear = n * math.sqrt(3 * (98 - 10) / 100)
    assert rate == pytest.approx(linear * a, rel=budgets.libration_frequency)
    correction = 1 - amplitude**2 / 4  # what linear theory lacks
    assert rate == pytest.approx(linear * correction, rel=budgets.libration_frequency)
