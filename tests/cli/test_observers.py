# SPDX-License-Identifier: MIT
"""What observers and engineers write into a scenario and ask of it: dates, periods of either axis,
defaults, the local vertical, what a run has changed, notes on likely mistakes."""

import json
import math

import budgets
import numpy
import pytest
from closeness import assert_allclose

APOPHIS = """schema = 1
[units]
time = "h"
angle = "deg"
[body]
moments = [0.61, 0.965, 1.0]
[state]
{epoch}
axes = "ecliptic-J2000"
[state.tumbler]
{periods}
pole = {{ longitude = 250, latitude = -75 }}
mode = "SAM"
"""
LONG = "precession_period = 30.56\nrotation_period = 263"
EPOCH = 'epoch = "2013-01-05T00:00:00 UTC"'


def apophis(epoch=EPOCH, periods=LONG, rest=""):
    return APOPHIS.format(epoch=epoch, periods=periods) + rest


@pytest.fixture
def rows(run, table):
    """rows(text) -> columns by name"""

    def call(text, *arguments):
        done = run.ok("run", "-", *arguments, stdin=text)
        names, numbers = table(done.stdout)
        return dict(zip(names, numpy.array(numbers).T, strict=True))

    return call


@pytest.fixture
def info(run):
    """info(text) -> the lines of `polhode info --json`"""

    def call(text):
        done = run.ok("info", "--json", "-", stdin=text)
        return json.loads(done.stdout)

    return call


@pytest.fixture
def refusal(run):
    """refusal(text) -> the one line that says why not"""

    def call(text):
        done = run("info", "-", stdin=text)
        assert done.returncode == 2 and len(done.stderr.splitlines()) == 1, done.stderr
        return done.stderr

    return call


# --- dates ---


@pytest.mark.parametrize("start, stop", [
    ('"2013-01-05T06:00:00"', '"2013-01-06"'),
    ('"2013-01-05T06:00:00 UTC"', '"2013-01-06T00:00:00Z"'),
    ("2013-01-05T06:00:00Z", "2013-01-06"),  # as TOML has dates
    ('"JD 2456297.75 UTC"', '"JD 2456298.5"'),
    ('"2013-01-05T06:01:07.184 TT"', '"2013-01-06T00:00:35 TAI"'),  # 35 leap seconds, and 32.184 s
])
def test_start_and_stop_are_dates(rows, start, stop):
    c = rows(apophis(rest=f"[time]\nstart = {start}\nstop = {stop}\ncount = 4\n"))
    assert_allclose(c["t"], [6, 12, 18, 24], rtol=budgets.observer_columns)


def test_times_at_dates_count_leap_seconds(rows):
    text = apophis(epoch='epoch = "2016-12-31T00:00:00 UTC"',
                   rest='[time]\nat = [0, "1 h", "2017-01-01T00:00:00"]\n')
    c = rows(text.replace('"h"', '"s"').replace("30.56", "110016").replace("263", "946800"))
    assert list(c["t"]) == [0.0, 3600.0, 86401.0]


@pytest.mark.parametrize("epoch", ['"2013-01-05T00:00:00Z"', "2013-01-05T00:00:00Z"])
def test_z_is_utc(info, epoch):
    assert info(apophis(epoch=f"epoch = {epoch}"))["epoch"] == "2013-01-05T00:00:00 UTC"


def test_a_date_that_cannot_be_says_why(refusal):
    end = "[time]\nstop = {}\nstep = 1\n"
    assert "a date needs epoch in [state]" in refusal(
        apophis(epoch="", rest=end.format('"2013-01-06"')))
    assert "month 13 must be from 1 to 12" in refusal(
        apophis(rest=end.format('"2013-13-06"')))
    assert "or a date such as" in refusal(apophis(rest=end.format("true")))
    assert "time.stop" in refusal(apophis(rest=end.format('"2013-13-06"')))


@pytest.mark.parametrize("word, ours", [
    ("ICRF", "equator-J2000"), ("J2000", "equator-J2000"), ("EME2000", "equator-J2000"),
    ("ecliptic", "ecliptic-J2000"),
])
def test_axes_by_the_names_of_others_get_a_hint(refusal, word, ours):
    assert f'did you mean "{ours}"?' in refusal(apophis().replace("ecliptic-J2000", word))


