# SPDX-License-Identifier: MIT
"""`polhode fit` and `polhode simulate` of light curves: what was simulated is found again, and what
is refused."""

import json

import budgets
import numpy
import pytest
from closeness import assert_allclose
from fit_files import FREE_LIGHT as FREE
from fit_files import NIGHT, ORBITS, TUMBLER, fitted, refused, rows

LIGHT = """
[[observation]]
kind = "light-curve"
file = "light.csv"
times = "at-body"
to_sun = [1, 2, 0.5]
to_observer = [1, 2, 0.5]
sigma = 1e-9
"""


def test_light_of_an_ellipsoid_is_that_of_its_shadow(run, fit_file, tmp_path, table):
    """Opposite to the Sun the law of Lommel and Seeliger makes brightness the area that is seen:
    pi sqrt(sum (abc s_i / a_i)^2)."""
    path = fit_file(LIGHT, FREE, '[output]\ncolumns = ["q"]\n')
    run.ok("simulate", path, "--into", tmp_path)
    light = rows(tmp_path / "light.csv")
    assert set(light) >= {"session", "t", "flux", "sigma", "sun_x", "observer_z"}
    names, numbers = table(run("run", path).stdout)
    q = numpy.array(numbers)[:, [names.index(n) for n in ("qw", "qx", "qy", "qz")]]
    s = numpy.array([1, 2, 0.5]) / numpy.sqrt(5.25)
    u, w = -q[:, 1:], q[:, :1]
    in_body = s + 2 * numpy.cross(u, numpy.cross(u, s) + w * s)
    moments = numpy.array([1, 2.2, 2.6])
    axes = numpy.sqrt(moments.sum() - 2 * moments)
    area = numpy.linalg.norm(in_body / axes, axis=1)
    assert_allclose(light["flux"], area / area.mean(), rtol=budgets.cli_light_noise)
    assert numpy.ptp(light["flux"]) > 0.1


def test_light_of_a_sphere_is_noise(run, fit_file, tmp_path):
    sphere = '[light]\nsemiaxes = [1, 1, 1]\nlaw = "mixed"\nmultiple = 0.3\n'
    path = fit_file(LIGHT.replace("1e-9", "0.02"), sphere, FREE)
    run.ok("simulate", path, "--into", tmp_path, "--set", "time.step=0.05")
    flux = rows(tmp_path / "light.csv")["flux"]
    assert len(flux) == 1201 and abs(flux.mean() - 1) < 4 * 0.02 / numpy.sqrt(1201)
    assert 0.018 < flux.std() < 0.022


def test_light_curves_in_the_format_of_damit(run, fit_file, tmp_path):
    lc = LIGHT.replace("light.csv", "light.lc") + (
        'format = "lc"\ntime_format = "JD"\ntime_scale = "TDB"\n')
    path = fit_file(lc, FREE)
    run.ok("simulate", path, "--into", tmp_path)
    lines = (tmp_path / "light.lc").read_text().splitlines()
    assert lines[:2] == ["1", "41 0"] and len(lines) == 43
    first = [float(x) for x in lines[2].split()]
    # 2013-01-05T00:00:00 UTC: TT is 67.184 s later, TDB within 2 ms of it
    assert first[0] == pytest.approx(2456297.5 + 67.184 / 86400, abs=budgets.cli_tdb)
    assert_allclose(first[2:], [1, 2, 0.5] * 2, rtol=budgets.cli_carried)


