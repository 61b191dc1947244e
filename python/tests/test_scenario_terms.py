# SPDX-License-Identifier: MIT
"""Every kind of perturbation along every kind of orbit: from a file to the objects that make it,
the torque that its numbers say, and back to a file of the same run."""

import pickle

import budgets
import numpy as np
import polhode
import pytest
import torques_by_hand
from closeness import assert_allclose
from polhode import (
    Body,
    DipoleField,
    EddyCurrents,
    GravityGradient,
    InternalDamping,
    KeplerElements,
    KeplerOrbit,
    PrecessingKeplerOrbit,
    ResidualDipole,
    RotorState,
    Scenario,
    SolarPressure,
    Surface,
    System,
    TableOrbit,
    TorqueTable,
    TurnedKeplerOrbit,
)
from polhode.charts import attitude_matrix
from polhode.satellites import SecularRates
from public_names import PUBLIC

HEAD = """\
schema = 1
[units]
angle = "deg"
moment = "kg m2"
length = "km"
[body]
tensor = [[17.0, 0.4, -2.1], [0.4, 124.0, 0.3], [-2.1, 0.3, 129.0]]
[state]
epoch = "2013-05-07T10:57:14.5 UTC"
axes = "ecliptic-J2000"
[state.attitude-rate]
quaternion = [0.47, 0.50, -0.41, 0.59]
omega_body = [-0.05, 0.21, 2.8]
[frame.precessing]
axis = [0.1, 0.2, 1]
rate = 1e-4
[[surface]]
position = [0.001, 0.002, 0]
normal = [1, 1, 0]
area = "10 m2"
sides = 2
diffuse = 0.3
[[surface]]
position = [0, 0.001, 0.003]
normal = [0, 0.3, 1]
area = "2 m2"
specular = 0.5
normal_accommodation = 0.7
[time]
stop = 60
count = 4
"""

# name: [orbit.it], and its class
ORBITS = {
    "kepler": ("gm = 398600.4418\nsemi_major_axis = 7144\neccentricity = 0.01\ninclination = 98\n",
               KeplerOrbit),
    "precessing": ("gm = 398600.4418\nperiod = 6000\nnode = 7\nnode_rate = \"1 deg/d\"\n",
                   PrecessingKeplerOrbit),
    "state": ("kind = \"state\"\ngm = 398600.4418\nposition = [7000, 100, 300]\n"
              "velocity = [-0.5, 5, 5.6]\n", KeplerOrbit),
    "turned": ("kind = \"state\"\ngm = 398600.4418\nposition = [7000, 100, 300]\n"
               "velocity = [-0.5, 5, 5.6]\nJ2 = 1.0826e-3\nradius = 6378.137\n"
               "axes = \"equator-J2000\"\n", TurnedKeplerOrbit),
    "elements": ("gm = 398600.4418\nsemi_major_axis = 7144\ninclination = 51\n"
                 "axes = \"equator-J2000\"\n", TurnedKeplerOrbit),
    "rows": ("kind = \"table\"\ngm = 398600.4418\ntimes = [-10, 20, 50, 80, 100]\n"
             "x = [7000, 6999, 6997, 6993, 6990]\ny = [0, 225, 450, 675, 825]\n"
             "z = [1, 2, 3, 4, 5]\nvx = [0.1, 0, -0.1, -0.2, -0.3]\n"
             "vy = [7.5, 7.5, 7.5, 7.5, 7.5]\nvz = [0.03, 0.03, 0.03, 0.03, 0.03]\norder = 8\n",
             TableOrbit),
    "ephemeris": ("kind = \"ephemeris\"\ntarget = \"moon\"\ncentre = \"earth\"\n", TableOrbit),
}
SUN = "[orbit.sun]\nkind = \"ephemeris\"\ntarget = \"sun\"\ncentre = \"earth\"\n"
DIPOLE = (
    "gauss = { value = [-29460.05, -1529.25, 4845.77], unit = \"nT\" }\n"
    "reference_radius = 6371.2\npole = [0.1, 0.2, 1]\nrotation_rate = \"361 deg/d\"\n"
    "meridian = 29.7\nmeridian_epoch = 3\n"
)
LIGHT = (
    "kind = \"solar-pressure\"\norbit = \"it\"\npressure = \"4.54e-6 N/m2\"\n"
    "pressure_distance = \"1 au\"\n"
)
DRAG = "kind = \"drag\"\norbit = \"it\"\ndensity = \"1e-12 kg/m3\"\n"
GRAVITY = "kind = \"gravity-gradient\"\norbit = \"it\"\n"