def test_a_start_after_stop_is_what_the_error_names(refusal):
    assert "time.start: got 10; expected a time before stop" in refusal(
        apophis(rest="[time]\nstart = 10\nstop = 5\nstep = 1\n"))
    # without a start, or back from it, the step is the likely mistake
    assert "time.step: got 1" in refusal(apophis(rest="[time]\nstop = -5\nstep = 1\n"))
    assert "time.step: got -1" in refusal(
        apophis(rest="[time]\nstart = -10\nstop = 5\nstep = -1\n"))


# --- periods and defaults ---


@pytest.mark.parametrize("mode", ["SAM", "LAM"])
def test_the_period_of_the_short_axis_gives_the_same_motion(info, mode):
    text = apophis().replace("SAM", mode)
    given = info(text)
    short = given["short_axis_period"]["value"]
    again = info(text.replace("precession_period = 30.56", f"short_axis_period = {short!r}"))
    for key in ("precession_period", "rotation_period", "momentum", "energy"):
        assert_allclose(again[key]["value"], given[key]["value"], rtol=budgets.observer_columns)


def test_published_period_of_the_short_axis(info):
    # Pravec et al. (2014): P_phi = 27.38 h, P_psi = 263 h, P_1 = 30.56 h, E/E0 = 1.024
    line = info(apophis(periods="short_axis_period = 27.38\nrotation_period = 263"))
    assert abs(line["precession_period"]["value"] - 30.56) < budgets.published_hours
    assert abs(line["energy_ratio"]["value"] - 1.024) < 0.001


def test_periods_that_cannot_be_name_the_key(refusal):
    assert "short_axis_period: got 300; expected a period shorter than rotation_period" in refusal(
        apophis(periods="short_axis_period = 300\nrotation_period = 263"))
    assert "expected exactly one of" in refusal(
        apophis(periods=LONG + "\nshort_axis_period = 27.38"))


def test_andoyer_needs_only_what_a_question_needs(info):
    body = "schema = 1\n[body]\nmoments = [1, 2, 2.5]\n[state.andoyer]\nL = 0.8\nG = 1.0\n"
    short = info(body)
    full = info(body + "l = 0\ng = 0\nh = 0\nH = 1.0\n")
    assert short.pop("state_andoyer_defaults") == "g = 0, h = 0, l = 0, H = G"
    assert short == full
    assert_allclose(short["pole"]["value"][1], math.pi / 2, rtol=budgets.observer_columns)


# --- what info and runs say ---


@pytest.mark.parametrize("mode", ["SAM", "LAM"])
def test_angles_of_the_axes_are_those_of_a_polhode(info, rows, mode):
    text = apophis().replace("SAM", mode)
    line = info(text)
    c = rows(text + "[time]\nstop = 263\ncount = 8001\n[output]\ncolumns = [\"g\"]\n")
    g = numpy.array([c["g1"], c["g2"], c["g3"]])
    angles = numpy.degrees(numpy.arccos(g / numpy.linalg.norm(g, axis=0)))
    for key, axis in (("long_axis_angles", 0), ("short_axis_angles", 2)):
        found = angles[axis].min(), angles[axis].max()
        assert_allclose(line[key]["value"], found, atol=budgets.sampled_extreme_deg)


def test_angles_on_the_far_side(info, rows):
    text = ("schema = 1\n[units]\nangle = \"deg\"\n[body]\nmoments = [1, 2, 2.5]\n"
            "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nmomentum_body = [0.3, 0.2, -1]\n")
    line = info(text)
    period = line["rotation_period"]["value"]
    c = rows(text + f"[time]\nstop = {period!r}\ncount = 8001\n[output]\ncolumns = [\"g\"]\n")
    angle = numpy.degrees(numpy.arccos(
        c["g3"] / numpy.sqrt(c["g1"] ** 2 + c["g2"] ** 2 + c["g3"] ** 2)))
    assert_allclose(line["short_axis_angles"]["value"], [angle.min(), angle.max()],
                    atol=budgets.sampled_extreme_deg)
    assert angle.min() > 90