@pytest.mark.parametrize(("change", "expected"), [
    (("to_sun = [1, 2, 0.5]\n", ""), "expected a key to_sun as well"),
    (("sigma = 1e-9", 'sigma = 1e-9\nformat = "lc"'),
     'observation[0].format: got "lc"; expected a key time_scale as well, such as "UTC": lc has '
     "Julian dates and does not say in which time scale"),
    (("sigma = 1e-9", 'sigma = 1e-9\ntime_format = "JD"'),
     'observation[0].time_format: got "JD"; expected a key time_scale as well, that of the dates'),
    (("sigma = 1e-9", 'sigma = 1e-9\nformat = "lc"\ntime_format = "number"'),
     'expected time_format = "JD", which its files have'),
    (("sigma = 1e-9\n", ""), "expected a key sigma or sigma_columns as well"),
    (("sigma = 1e-9", 'sigma = 1e-9\ncolumns = ["1", "2"]'), "expected names and no numbers"),
    (("sigma = 1e-9", 'sigma = 1e-9\nsun_columns = ["x"]'), "expected three columns"),
    (("sigma = 1e-9", 'sigma = 1e-9\ncolumns = ["t"]'), "expected 2 columns"),
    (("sigma = 1e-9", 'sigma_columns = ["s"]'), "expected a key sigma, not sigma_columns"),
    (("to_sun = [1, 2, 0.5]", 'orbit = "a"'), "expected a key observer_orbit as well"),
    (("sigma = 1e-9", 'sigma = 1e-9\norbit = "a"\nobserver_orbit = "b"'),
     "expected none: orbits give the vectors"),
])
def test_bad_tables_of_light_are_refused(run, fit_file, change, expected):
    assert expected in refused(run, fit_file(LIGHT.replace(*change), FREE), "simulate")


SEEN_NIGHT = NIGHT.replace("to_sun = [1, 0.2, 0.3]\nto_observer = [0.8, 0.6, 0.1]\n", (
    'sun_columns = ["sun_x", "sun_y", "sun_z"]\n'
    'observer_columns = ["observer_x", "observer_y", "observer_z"]\n'))


def test_a_light_curve_is_fitted_from_a_start_nearby(run, night, tmp_path):
    """From a start that is off; truth within the errors that the fit says."""
    off = ["--set", "state.tumbler.phi0=24", "--set", "state.tumbler.psi0=66",
           "--set", "state.tumbler.precession_period=12.02", "--set",
           "body.moments=[0.58, 1.21, 1.36]"]
    out = tmp_path / "left.csv"
    found = fitted(run, night, *off, "--residuals", out, "--covariance", tmp_path / "c.csv",
                   "--solution", tmp_path / "fitted.toml")
    solution, = found["solutions"]
    at_truth, = fitted(run, night)["solutions"]
    assert solution["chi_square"] == pytest.approx(at_truth["chi_square"],
                                                   rel=budgets.cli_fit_starts)
    unknowns = at_truth["unknowns"]
    error = numpy.array([one["value"] - one["start"] for one in unknowns.values()])
    c = rows(tmp_path / "c.csv")
    assert list(unknowns) == [n for n in c if n in unknowns]
    cov = numpy.array([c[n] for n in unknowns])
    assert 0.3 < error @ numpy.linalg.solve(cov, error) < 27  # 8 unknowns: 1e-5 to 1 - 7e-4
    assert 0.5 < solution["chi_square"] / solution["degrees_of_freedom"] < 1.6
    for key, truth in (("precession_period", 12), ("rotation_period", 20)):
        one = solution[key]
        assert abs(one["value"] - truth) < 4 * one["error"] and one["error"] < 0.1
    pole = solution["pole"]
    off_pole = numpy.hypot((pole["longitude"] - 50) * numpy.cos(numpy.radians(40)),
                           pole["latitude"] - 40)
    assert off_pole < 4 * pole["error_major"]
    left = rows(out)
    assert_allclose(left["model"] - left["flux"], left["difference"], atol=budgets.cli_rounding)
    assert (left["r"]**2).sum() == pytest.approx(solution["chi_square"], rel=budgets.cli_carried)
    assert set(left["session"]) == {1} and len(left["t"]) == 81
    shown = json.loads(run("info", tmp_path / "fitted.toml", "--json").stdout)
    assert shown["precession_period"]["value"] == pytest.approx(
        solution["precession_period"]["value"], rel=budgets.cli_carried)
    text = run("fit", night).stdout
    assert "81 points of 1 light curve, relative" in text and "P_phi (long axis)" in text


def test_as_many_unknowns_as_points_leave_no_scaled_errors(run, fit_file, tmp_path):
    """9 points, 8 unknowns and a factor: nothing is left to scale errors by."""
    head = TUMBLER.replace("stop = 120\ncount = 81", "stop = 31\ncount = 9")
    path = fit_file(NIGHT.replace("0.02", "1e-5"), FREE, head=head)
    run.ok("simulate", path, "--into", tmp_path)
    solution, = fitted(run, path)["solutions"]
    assert abs(solution["degrees_of_freedom"]) < 0.5
    assert "error_factor" not in solution and solution["pole"]["scaled_error_major"] is None
    assert not any("scaled_error" in one for one in solution["unknowns"].values())
    assert "errors scaled by" not in run("fit", path).stdout


