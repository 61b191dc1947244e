# SPDX-License-Identifier: MIT
"""Positions that elements over ages give a rotation, held against the Kepler orbit they are."""

import budgets
import numpy as np
import polhode
import pytest

GM = 132712440041.28
AU = 149597870.7
HEAD = """schema = 1
units = { time = "d", length = "km", angle = "deg" }
[body]
moments = [1, 2, 2.5]
[state]
epoch = "2000-06-28T00:00:00 UTC"
axes = "AXES"
[state.attitude-rate]
quaternion = [1, 0, 0, 0]
omega_body = [0.1, 0, 3]
[[perturbation]]
kind = "gravity-gradient"
orbit = "sun"
[time]
stop = STOP
step = STOP
[orbit.sun]
gm = "132712440041.28 km3/s2"
semi_major_axis = "1 au"
"""
YEAR = 2 * np.pi * np.sqrt(AU**3 / GM) / 86400  # d


def orbit_of(tmp_path, text, axes, stop):
    path = tmp_path / "a.toml"
    head = HEAD.replace("AXES", axes).replace("STOP", repr(float(stop)))
    path.write_text(head + text, encoding="utf-8")
    return polhode.load(path).orbits["sun"]


def kepler(tmp_path, e, i, node, argument, M, axes="ecliptic-J2000", stop=300.0):
    return orbit_of(tmp_path, f"eccentricity = {e}\ninclination = {i}\nnode = {node}\n"
                    f"pericentre_argument = {argument}\nmean_anomaly = {M}\n", axes, stop)


def elements(tmp_path, e, i, node, argument, M, more, axes="ecliptic-J2000", stop=300.0):
    """Of equal rows, with the mean longitude that they and M make."""
    times = np.linspace(-10, stop + 10, 30)
    rows = "".join(f"{float(t)!r},{e},{i},{node},{argument}\n" for t in times)
    (tmp_path / "e.csv").write_text(f"t,e,i,Omega,omega\n{rows}", encoding="utf-8")
    return orbit_of(tmp_path, 'kind = "elements"\nfile = "e.csv"\n'
                    'columns = ["t", "e", "i", "Omega", "omega"]\n'
                    'units = ["d", "1", "deg", "deg", "deg"]\n'
                    + ("" if "axes" in more else 'axes = "ecliptic-J2000"\n') +
                    f"mean_longitude = {node + argument + M}\n{more}", axes, stop)


def largest_difference(one, other, t):
    there = other.position(t)
    return np.max(np.linalg.norm(one.position(t) - there, axis=1) / np.linalg.norm(there, axis=1))


# Whole turns from the apocentre: probes at even steps all miss the pericentres.
@pytest.mark.parametrize("turns", [7.3, 59, 118])
def test_pericentres_are_tabulated_as_well(tmp_path, turns):
    at = (0.6, 5, 100, 50, 180)
    stop = turns * YEAR
    one, other = elements(tmp_path, *at, "", stop=stop), kepler(tmp_path, *at, stop=stop)
    near = (np.arange(int(turns) + 1)[:, None] + np.linspace(0.47, 0.53, 60)) * YEAR
    assert largest_difference(one, other, near[near < stop]) < budgets.elements_rows


@pytest.mark.parametrize(("turns", "what"), [
    (60007, "60007 turns in the run, with an eccentricity of up to 0.6, are too many to tabulate"),
    (200000, "2e\\+05 turns in the run are too many to tabulate, with 8e\\+06 rows"),
])  # fmt: skip
def test_too_many_turns_are_refused(tmp_path, turns, what):
    with pytest.raises(ValueError, match=what):
        elements(tmp_path, 0.6, 5, 100, 50, 180, "", stop=turns * YEAR)


def test_the_mean_longitude_is_along_the_axes_of_the_file(tmp_path):
    at = (0.1, 40, 100, 50, -120)
    t = np.linspace(0, 300, 31)
    axes = "equator-J2000"
    one = elements(tmp_path, *at, f'axes = "{axes}"\n', axes=axes)
    assert largest_difference(one, kepler(tmp_path, *at, axes=axes), t) < budgets.elements_rows
    # tilted by 30 degrees about the line of nodes
    c, s = np.cos(np.pi / 12), np.sin(np.pi / 12)
    one = elements(tmp_path, 0.1, 40, 0, 50, -120, f"attitude = [{c}, {s}, 0, 0]\n")
    other = kepler(tmp_path, 0.1, 70, 0, 50, -120)
    assert largest_difference(one, other, t) < budgets.elements_rows
    # a quarter of a turn about axis 3
    one = elements(tmp_path, *at, f"attitude = [{np.sqrt(0.5)}, 0, 0, {np.sqrt(0.5)}]\n")
    other = kepler(tmp_path, 0.1, 40, 190, 50, -120)
    assert largest_difference(one, other, t) < budgets.elements_rows
    # a circle has no pericentre
    one = elements(tmp_path, 0, 40, 100, 50, -120, f'axes = "{axes}"\n', axes=axes)
    other = kepler(tmp_path, 0, 40, 100, 50, -120, axes=axes)
    assert largest_difference(one, other, t) < budgets.elements_rows