# name: [[perturbation]], and the classes of its terms
ALONG = {
    "gravity": (GRAVITY, "GravityGradient"),
    "own gm": (GRAVITY + "gm = 4e5\n", "GravityGradient"),
    "higher": (GRAVITY + "orbit_of = \"attractor\"\n"
               "third_moments = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]\n",
               "GravityGradient"),
    "all degrees": (GRAVITY + "orbit_of = \"body\"\n"
                    "fourth_moments = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]\n"
                    "J2 = 1e-3\nprimary_radius = 6378\npole = [0, 0.3, 0.9]\n",
                    "GravityGradient"),
    "tide": ("kind = \"tide\"\norbit = \"it\"\nmass = \"1e3 kg\"\nk2 = 0.02\ntime_lag = 600\n"
             "radius = 100\n", "TidalTorque"),
    "light": (LIGHT + "orbit_of = \"attractor\"\n", "SolarPressure"),
    "cylinder": (LIGHT + "sun = \"sun\"\nshadow = \"cylinder\"\nshadow_radius = 600\n",
                 "SolarPressure"),
    "cone": (LIGHT + "sun = \"sun\"\nsun_orbit_of = \"attractor\"\nshadow = \"cone\"\n"
             "shadow_radius = 600\nsun_radius = 695700\n", "SolarPressure"),
    "drag": (DRAG + "air_rate = 0\n", "AtmosphericDrag"),
    "thinning air": (DRAG + "orbit_of = \"attractor\"\nscale_height = 1e5\ndensity_radius = 7000\n"
                     "air_rate = \"361 deg/d\"\nair_pole = [0.1, -0.2, 0.7]\nexit_speed = 0.5\n",
                     "AtmosphericDrag"),
    "magnet": ("kind = \"residual-dipole\"\norbit = \"it\"\n"
               "moment = { value = [1, 2, 3], unit = \"A m2\" }\n" + DIPOLE, "ResidualDipole"),
    "eddy": ("kind = \"eddy-currents\"\norbit = \"it\"\nfield_rate = false\n"
             "tensor = { value = [[9, 1, 0], [1, 8, 2], [0, 2, 7]], unit = \"S m4\" }\n" + DIPOLE,
             "EddyCurrents"),
}
TABLE = "kind = \"torque-table\"\ntimes = [0, 10, 10.5, 70]\ntorque_2 = [5e-6, 1e-5, 2e-5, 3e-5]\n"
OWN = {
    "push": ("kind = \"constant-torque\"\ntorque = [1e-6, 2e-6, 3e-6]\n", "ConstantTorque"),
    "push in space": ("kind = \"constant-torque\"\ntorque = [1e-6, 2e-6, 3e-6]\n"
                      "axes = \"inertial\"\n", "ConstantTorque"),
    "drag": ("kind = \"damping\"\ncoefficients = [[3, 0.1, 0], [0.1, 2, 0.2], [0, 0.2, 1]]\n",
             "LinearDamping"),
    "wobble": ("kind = \"internal-damping\"\nwobble_time = 1000\nrate = 2.8\n", "InternalDamping"),
    "k": ("kind = \"internal-damping\"\nk = [0.1, 0.2, 0.3]\n", "InternalDamping"),
    "rock": ("kind = \"anelastic-damping\"\nrigidity = 1e-4\nquality_factor = 100\n"
             "body_density = 2\nradius = 0.01\nshape_factor = 0.05\n", "AnelasticDamping"),
    "steps": (TABLE + "between = \"step\"\n", "TorqueTable"),
    "cubics": (TABLE + "between = \"cubic\"\noutside = \"error\"\naxes = \"inertial\"\n",
               "TorqueTable"),
}


def rebuilt(given):
    return Scenario.build(given.system, given.state, given.time, given.method,
                          columns=given.columns, units=given.units, epoch=given.epoch,
                          axes=given.axes, orbits=given.orbits)


T = 1.0


MOON = 4902.8  # km3 / s2


def place_of(given):
    """Where the first state is put without its frame, along the orbits of the scenario at T."""
    R = attitude_matrix(given.body.q_FB)
    scale = budgets.numpy_formula * given.body.moments[2]
    assert_allclose(R @ torques_by_hand.TENSOR @ R.T, np.diag(given.body.moments), atol=scale)
    orbit, sun = given.orbits.get("it"), given.orbits.get("sun")
    gm = torques_by_hand.GM
    if given.orbits and isinstance(given.orbits["it"], TableOrbit) and "gm =" not in given.text:
        (gm,) = {t.arguments["gm"] for t in given.system.terms if "gm" in t.arguments} or {MOON}
        assert_allclose(gm, MOON, rtol=budgets.ephemeris_gm)
        gm = 1e9 * gm
    return torques_by_hand.Place(
        given.body.moments, R, attitude_matrix(given.initial_state.q), given.initial_state.g, T,
        *(1e3 * (f(T) if f else np.ones(3)) for f in (
            orbit and orbit.position, orbit and orbit.velocity, sun and sun.position)), gm,
    )