def test_columns_of_vectors_are_those_of_the_keys(run, night, fit_file):
    given = fitted(run, night)["solutions"][0]
    read = fitted(run, fit_file(SEEN_NIGHT, FREE, head=TUMBLER, name="read.toml"))["solutions"][0]
    assert read["chi_square"] == pytest.approx(given["chi_square"], rel=budgets.cli_carried)


def test_light_curves_predict_attitudes(run, night, table, tmp_path):
    """Those of the motion of the solution."""
    out, toml = tmp_path / "p.csv", tmp_path / "found.toml"
    found = fitted(run, night, "--at", "0", "--at", "90")["solutions"][0]["predicted"]
    run.ok("fit", night, "--predict", out, "--solution", toml)
    predicted = rows(out)
    names, numbers = table(run("run", toml, "--set", 'output.columns=["q"]').stdout)
    q = numpy.array(numbers)[:, [names.index(n) for n in ("qw", "qx", "qy", "qz")]]
    same = numpy.abs((q * numpy.stack([predicted[n] for n in ("qw", "qx", "qy", "qz")], 1)).sum(1))
    assert_allclose(same, 1, rtol=budgets.cli_carried)
    assert 0 < predicted["error_x"].min() and predicted["error_x"].max() < 5
    assert found[1]["t"] == 90 and found[0]["errors"][0] == pytest.approx(
        predicted["error_x"][0], rel=budgets.cli_carried)
    assert "predicted attitudes, errors in deg" in run("fit", night, "--at", "0").stdout


def test_no_model_fits_and_the_report_says_so(run, night):
    small = ["--set", "observation[0].sigma=0.002"]
    text = run("fit", night, *small).stdout
    first = text.splitlines()[0]
    assert first.startswith("the solution from this start does not describe these data"), first
    assert "errors of the data may be too small, by a factor of 8.6" in first
    rest = text.split(first)[1].replace("standard errors", "")
    assert "error" not in "".join(
        line for line in rest.splitlines() if not line.startswith("note: points are"))
    found = fitted(run, night, *small)
    solution, = found["solutions"]
    assert found["verdict"] == first and not solution["describes_data"]
    assert solution["precession_period"]["error"] is None
    assert all(one["error"] is None for one in solution["unknowns"].values())
    off = ["--set", "state.tumbler.precession_period=9", "--set", "fit.iterations=400"]
    text = run("fit", night, *off).stdout
    assert "residuals of neighbours have the correlation" in text.splitlines()[0]


def test_what_was_read_is_looked_at(run, night, fit_file, tmp_path):
    """Magnitudes as fluxes, errors far from the scatter, points far out under the squared loss."""
    light = rows(tmp_path / "night.csv")
    magnitude = 15 - 2.5 * numpy.log10(light["flux"])

    def text_of(values, *changes, name="flux"):
        lines = [f"t,{name}"] + [f"{t},{x}" for t, x in zip(light["t"], values, strict=True)]
        (tmp_path / "night.csv").write_text("\n".join(lines) + "\n")
        return run("fit", night, *changes).stdout

    assert "fluxes of night.csv are from 14." in text_of(magnitude)
    named = text_of(magnitude, "--set", 'observation[0].columns=["t","mag"]', name="mag")
    assert "the column mag of night.csv was read as fluxes" in named
    assert "errors of the data are too large" in text_of(
        numpy.linspace(1, 1.1, 81) + 0.001 * light["flux"], "--set", "observation[0].sigma=0.3")
    far = light["flux"].copy()
    far[40] += 1
    text = text_of(far)
    assert "1 point is far from the model, lines 42: 9" in text.splitlines()[0]
    assert "far points        1 point beyond 4 times" in text
    far[40] += 4  # even where the fit does not converge
    assert "more than 8 times the scatter from the neighbours, lines 42" in text_of(far)