def test_a_pure_spin_has_a_limiting_wobble(info):
    line = info("schema = 1\n[body]\nmoments = [2.0, 3.0, 4.0]\n[state.attitude-rate]\n"
                "quaternion = [1, 0, 0, 0]\nomega_body = [0.0, 0.0, 0.5]\n")
    # Euler: w sqrt((C - A)(C - B)/(A B))
    assert_allclose(line["wobble_period"]["value"], 2 * math.pi / (0.5 * math.sqrt(2 * 1 / 6)),
                    rtol=budgets.observer_columns)
    assert_allclose(line["energy_ratio"]["value"], 1, rtol=budgets.observer_columns)
    assert "long_axis_angles" not in line
    # about the axis of the least moment, C/A of the least energy
    line = info("schema = 1\n[body]\nmoments = [2.0, 3.0, 4.0]\n[state.attitude-rate]\n"
                "quaternion = [1, 0, 0, 0]\nomega_body = [0.5, 0.0, 0.0]\n")
    assert_allclose(line["energy_ratio"]["value"], 2, rtol=budgets.observer_columns)


def test_a_perturbed_run_ends_with_before_and_after(run, rows, tmp_path):
    text = apophis(rest='[[perturbation]]\nkind = "constant-torque"\ntorque = [0, 0, 1e-5]\n'
                        'axes = "body"\n[time]\nstop = 100\nstep = 50\n'
                        '[output]\ncolumns = ["tumbler", "pole"]\n')
    path = tmp_path / "a.toml"
    path.write_text(text, "utf-8")
    done = run.ok("run", path, "--out", tmp_path / "a.csv")
    # the last line is how to draw it
    before, after = (line.split(None, 4) for line in done.stdout.splitlines()[-3:-1])
    assert before[:4] == ["at", "t", "=", "0"] and after[:4] == ["at", "t", "=", "100"]
    c = rows(text)
    for words, k in ((before[4], 0), (after[4].partition("h")[2], -1)):
        fields = dict(part.strip().split(" ", 1) for part in words.replace("pole ", "pole=").split(
            ", ") if " " in part.strip())
        assert "SAM" in words
        for name in ("P_phi", "P_psi"):
            printed, exact = float(fields[name].split()[0]), c[name][k]
            assert abs(printed - exact) < budgets.printed_period * exact
        longitude = float(words.partition("pole ")[2].split(",")[0])
        assert abs(longitude - c["pole_lon"][k]) < budgets.printed_pole
    free = run("run", "-", "--out", tmp_path / "b.csv", stdin=apophis(
        rest="[time]\nstop = 100\nstep = 50\n"))
    assert "at t = " not in free.stdout  # nothing has changed


# --- local vertical ---

GM, A, E = 398600.4418, 9000.0, 0.25
INCLINATION, NODE, ARGUMENT, MEAN = 50.0, 30.0, 40.0, 20.0
SATELLITE = f"""schema = 1
[units]
angle = "deg"
moment = "kg m2"
length = "km"
[body]
moments = [100.0, 110.0, 20.0]
[orbit.earth]
gm = "{GM} km3/s2"
semi_major_axis = {{a}}
eccentricity = {{e}}
inclination = {INCLINATION}
node = {NODE}
pericentre_argument = {ARGUMENT}
mean_anomaly = {{mean}}
{{rates}}
[frame.local-vertical]
orbit = "earth"
[state.attitude-rate]
quaternion = {{q}}
omega_relative = {{rate}}
"""


def satellite(a=A, e=E, mean=MEAN, q="[1, 0, 0, 0]", rate="[0, 0, 0]", rates=""):
    return SATELLITE.format(a=a, e=e, mean=mean, q=q, rate=rate, rates=rates)


def position_and_velocity(t, a=A, e=E, node_rate=0.0):
    """Kepler's problem by Newton's method and rotation matrices."""
    n = math.sqrt(GM / a**3)
    mean = math.radians(MEAN) + n * t
    anomaly = mean
    for _ in range(50):
        anomaly -= (anomaly - e * math.sin(anomaly) - mean) / (1 - e * math.cos(anomaly))
    x, y = a * (math.cos(anomaly) - e), a * math.sqrt(1 - e * e) * math.sin(anomaly)
    rate = n / (1 - e * math.cos(anomaly))
    u, v = -a * math.sin(anomaly) * rate, a * math.sqrt(1 - e * e) * math.cos(anomaly) * rate

    def about(axis, angle):
        c, s = math.cos(angle), math.sin(angle)
        return numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]] if axis == 3 else
                           [[1, 0, 0], [0, c, -s], [0, s, c]])

    turn = (about(3, math.radians(NODE) + node_rate * t) @ about(1, math.radians(INCLINATION))
            @ about(3, math.radians(ARGUMENT)))
    return turn @ [x, y, 0], turn @ [u, v, 0]


