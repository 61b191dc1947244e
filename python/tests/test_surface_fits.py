# SPDX-License-Identifier: MIT
"""Convex bodies and given meshes in Python: fits of arrays, what scenarios say of them, likely
periods, and the figures that take them."""

import pathlib

import budgets
import matplotlib
import numpy as np
import polhode
import pytest
from closeness import assert_allclose, largest, smallest

matplotlib.use("Agg")
import fit_calls  # noqa: E402
from polhode import figures, light  # noqa: E402

NIGHT = pathlib.Path(__file__).resolve().parents[2] / "examples/tumbling-night.toml"
NEARBY = {"fit.from": "start", "fit.starts": None, "fit.scan": None}
SUN, OBSERVER = [1.0, 0.2, 0.3], [0.8, 0.6, 0.1]
SMALL = {"degree": 3, "rows": 4}


@pytest.fixture(scope="module")
def convex():
    """A convex body that is no ellipsoid, from one of its fits; and its light with errors."""
    rng = np.random.default_rng(4)
    found = light.fit_light(fit_calls.BODY.convex(**SMALL), fit_calls.CURVE)
    coefficients = found.body.shape.coefficients.copy()
    coefficients[[4, 8, 9, 12]] += [0.1, -0.15, 0.08, 0.1]
    body = light.LightModel(found.body.spin, light.ConvexShape(3, 4, coefficients))
    t = np.linspace(0.0, 40.0, 90)
    blank = light.LightCurve(t, np.ones(90), 1.0, SUN, OBSERVER)
    (flux,) = light.model_fluxes(body, blank)
    seen = flux * (1.0 + 0.005 * rng.standard_normal(90))
    return body, light.LightCurve(t, seen, 0.005 * flux, SUN, OBSERVER)


def test_facets_fit_what_no_ellipsoid_does(convex):
    body, curve = convex
    first = light.fit_light(fit_calls.BODY, curve)
    assert first.converged
    found = light.fit_light(first.body.convex(**SMALL), curve)
    assert found.converged and isinstance(found.body.shape, light.ConvexShape)
    assert found.chi_square < 0.7 * first.chi_square
    assert found.names[:6] == first.names[:6] and found.names[6:8] == ("Ixx/Izz", "Iyy/Izz")
    assert len(found.names) == 8 + 15 and found.covariance.shape == (23, 23)
    (model,) = found.model(curve)
    assert_allclose(np.sum(((model - curve.flux) / curve.sigma) ** 2), found.chi_square,
                    rtol=budgets.fit_freedom)  # fmt: skip
    of = found.body.shape
    assert of.normals.shape == (128, 3) and smallest(of.areas) > 0.0
    assert_allclose(np.linalg.norm(of.normals, axis=1), 1.0, atol=budgets.fit_rotation)
    # the mesh has these facets: each of its own lies on one of the normals, with their areas
    mesh = of.mesh
    places = np.argmax(np.asarray(mesh.normals) @ of.normals.T, axis=1)
    areas = np.bincount(places, np.asarray(mesh.areas), 128)
    assert_allclose(areas.sum(), of.areas.sum(), rtol=budgets.python_convex_closure)
    assert np.abs(areas - of.areas).max() < budgets.python_convex_closure * of.areas.sum()
    again = light.LightModel(found.body.spin, mesh, found.body.law)
    (of_mesh,) = light.model_fluxes(again, curve)
    assert_allclose(of_mesh, model, rtol=budgets.python_convex_light)


def test_a_given_mesh_is_fitted_from_a_start_nearby():
    rng = np.random.default_rng(5)
    shape = fit_calls.TETRAHEDRON
    truth = light.LightModel.homogeneous([0.9, 0.1, 0.3, 0.2], [0.4, 0.5, 1.0], shape)
    t = np.linspace(0.0, 30.0, 80)
    blank = light.LightCurve(t, np.ones(80), 1.0, SUN, OBSERVER)
    (flux,) = light.model_fluxes(truth, blank)
    sigma = 0.01 * flux.mean()
    curve = light.LightCurve(
        t, flux + sigma * rng.standard_normal(80), sigma, SUN, OBSERVER
    )
    start = light.LightModel.homogeneous([0.9, 0.11, 0.29, 0.21], [0.401, 0.5, 1.0], shape)
    found = light.fit_light(start, curve)
    assert found.converged and found.names == (
        "turn_x", "turn_y", "turn_z", "w_x", "w_y", "w_z")  # fmt: skip
    off = (found.body.spin.w - truth.spin.w) @ np.linalg.inv(found.covariance[3:, 3:])
    assert off @ (found.body.spin.w - truth.spin.w) < 16.3  # 3 unknowns: 1 in 1000 is beyond
    assert found.chi_square < 1.6 * found.degrees_of_freedom
    assert found.body.mesh is found.body.shape