def test_sessions_have_factors_of_their_own(run, fit_file, tmp_path):
    """Two sessions of one table, each as parts of its mean, and the same calibrated."""
    table = NIGHT + 'session_column = ["session"]\n'
    sessions = "[simulate]\nsessions = [0, 50, 70, 120]\n"
    path = fit_file(table, FREE, sessions, head=TUMBLER)
    run.ok("simulate", path, "--into", tmp_path)
    light = rows(tmp_path / "night.csv")
    assert set(light["session"]) == {1, 2}
    for k in (1, 2):
        assert light["flux"][light["session"] == k].mean() == pytest.approx(
            1, abs=budgets.cli_mean_of_noise)
    found = fitted(run, path)
    assert [s["points"] for s in found["sessions"]] == [34, 34]
    assert len(set(found["solutions"][0]["factors"])) == 2
    second = fitted(run, path, "--set", "observation[0].sessions=[2]")
    assert [s["points"] for s in second["sessions"]] == [34]
    steady = fit_file(table + "calibrated = true\n", FREE, sessions, head=TUMBLER, name="c.toml")
    run.ok("simulate", steady, "--into", tmp_path, "--replace")
    assert len(set(fitted(run, steady)["solutions"][0]["factors"])) == 1


def test_errors_are_parts_of_the_mean_of_a_session(run, fit_file, tmp_path):
    """Of a long body seen from its end and from its side, calibrated or not."""
    table = NIGHT.replace("0.02", "0.1") + 'session_column = ["session"]\n'
    body = "[light]\nsemiaxes = [5, 1, 1]\n"
    head = TUMBLER.replace("count = 81", "count = 4001")

    def light(name, *changes, sigma="0.1"):
        into = tmp_path / name
        own = table.replace("0.1\n", sigma + "\n")
        path = fit_file(own, *changes, FREE, body, head=head, name=name + ".toml")
        run.ok("simulate", path, "--into", into)
        return rows(into / "night.csv")

    whole = light("whole", sigma="1e-9")
    at = numpy.sort(whole["t"][[whole["flux"].argmin(), whole["flux"].argmax()]])
    sessions = f"[simulate]\nsessions = [{at[0] - 1}, {at[0] + 1}, {at[1] - 1}, {at[1] + 1}]\n"
    noisy = light("noisy", "calibrated = true\n", sessions)
    own = light("own", sessions)
    clean = light("clean", "calibrated = true\n", sessions, sigma="1e-15")
    means = []
    for k in (1, 2):
        one = noisy["session"] == k
        means.append(clean["flux"][one].mean())
        assert_allclose(noisy["sigma"][one], noisy["sigma"][one][0], rtol=budgets.cli_rounding)
        assert noisy["sigma"][one][0] == pytest.approx(0.1 * means[-1], rel=budgets.cli_carried)
        off = (noisy["flux"] - clean["flux"])[one]
        assert 0.07 < off.std() / means[-1] < 0.13
        assert numpy.all(own["sigma"][own["session"] == k] == 0.1)
    low, high = sorted(means)
    assert high > 1.5 * low


def test_vectors_come_from_orbits(run, fit_file, tmp_path):
    """Times at the observer are later by the light time, and are taken back."""
    head = TUMBLER.replace('angle = "deg"', 'angle = "deg"\nlength = "au"').replace(
        "[state.tumbler]",
        '[state]\nepoch = "2013-01-05T00:00:00 UTC"\naxes = "ecliptic-J2000"\n[state.tumbler]')
    head = head.replace("stop = 120\ncount = 81", "start = -60\nstop = 180\ncount = 161")
    table = NIGHT.replace("to_sun = [1, 0.2, 0.3]\nto_observer = [0.8, 0.6, 0.1]\n",
                          'orbit = "body"\nobserver_orbit = "earth"\n')
    sessions = "[simulate]\nsessions = [0, 120]\n"
    path = fit_file(table.replace("at-body", "at-observer"), FREE, ORBITS, sessions, head=head)
    run.ok("simulate", path, "--into", tmp_path)
    light = rows(tmp_path / "night.csv")
    assert 1 < light["t"][0] < 30 and "sun_x" not in light
    found = fitted(run, path)["solutions"][0]
    assert 0.4 < found["chi_square"] / found["degrees_of_freedom"] < 1.7
    assert abs(found["precession_period"]["value"] - 12) < 5 * found["precession_period"]["error"]


