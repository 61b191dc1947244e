# SPDX-License-Identifier: MIT
"""The examples of ensembles, small: members against SciPy, closed forms and what was published."""

import math
import subprocess
import sys

import budgets
import numpy
import pytest
from closeness import assert_allclose
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

OMEGA = "state.attitude-rate.omega_body"


@pytest.fixture
def ensemble(run, root, tmp_path):
    """ensemble("NAME", key="value", ...) -> its columns by name; __ in keys is a dot."""

    def go(name, **changes):
        out = tmp_path / "out.csv"
        out.unlink(missing_ok=True)
        sets = [each for key, value in changes.items()
                for each in ("--set", f"{key.replace('__', '.')}={value}")]
        run.ok("ensemble", root / "examples" / f"{name}.toml", *sets, "--out", out)
        return columns(out.read_text(encoding="utf-8"))

    return go


def columns(text):
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    numbers = numpy.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    return dict(zip(lines[0].split(","), numbers.T, strict=True))


@pytest.fixture
def member(run, root, tmp_path):
    """member("NAME", 5) -> its file, read by tomllib, and the columns of its run."""

    tomllib = pytest.importorskip("tomllib")

    def go(name, index, **changes):
        path, out = tmp_path / f"{index}.toml", tmp_path / f"{index}.csv"
        sets = [each for key, value in changes.items()
                for each in ("--set", f"{key.replace('__', '.')}={value}")]
        run.ok("ensemble", root / "examples" / f"{name}.toml", "--member", index, *sets, "--out",
               path, "--out", out)
        return (tomllib.loads(path.read_text(encoding="utf-8")),
                columns(out.read_text(encoding="utf-8")))

    return go


def hyperbola(orbit):
    """Positions along the hyperbola of a file, km and h."""
    e, gm = orbit["eccentricity"], 398600.4418 * 3600.0**2
    a = orbit["pericentre"] / (e - 1)
    n = math.sqrt(gm / a**3)
    i, node, w = (math.radians(orbit[key])
                  for key in ("inclination", "node", "pericentre_argument"))
    normal = numpy.array([math.sin(node) * math.sin(i), -math.cos(node) * math.sin(i), math.cos(i)])
    to_node = numpy.array([math.cos(node), math.sin(node), 0.0])
    p = math.cos(w) * to_node + math.sin(w) * numpy.cross(normal, to_node)

    def position(t):
        M = n * (t - orbit["epoch"])
        H = brentq(lambda h: e * math.sinh(h) - h - M, -20, 20, xtol=budgets.apophis_oracle)
        across = a * math.sqrt(e * e - 1) * math.sinh(H)
        return a * (e - math.cosh(H)) * p + across * numpy.cross(normal, p)

    return position, gm


def test_a_clone_of_apophis_alone_is_that_of_scipy(member):
    """Euler's equations with the torque of a point mass, by DOP853."""
    file, run_of = member("apophis-clones", 7, output__columns='["q", "omega"]')
    moments = numpy.array(file["body"]["moments"])
    position, gm = hyperbola(file["orbit"]["earth"])
    rows = numpy.array([run_of[name] for name in ("qw", "qx", "qy", "qz", "w1", "w2", "w3")])
    rows[4:] = numpy.radians(rows[4:])

    def slope(t, y):
        q, w, u = y[:4], y[4:], y[1:4]
        towards = position(t)
        r = numpy.linalg.norm(towards)
        cross = numpy.cross(-u, towards)  # inertial to body
        s = (towards + 2 * (q[0] * cross + numpy.cross(-u, cross))) / r
        torque = 3 * gm / r**3 * numpy.cross(s, moments * s)
        return [*(0.5 * numpy.array([-u @ w, *(q[0] * w + numpy.cross(u, w))])),
                *((numpy.cross(moments * w, w) + torque) / moments)]

    tight = {"rtol": budgets.apophis_oracle, "atol": budgets.apophis_oracle}
    near = file["orbit"]["earth"]["epoch"]
    there = rows[:, 0]
    for begin, end in ((0.0, near), (near, 360.0)):  # so that no step goes over the encounter
        there = solve_ivp(slope, (begin, end), there, "DOP853", [end], max_step=12.0,
                          **tight).y[:, 0]
    last = rows[:, -1]
    assert_allclose(last[:4] * math.copysign(1, last[:4] @ there[:4]), there[:4],
                    atol=budgets.apophis_clone)
    assert_allclose(last[4:], there[4:], atol=budgets.apophis_clone)


def test_clones_of_apophis_before_are_as_published(ensemble):
    """Pravec et al. (2014): P_phi = 27.38 +- 0.07 h, of the short axis, follows from the rest."""
    rows = ensemble("apophis-clones", ensemble__size=1000, time__stop=0.1, time__step=0.1,
                    ensemble__keep='"rows"')
    before = rows["P_short"][rows["t"] == 0]
    assert round(before.mean(), 2) == 27.38
    assert round(3 * before.std(), 2) == 0.07
    assert (rows["mode"] == 1).all()


