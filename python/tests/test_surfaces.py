# SPDX-License-Identifier: MIT
"""Shapes, surfaces, sunlight, air and YORP against NumPy."""

import copy
import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose, largest
from rejections import rejected

TETRAHEDRON = np.array([[1.0, 0.1, -0.4], [-0.7, 0.9, -0.3], [-0.2, -1.1, -0.2], [0.1, 0.1, 0.9]])
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])


def outward(vertices, faces):
    """The faces of a convex body, each counterclockwise from outside."""
    middle = vertices.mean(0)
    turned = []
    for a, b, c in faces:
        normal = np.cross(vertices[b] - vertices[a], vertices[c] - vertices[a])
        outside = normal @ (vertices[a] - middle) > 0
        turned.append((a, b, c) if outside else (a, c, b))
    return np.array(turned)


def shape():
    return polhode.shape.FacetShape(TETRAHEDRON, outward(TETRAHEDRON, FACES))


def facets_of(surface):
    rows = surface.rows
    return rows[:, :3], rows[:, 3:6], rows[:, 6], rows[:, 7:]


def light_torque(surface, e):
    """Momentum of light from directions (..., 3) on each facet, as in a textbook."""
    r, n, area, finish = facets_of(surface)
    c = np.clip(e @ n.T, 0.0, None)[..., None]
    specular, diffuse, emitted = finish[:, 0:1], finish[:, 1:2], finish[:, 2:3]
    lambert = 2 / 3 * (diffuse + emitted * (1 - specular - diffuse))
    light = (1 - specular) * np.expand_dims(e, -2)
    force = -area[:, None] * c * (light + (2 * specular * c + lambert) * n)
    return np.cross(r, force).sum(-2)


def test_mass_by_random_points():
    mass = polhode.shape.mass_properties(shape(), 2.0)
    a = TETRAHEDRON[1:] - TETRAHEDRON[0]
    assert_allclose(mass.volume, abs(np.linalg.det(a)) / 6, rtol=budgets.chart_rounding)
    assert_allclose(mass.centre, TETRAHEDRON.mean(0), atol=budgets.chart_rounding)
    # the second moments of a tetrahedron: m / 20 sum of squares of the corners about the centre
    x = TETRAHEDRON - TETRAHEDRON.mean(0)
    second = mass.mass / 20 * (x.T @ x)
    inertia = np.trace(second) * np.eye(3) - second
    assert_allclose(mass.inertia, inertia, atol=budgets.chart_rounding)
    assert_allclose(
        np.sort(mass.body.moments), np.linalg.eigvalsh(inertia), atol=budgets.chart_rounding
    )
    assert mass.third.shape == (10,)
    assert mass.fourth.shape == (15,)
    assert isinstance(mass.principal_moments, polhode.shape.MassMoments)


def test_shapes_tell_what_they_are(tmp_path):
    body = shape()
    assert len(body) == 4
    assert body.open_edge == ""
    assert_allclose(body.areas.sum(), body.area, rtol=budgets.chart_rounding)
    again = pickle.loads(pickle.dumps(body))
    assert (again.vertices == body.vertices).all()
    assert (again.triangles == body.triangles).all()
    with pytest.raises(ValueError, match="not closed: edge"):
        polhode.shape.mass_properties(
            polhode.shape.FacetShape(body.vertices, body.triangles[:3]), 1.0
        )
    with pytest.raises(ValueError, match="facet 1.*has no area"):
        polhode.shape.FacetShape([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])
    with pytest.raises(ValueError, match="places"):
        polhode.shape.FacetShape([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, -2]])
    path = tmp_path / "t.obj"
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in body.vertices.tolist()]
    lines += ["f " + " ".join(str(i + 1) for i in t) for t in body.triangles.tolist()]
    path.write_text("\n".join(lines))
    assert (polhode.shape.read_obj(str(path)).vertices == body.vertices).all()
    path.write_text("f 1 2\n")
    rejected(ValueError, ":1: got a facet of 2 corners", polhode.shape.read_obj, str(path))