DISTANCES = NIGHT.replace("to_observer = [0.8, 0.6, 0.1]", "to_observer = [1.6, 1.2, 0.2]").replace(
    "at-body", "at-observer")


def test_light_takes_its_time_from_the_distance_of_each_point(run, fit_file, tmp_path):
    """2.01 au are 16.72 min, whether a key says so or vectors in au do."""
    head = TUMBLER.replace('angle = "deg"', 'angle = "deg"\nlength = "au"')
    own = fit_file(DISTANCES, FREE, head=head)
    run.ok("simulate", own, "--into", tmp_path)
    lag = (1.6**2 + 1.2**2 + 0.2**2)**0.5 * 149597870.7 / 299792.458 / 60
    assert rows(tmp_path / "night.csv")["t"][0] == pytest.approx(lag, rel=budgets.cli_carried)
    found = fitted(run, own)
    keyed = fitted(run, fit_file(DISTANCES + f"light_time = {lag!r}\n", FREE, head=head,
                                 name="keyed.toml"))
    assert found["solutions"][0]["chi_square"] == pytest.approx(
        keyed["solutions"][0]["chi_square"], rel=budgets.cli_carried)
    assert "light time of each point from its distance to the observer, 16.7" in run(
        "fit", own).stdout
    directions = DISTANCES.replace("[1.6, 1.2, 0.2]", "[0.6, 0.8, 0]")
    assert "directions and no distances" in refused(
        run, fit_file(directions, FREE, head=head, name="directions.toml"))
    assert "vectors to the observer with units.length" in refused(
        run, fit_file(DISTANCES, FREE, head=TUMBLER, name="bare.toml"))


def test_a_fit_restarts_from_its_solution(run, night, tmp_path):
    found, again = tmp_path / "found.toml", tmp_path / "again.toml"
    first, = fitted(run, night, "--solution", found)["solutions"]
    second, = fitted(run, found, "--solution", again, "--set", "fit.iterations=3")["solutions"]
    assert second["chi_square"] == pytest.approx(first["chi_square"], rel=budgets.cli_fit_starts)
    assert "semiaxes" in found.read_text() and "semiaxes" in again.read_text()
    run.ok("run", found, "--out", tmp_path / "motion.csv")


def test_points_far_out_are_named_spared_and_left_out(run, night, tmp_path):
    table = tmp_path / "night.csv"
    lines = table.read_text().splitlines()
    at = len(lines) - 30
    part = lines[at].split(",")
    column = next(x for x in lines if not x.startswith("#")).split(",").index("flux")
    part[column] = str(1.4 * float(part[column]))
    lines[at] = ",".join(part)
    clean = fitted(run, night)["solutions"][0]
    table.write_text("\n".join(lines) + "\n")
    huber = ["--set", 'fit.loss="huber"']
    text = run("fit", night, *huber).stdout
    assert "which was minimised: huber from 1 standard errors on" in text
    assert f"of chi-square; lines {at + 1}\n" in text
    out = tmp_path / "r.csv"
    spared = fitted(run, night, *huber, "--residuals", out)["solutions"][0]
    r = numpy.abs(rows(out)["r"])  # of the model with the factor that huber has
    cost = numpy.where(r <= 1, r**2, 2 * r - 1).sum()
    assert cost == pytest.approx(spared["cost"], rel=budgets.cli_carried)
    assert clean["cost"] == clean["chi_square"]
    one = spared["pole"]
    assert one["scaled_error_major"] < 1.5 * one["error_major"] and spared["chi_square"] > 250
    without = fitted(run, night, "--set", f"observation[0].leave_out=[{at + 1}]")["solutions"][0]
    assert without["chi_square"] < 1.1 * clean["chi_square"]
    assert without["degrees_of_freedom"] == pytest.approx(
        clean["degrees_of_freedom"] - 1, rel=budgets.cli_carried)
    for key, expected in (("leave_out=[1]", "line 1 has none"), ("sessions=[2]", "from 1 to 1")):
        assert expected in run.rejected("fit", night, "--set", "observation[0]." + key)


LINES = "t,flux\n" + "".join(f"{t},{1 + 0.2 * (t % 3)}\n" for t in range(20))