def expect_torque(given, want, where):
    """Of all terms together, in SI units: of torques the moments' kg m2 / s2."""
    got = polhode.rates.effect(System(given.body, None, given.system.terms), T, given.initial_state)
    for mine, right in zip((got.u, got.v), want(where), strict=True):
        size = np.linalg.norm(right)
        assert_allclose(mine, right, atol=budgets.scenario_torque * size)


def check(text, classes, want):
    given = Scenario.from_text(text)
    expect_torque(given, want, place_of(given))
    terms = given.system.terms
    assert [type(term).__name__ for term in terms] == classes.split()
    effect = polhode.rates.effect(given.system, 1.0, given.initial_state)
    at_rest = polhode.rates.effect(System(given.body, given.frame), 1.0, given.initial_state)
    assert np.any(effect.u != at_rest.u) or np.any(effect.v != at_rest.v)  # it acts
    made = rebuilt(given)
    assert made.system == given.system and made.initial_state == given.initial_state
    assert made.run() == given.run()
    assert rebuilt(made).text == made.text
    return given


@pytest.mark.parametrize("kind", ALONG)
@pytest.mark.parametrize("orbit", ORBITS)
def test_a_term_along_an_orbit_comes_back(kind, orbit):
    table, classes = ALONG[kind]
    keys, orbit_class = ORBITS[orbit]
    text = HEAD + "[orbit.it]\n" + keys + SUN + "[[perturbation]]\n" + table
    given = check(text, classes, torques_by_hand.ALONG[kind])
    assert all(type(t.arguments["orbit"]) is orbit_class for t in given.system.terms)
    assert type(given.orbits["it"]) is orbit_class


@pytest.mark.parametrize("kind", OWN)
def test_a_torque_of_the_bodys_own_comes_back(kind):
    table, classes = OWN[kind]
    check(HEAD + "[[perturbation]]\n" + table, classes, torques_by_hand.OWN[kind])


def test_columns_of_a_tensor_stay_along_its_axes():
    given = Scenario.from_text(HEAD)
    made = rebuilt(given)
    assert made.body == given.body and made.to_dict()["body"].keys() == {"moments", "column_axes"}
    assert made.run()["w1"].tobytes() == given.run()["w1"].tobytes()


BODY = Body(1.0, 1.9, 2.3)
START = RotorState([1, 0, 0, 0], [0.1, 0.2, 2.0])
ORBIT = KeplerOrbit(KeplerElements(0.7, 1.1, 0.01))
POINT = GravityGradient(ORBIT, 0.7)
ALL = GravityGradient(ORBIT, third_moments=np.ones(10), fourth_moments=np.ones(15),
                      orbit_of="body", J2=0.1, primary_radius=0.5, name="all degrees")
PLATE = Surface.of_plate((1, 0, 0), (0, 1, 0), 1.0)
REFUSED = [
    ([SolarPressure(PLATE, ORBIT, 1.0, 1.0),
      SolarPressure(PLATE + PLATE, ORBIT, 1.0, 1.0, name="second")],
     "term \"second\": a scenario has one surface"),
    ([SolarPressure(PLATE, lambda t: (1, 0, 0), 1.0, 1.0)], "its orbit <function"),
    ([ResidualDipole((0, 0, 1), field=lambda t: (1, 2, 3), name="magnet")],
     "term \"magnet\": its field <function"),
    ([GravityGradient(TurnedKeplerOrbit.from_equator(
        PrecessingKeplerOrbit(ORBIT.elements, SecularRates())), 0.7)],
     "has no place in a scenario with axes=\"inertial\""),
]


@pytest.mark.parametrize(("terms", "message"), REFUSED)
def test_what_a_file_cannot_say_is_named(terms, message):
    with pytest.raises(ValueError) as error:
        Scenario.build(System(BODY, terms=terms), START)
    assert message in str(error.value)