def test_sunlight_and_air():
    surface = polhode.Surface.of_shape(shape(), [0.1, 0, 0], specular=0.2, diffuse=0.3, emitted=0.5)
    surface = surface + polhode.Surface.of_plate([0, 2, 0], [1, 0, 1], 3.0, both_sides=True)
    assert len(surface) == 6
    body = polhode.Body(2, 3, 4)
    q = np.array([0.5, -0.5, 0.1, 0.7])
    q /= np.linalg.norm(q)
    state = polhode.RotorState(q, [0, 0, 0])
    orbit = polhode.KeplerOrbit(polhode.KeplerElements(1.0, 2.0, 0.1, 0.3))
    sun = np.array([50.0, 20.0, -5.0])
    term = polhode.SolarPressure(surface, orbit, 3.0, 10.0, sun=lambda t: sun)
    to_sun = sun - orbit.position(0.4)
    r = np.linalg.norm(to_sun)
    e = polhode.charts.attitude_matrix(q) @ (to_sun / r)
    system = polhode.System(body, None, term)
    assert_allclose(polhode.rates.effect(system, 0.4, state).u,
                    3 * (10 / r) ** 2 * light_torque(surface, e), atol=budgets.figure_orbit)
    assert term.is_kick
    drag = polhode.AtmosphericDrag(surface, orbit, 0.2, 0.1, scale_height=0.5, density_radius=2.0)
    x = orbit.position(0.4)
    v = orbit.velocity(0.4) - np.cross([0, 0, 0.1], x)
    e = polhode.charts.attitude_matrix(q) @ v / np.linalg.norm(v)
    centre, n, area, _ = facets_of(surface)
    c = np.clip(n @ e, 0, None)
    want = -(
        0.2
        * np.exp((2 - np.linalg.norm(x)) / 0.5)
        * (v @ v)
        * np.cross((area * c)[:, None] * centre, e).sum(0)
    )
    assert_allclose(polhode.rates.effect(polhode.System(body, None, drag), 0.4, state).u, want,
                    atol=budgets.figure_orbit)
    for made in (term.surface, drag):
        assert copy.copy(made) == made
    assert pickle.loads(pickle.dumps(drag)) == drag
    rejected(ValueError, "AtmosphericDrag: density: got -1.0; expected", polhode.AtmosphericDrag,
             surface, orbit, -1.0, 0.0)
    rejected(TypeError, "velocity", polhode.AtmosphericDrag, surface, lambda t: [1, 0, 0], 1.0, 0.0)
    # its velocity is that in inertial axes
    with pytest.raises(TypeError):
        polhode.AtmosphericDrag(surface, orbit, 1.0, 0.0, axes="reference")
    with pytest.raises(ValueError, match="expected a key sun as well"):
        polhode.SolarPressure(surface, orbit, 1.0, 1.0, shadow="cylinder", shadow_radius=1.0)


def test_yorp_by_direct_quadrature():
    surface = polhode.Surface.of_shape(shape(), shape().vertices.mean(0), diffuse=0.3, emitted=1.0)
    turns = 2 * np.pi * (np.arange(240) + 0.5) / 240
    c, s, zero = np.cos(turns), np.sin(turns), np.zeros_like(turns)
    R = np.array([[c, -s, zero], [s, c, zero], [zero, zero, zero + 1]]).transpose(2, 0, 1)
    for obliquity in (0.2, 1.1):
        suns = np.stack([c, s * np.cos(obliquity), s * np.sin(obliquity)], axis=-1)
        total = sum(turn @ light_torque(surface, suns @ turn).sum(0) for turn in R)
        want = (total / len(turns) ** 2)[[2, 1, 0]]
        assert_allclose(
            polhode.shape.yorp_torque(surface, obliquity), want, atol=budgets.yorp_brute_force
        )
    many = polhode.shape.yorp_torque(surface, np.linspace(0, 3, 7))
    assert many.shape == (7, 3)
    assert_allclose(
        polhode.shape.mean_pressure(2.0, 1.0, 2.0, 0.6),
        2.0 / 4.0 / 0.8,
        rtol=budgets.chart_rounding,
    )


def test_the_page_says_what_discs_in_a_plane_cost():
    """Against rings of the Sun's disc on the sphere, 400 km above the Earth."""
    sun, earth = np.arcsin(695700 / 1.496e8), np.arcsin(6378 / 6778)
    surface = polhode.Surface.of_plate([0, 1, 0], [1, 0, 0], 1.0)
    state, body = polhode.RotorState([1, 0, 0, 0], [0, 0, 0]), polhode.Body(1, 1, 1)
    r = sun * (np.arange(2000) + 0.5) / 2000
    worst = 0.0
    for c in earth + sun * np.linspace(-0.98, 0.98, 41):
        place = -6778 * np.array([np.cos(c), np.sin(c), 0])
        light = polhode.SolarPressure(
            surface, lambda t, x=place: x, 1.0, 1.496e8,
            sun=lambda t, x=place: x + np.array([1.496e8, 0, 0]), shadow="cone",
            shadow_radius=6378.0, sun_radius=695700.0)
        visible = np.linalg.norm(
            polhode.rates.effect(polhode.System(body, None, light), 0, state).u
        )
        edge = (np.cos(earth) - np.cos(r) * np.cos(c)) / (np.sin(r) * np.sin(c))
        covered = np.arccos(np.clip(edge, -1, 1))
        rings = 1 - np.sum(np.sin(r) * covered) / np.pi / np.sum(np.sin(r))
        worst = largest(worst, abs(visible - rings))
    assert worst < budgets.shadow_plane