@pytest.mark.parametrize(("data", "change", "expected"), [
    (LINES + "3.5,1\n", ("", ""), "night.csv:22: "),
    (LINES + "19,1.2\n", ("", ""), "night.csv:22: "),
    ("t,flux\n0,1\n", ("", ""), "night.csv"),
    ("t,flux\n0,1\n1,2\n2,1\n3,2\n", ("", ""), "4 points for 8 unknowns and 1 factor"),
    (LINES, ("to_sun = [1, 0.2, 0.3]\n", ""), "Sun"),
    ("t,flux,s\n0,1,0.1\n1,2,0\n2,1,0.1\n",
     ("sigma = 0.02", 'sigma_columns = ["s"]'), "error 0; expected"),
])
def test_bad_light_is_refused(run, fit_file, tmp_path, data, change, expected):
    (tmp_path / "night.csv").write_text(data)
    message = refused(run, fit_file(NIGHT.replace(*change), FREE, head=TUMBLER))
    assert expected in message, message


@pytest.mark.parametrize(("part", "expected"), [
    (FREE.replace('"rate", ', ""), "expected attitude and rate among them"),
    (FREE.replace('"shape"', '"products"'), "expected no products"),
    (FREE + '[[free.prior]]\nkind = "rate"\nsigmas = [1, 1, 1]\n', "expected no prior"),
    (FREE + '[light]\nmultiple = 0.2\n', 'expected none unless light.law = "mixed"'),
    (FREE + '[light]\nshape = "mesh"\n', "expected a key light.mesh or body.shape as well"),
    (FREE + '[fit]\nfrom = "search"\n[fit.scan]\nshortest = 0.001\n',
     "expected at most 1e8 pairs"),
    (FREE + '[fit]\nfrom = "search"\n[fit.scan]\nshortest = 3\nlongest = 2\n',
     "expected a period longer"),
    (FREE + "[simulate]\nsessions = [1, 2, 3]\n", "expected pairs of times"),
    (FREE + "[fit]\nwithin = 5\n", "fit.within_factor is theirs"),
    (FREE + "[fit]\nrate_spread = 1\n", "expected none with light curves"),
    (FREE + "[fit]\nstarts = 5\n", 'expected fit.from = "search" as well'),
    (FREE + '[[free.jump]]\nkind = "rate"\nt = 50\nchange = [0, 0, 1]\n',
     "free.jump[0].kind: got \"rate\"; expected none: light curves are fitted in free rotation"),
    (FREE + "[[surface]]\narea = 2\nposition = [0, 0, 1]\nnormal = [0, 0, 1]\n"
     '[[free.parameter]]\nkey = "surface[0].area"\n', "free.parameter[0].key"),
    (FREE + ("[[observation]]\nkind = \"attitude\"\nfile = \"a\"\ntimes = \"at-body\"\n"
             "sigma = 1\n"), "expected light curves alone"),
])
def test_bad_plans_of_light_are_refused(run, night, fit_file, part, expected):
    message = refused(run, fit_file(NIGHT, part, head=TUMBLER, name="bad.toml"))
    assert expected in message, message


def test_light_that_does_not_converge_is_no_solution(run, night, tmp_path):
    out = tmp_path / "fitted.toml"
    done = run("fit", night, "--solution", out, "--set", "fit.iterations=1", "--set",
               "state.tumbler.phi0=90")
    assert done.returncode == 1 and done.stdout == "" and not out.exists()
    assert "no solution: from its start the fit did not converge: " in done.stderr


def test_words_of_light_need_light(run, fit_file, tmp_path):
    (tmp_path / "seen.csv").write_text("t,qw,qx,qy,qz\n0,1,0,0,0\n")
    attitudes = NIGHT[:NIGHT.index("to_sun")].replace("light-curve", "attitude") + "sigma = 2\n"
    assert "expected attitude, rate, moments, products" in refused(
        run, fit_file(attitudes, FREE, head=TUMBLER))


def test_outputs_over_the_scenario_are_refused_before_the_work(run, night, tmp_path):
    left = tmp_path / "left.csv"
    done = run("fit", night, "--residuals", left, "--solution", night)
    assert done.returncode == 2 and "is the scenario itself" in done.stderr
    assert not left.exists() and done.stdout == ""