def test_objects_of_python_become_tables_of_their_kind():
    field = DipoleField((1, 2, 3), (0, 0, 1), 0.1, 0.2, 0.3)
    times = np.linspace(0.0, 4.0, 9)
    path = TableOrbit(times, np.column_stack([np.cos(times), np.sin(times), 0 * times]))
    terms = [
        POINT, ALL, GravityGradient(path, 0.3), EddyCurrents((1, 2, 3), path, field=field),
        ResidualDipole((1, 2, 3), field=(0.1, 0.2, 0.3)),
        InternalDamping(wobble_time=10.0, rate=2.0, body=BODY),
        TorqueTable([0, 1, 5], *np.eye(3)),
    ]
    system = System(BODY, terms=terms)
    made = Scenario.build(system, START, (0, 4, 1), polhode.Adaptive(1e-10), columns="g")
    kinds = [table["kind"] for table in made.to_dict()["perturbation"]]
    assert kinds == ["gravity-gradient"] * 3 + [
        "eddy-currents", "residual-dipole", "internal-damping", "torque-table"]
    assert made.orbits["orbit-2"] == path and len(made.orbits) == 2
    problem = polhode.Problem(system, START, 0.0, 4.0, polhode.Adaptive(1e-10))
    there = polhode.integrate(problem, made.time).states
    assert np.array_equal(np.column_stack([made.run()[g] for g in ("g1", "g2", "g3")]), there.g)


def test_terms_tell_what_they_were_made_of():
    assert POINT.arguments == {
        "orbit": ORBIT, "gm": 0.7, "third_moments": None, "fourth_moments": None,
        "orbit_of": "body", "J2": None, "pole": None, "primary_radius": None,
        "axes": "inertial", "name": None}
    assert POINT == GravityGradient(ORBIT)  # gm is that of the orbit
    wobble = InternalDamping(wobble_time=10.0, rate=2.0, body=BODY)
    assert wobble.wobble_time is None and not wobble.grows and wobble.body is None
    k = wobble.k
    assert InternalDamping(k).k.tolist() == k.tolist() and k[0] == k[1] == k[2] > 0


def test_every_class_of_terms_of_files_comes_back():
    classes = {cls.__name__ for cls in polhode.types.AnyPerturbation.__subclasses__()
               if not cls.__name__.startswith("_")}
    tried = {name for _, name in [*ALONG.values(), *OWN.values()]}
    assert tried == classes - {"TorqueTerm", "HamiltonianTerm", "MomentumTerm"}


def test_a_turned_orbit_is_the_orbit_seen_from_other_axes():
    inner = PrecessingKeplerOrbit(KeplerElements(1.0, 1.0, 0.0), SecularRates(node=0.1))
    orbit = TurnedKeplerOrbit(inner, 0.5)
    x, y, z = inner.position(0.7)
    c, s = np.cos(0.5), np.sin(0.5)
    assert_allclose(orbit.position(0.7), (x, c * y + s * z, c * z - s * y),
                    rtol=budgets.numpy_formula)
    np.testing.assert_array_equal(orbit([0.7])[0], orbit.position(0.7))
    assert orbit == TurnedKeplerOrbit(inner, 0.5) != TurnedKeplerOrbit.from_equator(inner)
    assert hash(orbit) == hash(TurnedKeplerOrbit(inner, 0.5))
    assert eval(repr(orbit), {**PUBLIC}) == orbit


def test_an_orbit_through_a_state_is_pickled_to_the_bit():
    orbit = KeplerOrbit.from_state((1.0, 0.1, 0.2), (0.1, 0.9, -0.3), 0.7, 0.5)
    again = pickle.loads(pickle.dumps(orbit))
    t = np.linspace(-50.0, 50.0, 101)
    assert again == orbit and again.position(t).tobytes() == orbit.position(t).tobytes()
    assert orbit.state[1].tolist() == [0.1, 0.9, -0.3]
    by_elements = KeplerOrbit(orbit.elements)
    assert by_elements.state is None and by_elements != orbit


def test_orbits_keep_the_names_given_for_them():
    other = KeplerOrbit(KeplerElements(gm=2.0, pericentre=3.0, eccentricity=0.1))
    terms = [POINT, GravityGradient(other, 2.0), GravityGradient(ORBIT, 3.0)]
    named = Scenario.build(System(BODY, terms=terms), START, orbits={"orbit-1": other})
    assert named.orbits == {"orbit-2": ORBIT, "orbit-1": other}
    with pytest.raises(ValueError, match="orbits: got the name 'the moon'; expected 1 to 60"):
        Scenario.build(BODY, START, orbits={"the moon": ORBIT})
    with pytest.raises(TypeError, match="orbits: \"moon\": got 3; expected one of KeplerOrbit"):
        Scenario.build(BODY, START, orbits={"moon": 3})


def test_table_orbits_compare_by_their_rows():
    t = np.linspace(0.0, 4.0, 12)
    x = np.column_stack([t, t**2, 0 * t])
    orbit = TableOrbit(t, x, order=4)
    assert orbit == TableOrbit(t, x, order=4) and hash(orbit) == hash(TableOrbit(t, x, order=4))
    assert orbit != TableOrbit(t, x, order=6) and orbit != TableOrbit(t, 2 * x, order=4)
    assert orbit.velocities is None
    assert TableOrbit(t, x, x).velocities.tolist() == x.tolist()
