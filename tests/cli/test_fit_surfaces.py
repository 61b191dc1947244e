# SPDX-License-Identifier: MIT
"""`polhode fit` of light curves to convex bodies and given meshes: from a start and from a search,
what is written beside a solution, and what is refused."""

import json
import math
import os

import budgets
import numpy
import pytest
from closeness import smallest
from fit_files import TUMBLER, fitted, refused, rows

HEAD = TUMBLER + """[[observation]]
kind = "light-curve"
file = "night.csv"
times = "at-body"
to_sun = [1, 0.2, 0.3]
to_observer = [0.8, 0.6, 0.1]
sigma = 0.005
"""
FREE = '[free]\nunknowns = ["attitude", "rate", "shape"]\n'
TURN = '[free]\nunknowns = ["attitude", "rate"]\n'
MESH = '[light]\nshape = "mesh"\nmesh = "seen.obj"\n'
CONVEX = '[light]\nshape = "convex"\n[light.convex]\ndegree = 3\nrows = 4\n'
SEARCH = """[fit]
from = "search"
starts = 40
within_factor = 1.5
[[fit.periods]]
mode = "LAM"
precession_period = 12
rotation_period = 20
[[fit.periods]]
mode = "LAM"
precession_period = 15
rotation_period = 20
"""


def egg(rings=9, around=14):
    """About the ellipsoid of HEAD, one end blunt and the other thin: no ellipsoid."""
    points = [(1, 0, 0)]
    for i in range(1, rings):
        u = math.cos(math.pi * i / rings)
        r = math.sqrt(1 - u * u) * (1 + 0.35 * u)
        points += [(u, 0.6 * r * math.cos(v), 0.45 * r * math.sin(v))
                   for v in (2 * math.pi * k / around for k in range(around))]
    points.append((-1, 0, 0))
    at = [[2 + (i - 1) * around + k % around for k in range(around + 1)] for i in range(1, rings)]
    faces = []
    for k in range(around):
        faces += [(1, at[0][k], at[0][k + 1]), (len(points), at[-1][k + 1], at[-1][k])]
        faces += [(a[k], b[k], b[k + 1], a[k + 1]) for a, b in zip(at, at[1:], strict=False)]
    return "".join(f"v {x} {y} {z}\n" for x, y, z in points) + "".join(
        "f " + " ".join(map(str, face)) + "\n" for face in faces)


@pytest.fixture
def night(run, fit_file, tmp_path):
    """The light of the egg; a file that fits it follows."""
    (tmp_path / "seen.obj").write_text(egg())
    path = fit_file(MESH, TURN, head=HEAD, name="truth.toml")
    run.ok("simulate", path, "--into", tmp_path)
    return path


def found_beside(folder):
    return sorted(path.name for path in folder.glob("found*.obj"))


def test_a_convex_body_follows_an_ellipsoid(run, night, fit_file, tmp_path):
    """The egg is no ellipsoid: facets fit it better, with the same periods; the scenario beside
    its mesh runs, is simulated and fitted again."""
    path = fit_file(CONVEX.replace("rows = 4", "rows = 8"), FREE, head=HEAD, name="convex.toml")
    out = tmp_path / "found.toml"
    found = fitted(run, path, "--solution", out, "--residuals", tmp_path / "left.csv",
                   "--covariance", tmp_path / "c.csv")
    solution, = found["solutions"]
    ellipsoid, = fitted(run, path, "--set", 'light.shape="ellipsoid"', "--set",
                        "light.convex=")["solutions"]
    assert found["model"] == "convex" and solution["convex"]["facets"] == 512
    assert solution["converged"] and solution["convergence"].startswith("converged after")
    assert solution["convex"]["roughness_error"] == 3
    coefficients = solution["convex"]["coefficients"]
    assert len(coefficients) == 16
    seen = [one for name, one in solution["unknowns"].items() if name.startswith("c_")]
    assert [one["value"] for one in seen] == coefficients[1:]
    assert all(one["value"] != one["start"] for one in seen)  # of the ellipsoid of the file
    assert solution["chi_square"] < 0.8 * ellipsoid["chi_square"]
    for key, truth in (("precession_period", 12), ("rotation_period", 20)):
        assert abs(solution[key]["value"] - truth) < 5 * solution[key]["error"] < 0.3
    assert (rows(tmp_path / "left.csv")["r"]**2).sum() == pytest.approx(
        solution["chi_square"], rel=budgets.cli_carried)
    assert list(solution["unknowns"]) == [
        n for n in rows(tmp_path / "c.csv") if n in solution["unknowns"]]
    text = run("fit", path).stdout
    assert "512 facets, degree 3" in text and "roughness error 3" in text
    assert "standard error of the least" not in text  # as near as any fit

    assert found_beside(tmp_path) == ["found-seen.obj"]
    assert (tmp_path / "found-seen.obj").read_text().count("\nf ") > 100
    run.ok("run", out)
    again = tmp_path / "again"
    run.ok("simulate", out, "--into", again, "--set", "observation.0.sigma=1e-9")
    model = rows(tmp_path / "left.csv")["model"]
    flux = rows(again / "night.csv")["flux"]
    assert numpy.abs(flux / flux.mean() - model / model.mean()).max() < budgets.cli_convex_mesh
    mesh, = fitted(run, out)["solutions"]
    assert mesh["chi_square"] == pytest.approx(solution["chi_square"], rel=budgets.cli_convex_again)
    assert mesh["precession_period"]["value"] == pytest.approx(
        solution["precession_period"]["value"], abs=solution["precession_period"]["error"])