def test_secondaries_in_the_plane_of_a_circle_are_pendulums(ensemble):
    """They librate where the energy is below that of the long axis 90 deg off, at rest."""
    rows = ensemble("binary-secondaries", **{
        "ensemble__size": 300, "time__stop": '"5 d"', "time__step": 120,
        "ensemble__keep": '"final"', "ensemble__vary__4__sigma": 0, "ensemble__vary__5__sigma": 0,
        "ensemble__vary__6__high": 1e-12, "ensemble__seed": 7})
    square = 3 * (rows["body.moments[0]"] - rows["body.moments[2]"]) * (360 / 11.92) ** 2
    angle = numpy.radians(rows["state.attitude-rate.euler.theta"])
    rate = rows["state.attitude-rate.omega_relative[1]"]
    librates = rate**2 < square * numpy.cos(angle) ** 2
    assert 200 < librates.sum() < 290
    assert ((rows["t"] == 120) == librates).all()


def test_a_clone_of_mars_is_that_of_scipy(member, root):
    """ds/dt = (alpha (s.n) - g) s x n along the shipped elements, read and interpolated here."""
    file, run_of = member("mars-clones", 3, time__stop=-1000,
                          planet__geodetic='"6.75 mas/yr"')
    raw = numpy.fromfile(root / "data/orbits/mars.i32", "<i4")
    kyr = raw[1] + raw[2] / 1000 * numpy.arange(raw[0])
    recent = abs(kyr) < 1100
    elements = CubicSpline(kyr[recent], raw[4:].reshape(-1, 4)[recent] * 1e-9)

    def normal_and_factor(t):
        k, h, q, p = elements(t)
        c = math.sqrt(1 - q * q - p * p)
        return (numpy.array([2 * p * c, -2 * q * c, 1 - 2 * (q * q + p * p)]),
                (1 - k * k - h * h) ** -1.5)

    ra, dec = (math.radians(file["planet"]["pole"][key]) for key in ("ra", "dec"))
    tilt = math.radians(84381.448 / 3600)
    x, y, z = (math.cos(dec) * math.cos(ra), math.cos(dec) * math.sin(ra), math.sin(dec))
    pole = numpy.array([x, math.cos(tilt) * y + math.sin(tilt) * z,
                        math.cos(tilt) * z - math.sin(tilt) * y])
    arcsec = math.radians(1 / 3600) * 1000  # a year, to rad/kyr
    rate = float(file["planet"]["precession_rate"].split()[0]) * arcsec
    n, factor = normal_and_factor(0.0)
    star = rate / (pole @ n) / factor
    geodetic = 6.75e-3 * arcsec

    def slope(t, s):
        n, factor = normal_and_factor(t)
        return (star * factor * (s @ n) - geodetic) * numpy.cross(s, n)

    tight = {"rtol": budgets.apophis_oracle, "atol": budgets.apophis_oracle}
    found = solve_ivp(slope, (0, -1000), pole, "DOP853", run_of["t"], max_step=5.0, **tight)
    mine = [math.degrees(math.acos(s @ normal_and_factor(t)[0]))
            for t, s in zip(found.t, found.y.T, strict=True)]
    assert_allclose(run_of["obliquity"], mine, atol=budgets.mars_clone)


def test_fragments_that_are_spheres_slow_down_in_closed_form(ensemble):
    """A sphere on a circular polar orbit about an axial dipole: its spin along the node, the normal
    of the orbit and the pole decays by 11/8, 5/2 and 9/8 of k K^2/(I r^6) (docs/guide/torques/
    magnetic.md), here of members that differ in their spins."""
    vary = f'[{{kind = "direction", keys = ["{OMEGA}"]}}]'
    rows = ensemble("debris-cloud", **{
        "ensemble__size": 4, "ensemble__keep": '"rows"', "ensemble__vary": vary,
        "body__moments": "[0.01, 0.01, 0.01]", OMEGA: "[0, 0, 0.3]",
        "perturbation__1__tensor": '{value = [30, 30, 30], unit = "S m4"}',
        "perturbation__1__gauss": '{value = [-29442, 0, 0], unit = "nT"}',
        "perturbation__1__rotation_rate": 0, "perturbation__1__field_rate": "false",
        "perturbation__2__density": '"0 kg/m3"', "orbit__earth__inclination": 90,
        "orbit__earth__node_rate": 0, "time__stop": '"5 d"', "time__step": '"1 d"',
        "output__columns": '["omega_inertial"]'})
    field = 29442e-9 * (6371.2 / 7156.0) ** 3
    decay = 30.0 * field**2 / 0.01 * numpy.array([11 / 8, 5 / 2, 9 / 8])
    for index in range(4):
        of = rows["member"] == index
        spin = numpy.array([rows[name][of] for name in ("W1", "W2", "W3")])
        expected = spin[:, :1] * numpy.exp(-decay[:, None] * rows["t"][of])
        assert_allclose(spin, expected, atol=budgets.debris_spin * 0.3)


def test_the_fragments_are_those_of_the_program(root, tmp_path):
    subprocess.run([sys.executable, root / "examples/debris-cloud.py"], cwd=tmp_path, check=True,
                   stdout=subprocess.DEVNULL)
    made, kept = ((folder / "debris-cloud.csv").read_text(encoding="utf-8")
                  for folder in (tmp_path, root / "examples"))
    assert made == kept