@pytest.mark.parametrize(("call", "error", "message"), [
    (lambda: light.fit_light(3, fit_calls.CURVE), TypeError, "got 3; expected LightModel"),
    (lambda: fit_calls.MESH.convex(), TypeError, "kind mesh; expected an ellipsoid"),
    (lambda: fit_calls.BODY.convex(degree=20), ValueError, "rows"),
    (lambda: light.ConvexShape.of([1.0, 0.0, 1.0]), ValueError, "semi-axis 0 must be above 0"),
    (lambda: light.fit_light(fit_calls.BODY.convex(), fit_calls.CURVE, roughness_error=0.0),
     ValueError, "roughness_error = 0 must be above 0"),
    (lambda: light.fit_light(fit_calls.BODY, fit_calls.CURVE, moments="even"), ValueError,
     "moments"),
    (lambda: light.fit_light(
        fit_calls.BODY.convex(), fit_calls.CURVE, about=fit_calls.MESH
    ),
     ValueError, "usual body"),
    (lambda: light.LightModel(fit_calls.STATE, 3), ValueError, "shape"),
    (lambda: light.LightModel(3, [1.0, 0.8, 0.5]), TypeError, "expected SpinState"),
    (lambda: fit_calls.BODY.mesh, TypeError, "expected a convex body or a mesh"),
    (lambda: light.model_fluxes(3, fit_calls.CURVE), TypeError, "expected LightModel"),
    (lambda: light.likely_periods(fit_calls.CURVE, -1.0, 0.1, order=1), ValueError,
     "f1: got -1.0; expected a frequency above 0"),
])  # fmt: skip
def test_what_is_no_surface_is_refused(call, error, message):
    with pytest.raises(error, match=message):
        call()


def test_likely_periods_are_those_of_the_whole_series():
    """The truth, 12 and 20 min, is high among the readings of the lines 1/12 and 1/10."""
    near = polhode.load(NIGHT).replace(NEARBY)
    (curve,) = polhode.fit.fit_scenario(near).curves
    found = light.likely_periods(curve, 1 / 12.0022, 1 / 9.9957, order=2)
    assert all(a.score >= b.score for a, b in zip(found, found[1:]))
    place = [k for k, one in enumerate(found) if one.mode == "LAM"
             and abs(one.precession_period - 12) < 0.05 and abs(one.rotation_period - 20) < 0.1]
    assert place and place[0] < 20


def test_a_scenario_with_a_convex_body(tmp_path):
    """What polhode.fit returns is what the arrays give; the files beside it run and are simulated.
    """
    changes = {"light.shape": "convex", "light.convex.degree": 3, "light.convex.rows": 4}
    told = []
    found = polhode.fit.fit_scenario(
        polhode.load(NIGHT).replace({**NEARBY, **changes}),
        progress=lambda done, of: told.append(done),
    )
    (one,) = found
    assert one.body.kind == "convex" and one.report["convex"]["facets"] == 128
    assert told == sorted(told)
    ellipsoid = polhode.fit.fit_scenario(polhode.load(NIGHT).replace(NEARBY))[0]
    again = light.fit_light(ellipsoid.body.convex(**SMALL), found.curves)
    assert_allclose(again.chi_square, one.chi_square, rtol=budgets.fit_freedom)
    assert_allclose(again.body.shape.coefficients, one.body.shape.coefficients,
                    rtol=budgets.fit_exact)  # fmt: skip
    (model,) = one.light.model(found.curves)
    assert_allclose(one.residuals["model"], model, rtol=budgets.fit_motion)
    assert "c_1_0" in one.unknowns and one.covariance.shape == (23, 23)
    assert one.scenario.run().outcome.ok  # its motion needs no mesh
    assert 'kind = "fit"' in one.text and 'mesh = "seen.obj"' in one.text
    one.write(tmp_path / "body.toml")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["body-seen.obj", "body.toml"]
    assert polhode.shape.read_obj(str(tmp_path / "body-seen.obj")).open_edge == ""
    assert 'mesh = "body-seen.obj"' in (tmp_path / "body.toml").read_text()
    (path,) = polhode.fit.simulate(tmp_path / "body.toml", tmp_path / "seen")
    assert pathlib.Path(path).exists()
    assert figures.light_curve_fit(found.curves, one).shape == (1, 2)
    assert len(figures.pole_sky(found).get_legend().get_texts()) == 1


def test_halves_of_a_night_join_to_a_convex_body():
    """Residual functions have the cost of the solution: the usual facets are those of the ellipsoid
    of the first half."""
    text = NIGHT.read_text()
    table = text[text.index("[[observation]]"):text.index("[free]")].rstrip()
    halves = [f"{table}\nleave_out = {list(lines)}\n" for lines in (range(5, 66), range(66, 126))]
    changes = {"fit.sessions": "one-by-one", "light.shape": "convex", "light.convex.degree": 3,
               "light.convex.rows": 4}  # fmt: skip
    scenario = polhode.Scenario.from_text(text.replace(table, "\n".join(halves)), str(NIGHT))
    found = polhode.fit.fit_scenario(scenario.replace({**NEARBY, **changes}))
    first, second = found.report["joined_sessions"]
    assert first["counts"] == 1 < second["counts"] and len(found.curves) == 2
    for one in found:
        assert one.body.kind == "convex" and one.converged
        f = one.residual_function()
        assert_allclose(np.sum(f.residuals(f.start) ** 2), one.report["cost"],
                        rtol=budgets.fit_freedom)  # fmt: skip