def lvlh(t, **orbit):
    """Columns: the axes of the local vertical, from position and velocity."""
    r, v = position_and_velocity(t, **orbit)
    z, h = -r / numpy.linalg.norm(r), numpy.cross(r, v)
    y = -h / numpy.linalg.norm(h)
    return numpy.column_stack([numpy.cross(y, z), y, z])


def matrix(w, x, y, z):
    return numpy.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def frame_of(c, k):
    """Axes of the frame in row k: the attitude in inertial axes, after that in the frame."""
    inertial = matrix(*(c[f"Q{i}"][k] for i in "wxyz"))
    return inertial @ matrix(*(c[f"q{i}"][k] for i in "wxyz")).T


def test_the_frame_is_the_local_vertical_of_an_elliptic_orbit(rows):
    c = rows(satellite() + "[time]\nstop = 30000\ncount = 301\n"
                           '[output]\ncolumns = ["q", "q_inertial"]\n')
    for k in range(0, 301, 5):
        assert_allclose(frame_of(c, k), lvlh(c["t"][k]), atol=budgets.local_vertical)
    q = numpy.array([c[f"q{i}"] for i in "wxyz"])
    # no jump of the sign, for some turns of the orbit
    assert numpy.all(numpy.sum(q[:, 1:] * q[:, :-1], axis=0) > 0.5)


def test_a_node_that_moves_takes_the_plane_along(rows):
    c = rows(satellite(rates='node_rate = "-5 deg/d"') + "[time]\nstop = 86400\ncount = 25\n"
             '[output]\ncolumns = ["q", "q_inertial"]\n')
    rate = math.radians(-5) / 86400
    for k in range(25):
        assert_allclose(frame_of(c, k), lvlh(c["t"][k], node_rate=rate),
                        atol=budgets.local_vertical)


def test_a_body_at_rest_in_it_turns_with_the_orbit(rows):
    c = rows(satellite() + "[time]\nstop = 10\ncount = 2\n"
                           '[output]\ncolumns = ["omega", "omega_rel", "roll_pitch_yaw"]\n')
    r, v = position_and_velocity(0.0)
    rate = numpy.linalg.norm(numpy.cross(r, v)) / (r @ r)  # h/r^2
    assert_allclose([c["w1"][0], c["w2"][0], c["w3"][0]], [0, -math.degrees(rate), 0],
                    atol=budgets.local_vertical)
    assert abs(c["roll"][0]) + abs(c["pitch"][0]) + abs(c["yaw"][0]) < budgets.local_vertical


GRAVITY = '[[perturbation]]\nkind = "gravity-gradient"\norbit = "earth"\n'


def test_small_pitch_has_the_period_of_the_textbooks(run, tmp_path):
    # Wertz (1978), section 16.2: n sqrt(3 (I_roll - I_yaw)/I_pitch) on a circular orbit
    half = 0.5e-4
    path, events = tmp_path / "s.toml", tmp_path / "e.csv"
    path.write_text(satellite(e=0.0, q=f"[{math.cos(half)!r}, 0, {math.sin(half)!r}, 0]") + GRAVITY
                    + '[[event]]\ncolumn = "pitch"\ncrossing = "rising"\n'
                    "[time]\nstop = 60000\ncount = 2\n[output]\ncolumns = [\"roll_pitch_yaw\"]\n")
    run.ok("run", path, "--events", events)
    lines = [line.split(",") for line in events.read_text().splitlines() if line[0] != "#"][1:]
    times = [float(line[1]) for line in lines]
    n = math.sqrt(GM / A**3)
    period = 2 * math.pi / (n * math.sqrt(3 * (100 - 20) / 110))
    assert len(times) > 5
    assert_allclose(numpy.diff(times), period, rtol=budgets.small_libration)