def test_a_search_of_convex_bodies_has_every_pair_of_periods(run, night, fit_file):
    path = fit_file(CONVEX, FREE, SEARCH, head=HEAD, name="search.toml")
    one = run.ok("fit", path, "--json", "--threads", "1")
    assert run("fit", path, "--json", "--threads", "3").stdout == one.stdout
    found = json.loads(one.stdout)
    assert found["surfaces_converged"] <= found["surfaces"]
    assert all("convex" in p for p in found["periods"] if p["chi_square"] is not None)
    first, *others = found["solutions"]
    assert first["mode"] == "LAM" and first["beside"] == "first"
    images = {s["image"] for s in others if s["beside"] == "image"}
    assert images == {"normal", "bisector", "difference"}
    assert all(s["converged"] for s in found["solutions"])
    text = run("fit", path).stdout
    assert "pairs of periods by the cost that a convex body comes to" in text
    assert "        cost  chi-square  mode" in text and "the lowest cost" in first["sentence"]
    for s in found["solutions"]:
        assert sum(s["cost_terms"].values()) == pytest.approx(s["cost"], rel=budgets.cli_carried)
        assert s["cost"] >= first["cost"] * (1 - budgets.cli_fit_images)
    assert "convex bodies" in text and "image (normal) of 1" in text


def pole_off(solution, longitude=50, latitude=40):
    pole = solution["pole"]
    return math.hypot((pole["longitude"] - longitude) * math.cos(math.radians(latitude)),
                      pole["latitude"] - latitude)


def test_a_given_mesh_is_fitted(run, night, fit_file, tmp_path):
    """From a start that is off, and the moments too."""
    off = ["--set", "state.tumbler.phi0=23", "--set", "state.tumbler.precession_period=12.02"]
    out = tmp_path / "found.toml"
    found = fitted(run, night, *off, "--solution", out, "--residuals", tmp_path / "left.csv")
    solution, = found["solutions"]
    assert found["model"] == "mesh"
    assert 0.5 < solution["chi_square"] / solution["degrees_of_freedom"] < 1.6
    assert pole_off(solution) < 5 * solution["pole"]["error_major"]
    again, = fitted(run, out)["solutions"]
    assert again["chi_square"] == pytest.approx(solution["chi_square"], rel=budgets.cli_fit_starts)
    both = fitted(run, night, *off, "--set", 'free.unknowns=["attitude","rate","moments","law"]')
    assert {"Ixx/Izz", "multiple"} <= set(both["solutions"][0]["unknowns"])
    text = run("fit", night).stdout
    assert "224 facets" in text and "within one standard error of the least" in text


def test_a_solution_in_another_folder_has_its_mesh(run, night, fit_file, tmp_path):
    """A given mesh is named from there; that of a convex body lies beside it."""
    there = tmp_path / "there" / "found.toml"
    there.parent.mkdir()
    first, = fitted(run, night, "--solution", there)["solutions"]
    text = there.read_text()
    assert 'mesh = "../seen.obj"' in text and 'file = "../night.csv"' in text
    again, = fitted(run, there)["solutions"]
    assert again["chi_square"] == pytest.approx(first["chi_square"], rel=budgets.cli_fit_starts)
    fitted(run, fit_file(CONVEX, FREE, head=HEAD, name="convex.toml"), "--solution", there)
    text = there.read_text()
    assert 'mesh = "found-seen.obj"' in text and 'file = "../night.csv"' in text
    assert there.with_name("found-seen.obj").exists() and run("fit", there).returncode == 0


