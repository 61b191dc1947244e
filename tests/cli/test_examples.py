# SPDX-License-Identifier: MIT
"""The examples, and what is known of their bodies."""

import json
import pathlib

import pytest

EXAMPLES = sorted((pathlib.Path(__file__).resolve().parents[2] / "examples").glob("*.toml"))


def info(run, root, name):
    result = run("info", root / "examples" / name, "--json")
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.stem)
def test_every_example_runs_and_names_its_source(run, table, path):
    result = run("run", path)
    assert result.returncode == 0 and result.stderr == ""
    names, rows = table(result.stdout)
    assert len(rows) > 100 and all(len(row) == len(names) for row in rows)
    text = path.read_text(encoding="utf-8")
    assert "Source:" in text or "standing in" in text


def test_apophis_has_the_published_energy(run, root):
    """Pravec et al. (2014): E/E0 = 1.024 +- 0.013, E0 the least energy for its angular momentum."""
    body = info(run, root, "apophis.toml")
    assert body["mode"] == "short-axis mode (SAM)"
    assert body["precession_period"]["value"] == pytest.approx(27.38, rel=1e-13)
    assert body["rotation_period"]["value"] == pytest.approx(263, rel=1e-12)
    ratio = 2 * body["energy"]["value"] / body["momentum"]["value"] ** 2
    assert abs(ratio - 1.024) < 0.013


def test_toutatis_is_in_long_axis_mode(run, root):
    body = info(run, root, "toutatis.toml")
    assert body["mode"] == "long-axis mode (LAM)"
    assert body["precession_period"]["value"] == pytest.approx(7.35, rel=1e-13)
    assert body["rotation_period"]["value"] == pytest.approx(5.41, rel=1e-13)


def test_the_earth_wobbles_in_304_sidereal_days(run, root):
    body = info(run, root, "earth-wobble.toml")
    sidereal_days = body["rotation_period"]["value"] * 1.00273781191135448
    assert sidereal_days == pytest.approx(304.46, abs=0.005)
    assert sidereal_days == pytest.approx((1 - 0.0032737548) / 0.0032737548, rel=1e-9)


def test_the_wing_nut_turns_over(run, root, table):
    names, rows = table(run("run", root / "examples/wing-nut.toml").stdout)
    w2 = [row[names.index("w2")] for row in rows]
    assert min(w2) < -359 and max(w2) > 359
    flips = sum(1 for a, b in zip(w2, w2[1:], strict=False) if a * b < 0)
    period = info(run, root, "wing-nut.toml")["rotation_period"]["value"]
    assert flips == int(2 * 30 / period)


def test_the_satellite_spins_evenly(run, root, table):
    names, rows = table(run("run", root / "examples/axisymmetric-satellite.toml").stdout)
    g1 = [row[names.index("g1")] for row in rows]
    assert max(g1) - min(g1) <= 1e-15 * g1[0]
    assert g1[0] == pytest.approx(0.04415 * 750 * 2 * 3.141592653589793 / 60, rel=1e-14)