def test_an_elliptic_orbit_forces_the_pitch(rows):
    # delta'' + 3 K delta = 2 e sin M about the normal (Beletskii), so A sin M with
    # A = 2 e/(3 K - 1); pitch is about axis 2, against the normal
    e, K = 1e-5, (100 - 20) / 110
    amplitude = 2 * e / (3 * K - 1)
    n = math.sqrt(GM / A**3)
    start = -math.degrees(amplitude * n)
    c = rows(satellite(e=e, mean=0.0, rate=f"[0, {start!r}, 0]") + GRAVITY
             + "[time]\nstop = 20000\ncount = 101\n[output]\ncolumns = [\"roll_pitch_yaw\"]\n")
    expected = -math.degrees(amplitude) * numpy.sin(n * c["t"])
    assert_allclose(c["pitch"], expected, atol=budgets.small_libration * 10)
    assert numpy.max(numpy.abs(c["roll"])) + numpy.max(numpy.abs(c["yaw"])) < budgets.local_vertical


@pytest.mark.parametrize("roll, pitch, yaw", [(10, 20, 30), (-170, -80, 100), (0, 0, -179)])
def test_roll_pitch_and_yaw_are_the_sequence_of_flight(rows, roll, pitch, yaw):
    def about(axis, degrees):
        half = math.radians(degrees) / 2
        q = numpy.zeros(4)
        q[0], q[axis] = math.cos(half), math.sin(half)
        return q

    def product(a, b):
        return numpy.array([a[0] * b[0] - a[1:] @ b[1:],
                            *(a[0] * b[1:] + b[0] * a[1:] + numpy.cross(a[1:], b[1:]))])

    q = product(product(about(3, yaw), about(2, pitch)), about(1, roll))
    c = rows(satellite(q=str([float(x) for x in q])) + "[time]\nat = [0]\n"
             '[output]\ncolumns = ["roll_pitch_yaw"]\n')
    assert_allclose([c["roll"][0], c["pitch"][0], c["yaw"][0]], [roll, pitch, yaw],
                    atol=budgets.roll_pitch_yaw_deg)


def test_upright_pitch_has_its_turn_in_roll(rows):
    h = math.sqrt(0.5)
    c = rows(satellite(q=f"[{h!r}, 0, {h!r}, 0]") + "[time]\nat = [0]\n"
             '[output]\ncolumns = ["roll_pitch_yaw"]\n')
    assert_allclose([c["roll"][0], c["pitch"][0], c["yaw"][0]], [0, 90, 0],
                    atol=budgets.roll_pitch_yaw_deg)


def test_the_local_vertical_wants_an_orbit_with_elements(refusal):
    text = satellite().replace('orbit = "earth"', 'orbit = "moon"', 1)
    assert 'frame.local-vertical.orbit: got "moon"' in refusal(text)


# --- notes ---


def test_an_orbit_inside_its_body_gets_a_note(info):
    assert "inside the Earth (6371 km)" in info(satellite(a=700.0, e=0.0))["orbit_earth_note"]
    assert "orbit_earth_note" not in info(satellite(a=7000.0, e=0.0))
    # the same in other units
    far = satellite(a=0.7, e=0.0).replace('length = "km"', 'length = "R_e"')
    assert "inside the Earth" in info(far)["orbit_earth_note"]
    sun = satellite(a=0.7, e=0.0).replace('length = "km"', 'length = "au"').replace(
        str(GM), "1.32712440041e11")
    assert "orbit_earth_note" not in info(sun)


def test_a_quaternion_that_looks_scalar_last_gets_a_note(info):
    body = ("schema = 1\n[body]\nmoments = [1, 2, 2.5]\n[state.attitude-rate]\n"
            "omega_body = [0, 0, 1]\n")
    assert "scalar last" in info(body + "quaternion = [0, 0, 0, 1]\n")["quaternion_note"]
    assert "scalar last" in info(body + "quaternion = [0.05, 0, 0, -0.99]\n")["quaternion_note"]
    assert "quaternion_note" not in info(body + "quaternion = [1, 0, 0, 0]\n")
    assert "quaternion_note" not in info(body + "quaternion = [0.5, 0.5, 0.5, 0.5]\n")
    angles = body + "quaternion = [1, 0, 0, 0]\n[output]\ncolumns = [\"roll_pitch_yaw\"]\n"
    assert "[frame.local-vertical]" in info(angles)["roll_pitch_yaw_note"]