def test_a_mesh_is_looked_for_with_the_periods_of_ellipsoids(run, night, fit_file):
    """The pole of the truth is among what is reported, and so is a mirror pole; a pair of periods
    that no ellipsoid fits well is told."""
    found = fitted(run, fit_file(MESH, TURN, SEARCH, head=HEAD, name="search.toml"))
    assert found["surfaces"] >= 3 and found["periods"][0]["mesh"]["converged"]
    best = smallest(*(pole_off(s) for s in found["solutions"]))
    assert best < 3 and len(found["solutions"]) >= 2
    period = found["solutions"][0]["precession_period"]
    assert abs(period["value"] - 12) < 4 * period["error"]


def knobs(rows=7):
    """A body of 168 facets with knobs and hollows, in shadow here and there."""
    points, first = [], []
    for i in range(rows + 1):
        first.append(len(points) + 1)
        for j in range(2 * rows if 0 < i < rows else 1):
            theta, phi = math.pi * i / rows, math.pi * j / rows
            x, y = math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi)
            z = math.cos(theta)
            waves = math.sin(1.2 * x - 4.8 * y - 0.6 * z) * math.cos(0.4 * x - 1.4 * y + 1.4 * z)
            r = 1 + 0.3 * waves + 0.105 * x - 0.135 * y - 0.105 * z
            points.append((r * x, 0.84 * r * y, 0.71 * r * z))

    def at(i, j):
        return first[i] + (0 if i in (0, rows) else j % (2 * rows))

    faces = []
    for j in range(2 * rows):
        faces += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)) for i in range(rows - 1)]
        faces += [(at(i, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(1, rows)]
    return "".join(f"v {x} {y} {z}\n" for x, y, z in points) + "".join(
        "f " + " ".join(map(str, face)) + "\n" for face in faces)


def test_a_mesh_is_found_where_no_ellipsoid_leads_to_it(run, fit_file, tmp_path):
    """By its periods alone: with the pole of the truth, or that turned by pi about the bisector of
    Sun and observer. From the ellipsoids that fit best nothing converged."""
    (tmp_path / "seen.obj").write_text(knobs())
    head = HEAD
    for given, instead in (("moments = [0.5625, 1.2025, 1.36]  # of the ellipsoid 1 : 0.6 : 0.45",
                            'shape = "seen.obj"\nscale = "1 m"\ndensity = 1'),
                           ("[units]", '[units]\nlength = "m"'), ('"LAM"', '"SAM"'),
                           ("period = 20", "period = 97.253149"),
                           ("longitude = 50", "longitude = 206.813"),
                           ("latitude = 40", "latitude = -32.342"), ("phi0 = 20", "phi0 = 106.402"),
                           ("psi0 = 70", "psi0 = 13.875"), ("stop = 120", "stop = 243.133"),
                           ("count = 81", "count = 121"), ("sigma = 0.005", "sigma = 0.01"),
                           ("[0.8, 0.6, 0.1]", "[0.7, 0.8, 0.1]")):
        assert given in head
        head = head.replace(given, instead)
    mesh = '[light]\nshape = "mesh"\n'
    run.ok("simulate", fit_file(mesh, TURN, head=head, name="truth.toml"), "--into", tmp_path)
    periods = ('[fit]\nfrom = "search"\nstarts = 40\nwithin_factor = 1.1\n[[fit.periods]]\n'
               'mode = "SAM"\nprecession_period = 11.9995\nrotation_period = 97.1\n')
    found = fitted(run, fit_file(mesh, TURN, periods, head=head, name="search.toml"))
    assert found["periods"][0]["mesh"]["converged"]
    off = [pole_off(one, 206.813, -32.342) for one in found["solutions"][:2]]
    assert smallest(*off) < 3, off
    assert found["solutions"][0]["chi_square"] < 1.2 * found["solutions"][0]["degrees_of_freedom"]


@pytest.fixture
def two_nights(run, fit_file, tmp_path):
    """Files that fit the egg to two nights of two hours, twelve hours apart, one by one."""
    (tmp_path / "seen.obj").write_text(egg())
    head = HEAD.replace("stop = 120\ncount = 81", "stop = 840\nstep = 3").replace(
        'times = "at-body"\n', 'times = "at-body"\nsession_column = ["session"]\n')
    sessions = "[simulate]\nsessions = [0, 120, 720, 840]\n"
    run.ok("simulate", fit_file(MESH, TURN, sessions, head=head, name="truth.toml"),
           "--into", tmp_path)
    fit = SEARCH.replace("[fit]\n", '[fit]\nsessions = "one-by-one"\n')
    return lambda *shape: fit_file(*shape, fit, sessions, head=head, name="nights.toml")


def joined(run, path, folder):
    """The report of a fit whose sessions joined; its files have every point and a scenario."""
    out, left = folder / "found.toml", folder / "left.csv"
    report = fitted(run, path, "--solution", out, "--residuals", left)
    first, second = report["joined_sessions"]
    assert (first["session"], second["session"]) == (1, 2) and second["distance"] == 720
    assert second["counts"] > first["counts"] == first["solutions"] > 0
    best = report["solutions"][0]
    assert best["cost"] == second["cost"] and len(best["factors"]) == 2
    assert best["chi_square"] < 1.6 * best["degrees_of_freedom"]
    for key, truth in ("precession_period", 12), ("rotation_period", 20):
        assert abs(best[key]["value"] - truth) < 5 * best[key]["error"] < 0.01
    for column in rows(left), rows(folder / "left-2.csv"):
        assert list(column["session"]) == 41 * [1] + 41 * [2]
    assert sum(rows(left)["r"]**2) == pytest.approx(best["chi_square"], rel=budgets.cli_fit_starts)
    return report, best


def test_sessions_of_a_mesh_join_one_by_one(run, two_nights, tmp_path):
    """From a search, and from the file of its solution."""
    report, best = joined(run, two_nights(MESH, TURN), tmp_path)
    assert report["model"] == "mesh"
    assert smallest(*(pole_off(one) for one in report["solutions"])) < 1
    text = run("fit", tmp_path / "found.toml", "--set", "fit.sessions=one-by-one").stdout
    assert "sessions one by one: a fit for each count of turns; solutions and the lowest" in text
    again = fitted(run, tmp_path / "found.toml", "--set", "fit.sessions=one-by-one")["solutions"][0]
    assert again["chi_square"] == pytest.approx(best["chi_square"], rel=budgets.cli_fit_starts)


def test_sessions_of_a_convex_body_join_one_by_one(run, two_nights, tmp_path):
    """From a search and from a start. The usual facets are those of the ellipsoid of the first
    night: costs differ in the fourth digit, also from that of a fit of both nights at once."""
    path = two_nights(CONVEX, FREE)
    report, best = joined(run, path, tmp_path)
    assert report["model"] == "convex" and best["convex"]["facets"] == 128
    assert found_beside(tmp_path)[0] == "found-2-seen.obj"
    assert 'mesh = "found-seen.obj"' in (tmp_path / "found.toml").read_text()
    start = ["--set", "fit.from=start", "--set", "fit.starts=", "--set", "fit.periods="]
    for change in [], ["--set", "fit.sessions=together", "--set", "fit.iterations=200"]:
        one, = fitted(run, path, *start, *change)["solutions"]
        assert abs(one["cost"] - best["cost"]) < 1e-3 * best["cost"]


@pytest.mark.parametrize(("parts", "expected"), [
    ((CONVEX, TURN), "expected shape among them: a convex body is what is looked for"),
    ((MESH, FREE), 'expected no shape with light.shape = "mesh": the mesh is given'),
    ((MESH.replace("seen.obj", "none.obj"), TURN), "none.obj"),
    ((MESH.replace("mesh = ", "semiaxes = [1, 1, 1]\nmesh = "), TURN), "expected none together"),
    ((MESH + 'moments = "of-shape"\n', TURN), 'expected "of-body" with a mesh'),
    (('[light]\nmesh = "seen.obj"\n', FREE), 'expected shape = "mesh" as well'),
    (("[light.convex]\nrows = 4\n", FREE), 'expected shape = "convex" as well'),
    ((CONVEX.replace("rows = 4", "rows = 0"), FREE), "expected a whole number from 1 to 200"),
    ((CONVEX.replace("degree = 3", "degree = 41"), FREE), "expected a whole number from 1 to 40"),
    ((CONVEX.replace("degree = 3", "degree = 20"), FREE), "light.convex.degree"),
    ((CONVEX + "roughness_error = 0\n", FREE), "light.convex.roughness_error"),
    ((CONVEX + "moments_error = -1\n", FREE), "light.convex.moments_error"),
    ((CONVEX + "pairs = 0\n", FREE), "light.convex.pairs"),
    (('[light]\nshape = "mesh"\n', TURN), "expected a key light.mesh or body.shape as well"),
])
def test_bad_plans_of_surfaces_are_refused(run, night, fit_file, parts, expected):
    message = refused(run, fit_file(*parts, head=HEAD, name="bad.toml"))
    assert expected in message, message


def test_what_does_not_converge_is_no_convex_body(run, night, fit_file, tmp_path):
    path = fit_file(CONVEX, FREE, "[fit]\niterations = 2\n", head=HEAD, name="few.toml")
    out = tmp_path / "few-found.toml"
    done = run("fit", path, "--solution", out)
    assert done.returncode == 1 and not out.exists()
    assert not (tmp_path / "few-found-seen.obj").exists()
    assert "did not converge" in done.stderr


def test_a_mesh_needs_a_file_beside_it(run, night, fit_file):
    path = fit_file(CONVEX, FREE, head=HEAD, name="convex.toml")
    for out in ("-", "found.obj"):
        assert "expected PATH.toml" in run.rejected("fit", path, "--solution", out)


def test_a_mesh_beside_a_solution_is_no_file_that_is_read(run, night, fit_file, tmp_path):
    """egg-seen.obj is the shape of the body: it stays, and so does egg.obj, which nobody named."""
    truth = tmp_path / "egg-seen.obj"
    truth.write_text(egg())
    (tmp_path / "egg.obj").write_text("mine")
    head = HEAD.replace("moments = [0.5625, 1.2025, 1.36]", 
                        'shape = "egg-seen.obj"\nscale = 1\ndensity = 1')
    path = fit_file(CONVEX, FREE, head=head, name="of-shape.toml")
    assert "egg-seen.obj" in run.rejected("fit", path, "--solution", tmp_path / "egg.toml")
    assert truth.read_text() == egg() and not (tmp_path / "egg.toml").exists()
    run.ok("fit", path, "--solution", tmp_path / "other.toml")
    assert (tmp_path / "egg.obj").read_text() == "mine"


@pytest.mark.skipif("POLHODE_TEST_FULL" not in os.environ, reason="two minutes: make test-full")
def test_a_night_from_a_cold_start(run, night, fit_file):
    """Scan, ellipsoids, convex bodies of every pair: the pole of the truth and its mirror pole."""
    scan = '[fit]\nfrom = "search"\n[fit.scan]\norder = 2\nshortest = 5\nlongest = 40\n'
    found = fitted(run, fit_file(CONVEX, FREE, scan, head=HEAD, name="cold.toml"))
    first = found["solutions"][0]
    assert first["mode"] == "LAM"
    assert abs(first["precession_period"]["value"] - 12) < 5 * first["precession_period"]["error"]
    assert abs(first["rotation_period"]["value"] - 20) < 5 * first["rotation_period"]["error"]
    assert {s["image"] for s in found["solutions"]} >= {"normal", "bisector", "difference"}
    assert smallest(*(pole_off(s) for s in found["solutions"])) < 5


def test_a_mesh_thinner_than_any_ellipsoid_of_a_start_is_found(run, fit_file, tmp_path):
    """No ellipsoid has these periods, so that the search by periods is all there is."""
    lines = [line.split() for line in egg().splitlines()]
    (tmp_path / "seen.obj").write_text("".join(
        f"v {x[1]} {0.2 * float(x[2])} {0.2 * float(x[3])}\n" if x[0] == "v"
        else " ".join(x) + "\n" for x in lines))  # fmt: skip
    body = TUMBLER[TUMBLER.index("[body]"):TUMBLER.index("[state.tumbler]")]
    head = (HEAD.replace(body, '[body]\nshape = "seen.obj"\nscale = "1 m"\ndensity = 1\n')
            .replace('angle = "deg"', 'angle = "deg"\nlength = "m"')
            .replace("rotation_period = 20", "rotation_period = 0.9"))
    one = '[fit]\nfrom = "search"\nstarts = 30\n[[fit.periods]]\nmode = "LAM"\n' \
        "precession_period = 12\nrotation_period = 0.9\n"
    path = fit_file('[light]\nshape = "mesh"\n', TURN, one, head=head, name="thin.toml")
    run.ok("simulate", path, "--into", tmp_path)
    found = fitted(run, path)
    best = found["solutions"][0]
    assert best["chi_square"] < 1.5 * best["degrees_of_freedom"]
    assert found["starts"] == 0  # of ellipsoids