SEARCHED = [("LAM", 12.0, 20.0), ("LAM", 15.0, 20.0)]


def bits_of(solutions):
    return [(s.values.tobytes(), s.chi_square, s.starts, s.relation) for s in solutions]


@pytest.mark.parametrize("kind", ["convex", "mesh"])
def test_a_search_of_arrays_is_that_of_a_scenario(kind, tmp_path):
    """Bit for bit, on any number of threads: ellipsoids first, then what follows them."""
    mesh = fit_calls.TETRAHEDRON
    lines = [("v", *row) for row in mesh.vertices.tolist()]
    lines += [("f", *row) for row in (np.asarray(mesh.triangles) + 1).tolist()]
    (tmp_path / "seen.obj").write_text("".join(" ".join(map(str, one)) + "\n" for one in lines))
    text = NIGHT.read_text()
    text = text[:text.index("[fit.scan]")].replace("tumbling-night.csv",
                                                   str(NIGHT.with_suffix(".csv")))
    text += "".join(f'[[fit.periods]]\nmode = "{mode}"\nprecession_period = {phi}\n'
                    f"rotation_period = {psi}\n" for mode, phi, psi in SEARCHED)  # fmt: skip
    changes = {"fit.starts": 24, "fit.iterations": 30, "light.shape": kind, "free.unknowns":
               ["attitude", "rate", *(["shape"] if kind == "convex" else [])]}  # fmt: skip
    if kind == "convex":
        changes |= {"light.convex.degree": 3, "light.convex.rows": 4}
    else:
        changes |= {"light.mesh": str(tmp_path / "seen.obj")}
    scenario = polhode.Scenario.from_text(text, str(NIGHT)).replace(changes)
    of_file = polhode.fit.fit_scenario(scenario)
    surface = (3, 4) if kind == "convex" else light.LightModel(
        polhode.fit.SpinState([1.0, 0, 0, 0], [0.0, 0.0, 1.0], np.diag([0.5625, 1.2025, 1.36])),
        mesh)  # fmt: skip
    for threads in (1, 2):
        found = light.search_light(of_file.curves, SEARCHED, surface=surface, starts=24, seed=1,
                                     within=2.0, most_iterations=30, threads=threads)
        assert bits_of(found.solutions) == bits_of(one.light for one in of_file)
        assert found.surfaces == of_file.report["surfaces"]
        assert found.surfaces_converged == of_file.report["surfaces_converged"] > 0
        assert found.solutions[0].body.kind == kind and found.failure == ""


@pytest.mark.parametrize(("change", "error", "said"), [
    ({"surface": 3}, TypeError, "search_light: surface: got 3; expected LightModel"),
    ({"surface": fit_calls.BODY}, ValueError, "must be a mesh"),
    ({"surface": (20, 4)}, ValueError, "rows"),
    ({"surface": (2, 3), "body": fit_calls.MESH}, ValueError, "no ellipsoids"),
    ({"surface": (2, 3), "roughness_error": 0.0}, ValueError, "roughness_error = 0"),
    ({"surface": fit_calls.MESH, "moments": "shape"}, ValueError, "moments"),
])  # fmt: skip
def test_what_no_surface_can_follow_is_refused(change, error, said):
    with pytest.raises(error, match=said):
        light.search_light(fit_calls.CURVE, [("SAM", 10.0, 25.0)], **change)


def test_facets_are_drawn_where_they_are():
    """Corners on paper are those of the mesh; what is lit and faces the observer is bright."""
    shape = fit_calls.TETRAHEDRON
    body = light.LightModel.homogeneous([1.0, 0.2, 0.0, 0.1], [0.4, 0.5, 1.0], shape)
    eye = np.array(OBSERVER) / np.linalg.norm(OBSERVER)
    (axis,) = figures.body_as_seen(body, [0.0], SUN, OBSERVER)
    (drawn,) = axis.collections
    paths = drawn.get_paths()
    motion = body.spin.free_rotation
    R = (np.asarray(polhode.charts.attitude_matrix(motion.at(0.0).q)).T
         @ np.asarray(polhode.charts.attitude_matrix(motion.body.q_FB)))
    normals = np.asarray(shape.normals) @ R.T
    assert len(paths) == np.sum(normals @ eye > 0.0)
    up = np.array([0.0, 0.0, 1.0]) - eye[2] * eye
    up /= np.linalg.norm(up)
    corners = np.asarray(shape.vertices) @ R.T
    size = np.linalg.norm(corners, axis=1).max()
    onto = corners @ np.stack([np.cross(up, eye), up], axis=1) / size
    for path in paths:
        for corner in path.vertices[:3]:
            nearest = smallest(*np.linalg.norm(onto - corner, axis=1))
            assert nearest < budgets.drawn_edge
    assert largest(*drawn.get_array()) <= 1.0
    convex = light.fit_light(fit_calls.BODY.convex(**SMALL), fit_calls.CURVE)
    assert len(figures.body_as_seen(convex, [0.0, 1.0], SUN, OBSERVER)) == 2
