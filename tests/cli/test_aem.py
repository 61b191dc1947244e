# SPDX-License-Identifier: MIT
"""CCSDS Attitude Ephemeris Messages: what `polhode run` writes, an independent reader reads."""

import gzip
import math
import re
import subprocess

import budgets
import numpy
import pytest
from ccsds_ndm.ndm_io import NdmIo
from closeness import assert_allclose
from scipy.interpolate import BarycentricInterpolator, KroghInterpolator
from scipy.spatial.transform import Rotation

HEAD = 'schema = 1\ntitle = "A body"\n[units]\ntime = "min"\nangle = "deg"\n'
BODY = "[body]\nmoments = [1, 2, 2.5]\n"
STATE = ('[state]\nepoch = "{epoch}"\naxes = "{axes}"\n[state.attitude-rate]\n'
         "quaternion = {q}\nomega_body = [3, 20, 100]\n")
TIME = "[time]\nstart = {start}\nstop = {stop}\nstep = {step}\n"
GENERIC = "[0.1, 0.7, -0.5, 0.4]"


ANDOYER_AEM = """schema = 1
[body]
moments = [1, 2, 2.5]
[state]
epoch = "2029-04-13T21:46:00 TDB"
[state.andoyer]
l = 0.1
g = 0.2
h = 0.3
L = 0.5
G = 1
H = 0.1
[time]
stop = 1
step = 0.5
[output.aem]
creation_date = "yesterday"
"""


def text(aem="", epoch="2029-04-13T21:46:00 TDB", axes="equator-J2000", q=GENERIC, start=0,
         stop=3, step=0.25, columns='"q", "omega"', more=""):
    """In version 1, which the independent reader knows, unless `aem` says another."""
    aem += "" if "version" in aem or "quaternion-rate" in aem else "\nversion = 1"
    return (HEAD + BODY + STATE.format(epoch=epoch, axes=axes, q=q)
            + TIME.format(start=start, stop=stop, step=step)
            + f"[output]\ncolumns = [{columns}]\n[output.aem]\n{aem}\n{more}")


@pytest.fixture
def files(run, table, tmp_path):
    """files(scenario text) -> (path of the AEM, columns of the CSV of the same run)"""

    def write(scenario):
        path = tmp_path / "a.toml"
        path.write_text(scenario, encoding="utf-8")
        run.ok("run", path, "--out", tmp_path / "a.aem", "--out", tmp_path / "a.csv")
        names, rows = table((tmp_path / "a.csv").read_text(encoding="utf-8"))
        return tmp_path / "a.aem", dict(zip(names, numpy.array(rows).T, strict=True))

    return write


def read(path):
    """The metadata and rows of the only segment, by the package ccsds-ndm."""
    [segment] = NdmIo().from_path(path).body.segment
    return segment.metadata, segment.data.attitude_state


def scalar_last(states):
    q = [(s.quaternion_state or s.quaternion_euler_rate).quaternion for s in states]
    return numpy.array([[x.q1, x.q2, x.q3, x.qc] for x in q])


def quaternions(columns):
    return numpy.array([columns[name] for name in ("qx", "qy", "qz", "qw")]).T


@pytest.mark.parametrize("order", ["FIRST", "LAST"])
def test_an_independent_reader_reads_the_same_quaternions(files, order):
    path, columns = files(text(f'quaternion_type = "{order}"'))
    meta, states = read(path)
    assert meta.quaternion_type.value == order and meta.attitude_dir.value == "A2B"
    assert meta.ref_frame_a == "EME2000" and meta.ref_frame_b == "SC_BODY_1"
    assert meta.interpolation_method == "LAGRANGE" and meta.interpolation_degree == 7
    assert numpy.array_equal(scalar_last(states), quaternions(columns))  # bit for bit
    epochs = [(s.quaternion_state or s.quaternion_euler_rate).epoch for s in states]
    assert epochs[:2] == ["2029-04-13T21:46:00.000000000", "2029-04-13T21:46:15.000000000"]
    assert meta.start_time == epochs[0] and meta.stop_time == epochs[-1]
    assert epochs[-1] == "2029-04-13T21:49:00.000000000"


def test_a_to_b_carries_the_axes_of_a_into_those_of_b(files):
    """A body whose axis 1 lies along inertial axis 2: components along A go to those along B by
    the transpose of the matrix whose columns are the axes of B."""
    half = math.sqrt(0.5)
    path, _ = files(text(q=f"[{half!r}, 0, 0, {half!r}]"))
    first = Rotation.from_quat(scalar_last(read(path)[1])[0])
    assert_allclose(first.apply([1, 0, 0]), [0, 1, 0], atol=budgets.numpy_rounding)
    axes = first.as_matrix()  # columns: the axes of B in A
    assert_allclose(axes.T @ [0, 1, 0], [1, 0, 0], atol=budgets.numpy_rounding)


def test_b_to_a_is_the_inverse_rotation(files):
    path, columns = files(text('direction = "B2A"'))
    meta, states = read(path)
    assert meta.attitude_dir.value == "B2A"
    back = quaternions(columns) * [-1, -1, -1, 1]
    assert numpy.array_equal(scalar_last(states), back)


def test_euler_angles_are_3_1_3_of_the_frame(files):
    path, columns = files(text('form = "euler"'))
    meta, states = read(path)
    assert meta.euler_rot_seq == "313" or meta.euler_rot_seq.value == "313"
    angles = [[getattr(s.euler_angle.rotation_angles, f"rotation{i}").value for i in (1, 2, 3)]
              for s in states]
    turned = Rotation.from_euler("ZXZ", angles, degrees=True).as_matrix()
    assert_allclose(turned, Rotation.from_quat(quaternions(columns)).as_matrix(),
                    atol=budgets.numpy_formula)


def test_spin_is_the_direction_of_body_axis_3_and_the_turn_about_it(files):
    path, columns = files(text('form = "spin"'))
    spins = [s.spin for s in read(path)[1]]
    matrices = Rotation.from_quat(quaternions(columns)).as_matrix()
    alpha = numpy.radians([s.spin_alpha.value for s in spins])
    delta = numpy.radians([s.spin_delta.value for s in spins])
    axis = numpy.array([numpy.cos(delta) * numpy.cos(alpha), numpy.cos(delta) * numpy.sin(alpha),
                        numpy.sin(delta)]).T
    assert_allclose(axis, matrices[:, :, 2], atol=budgets.numpy_formula)
    # from where axis 1 would be for SPIN_ANGLE = 0: the node of the body equator on that of A
    node = numpy.array([-numpy.sin(alpha), numpy.cos(alpha), 0 * alpha]).T
    angle = numpy.radians([s.spin_angle.value for s in spins])
    first = (numpy.cos(angle)[:, None] * node
             + numpy.sin(angle)[:, None] * numpy.cross(axis, node))
    assert_allclose(first, matrices[:, :, 0], atol=budgets.numpy_formula)
    rates = [s.spin_angle_vel.value for s in spins]  # deg/s
    assert_allclose(rates, columns["w3"] / 60, rtol=budgets.numpy_formula)


def test_the_ecliptic_is_turned_into_eme2000(files):
    path, columns = files(text(axes="ecliptic-J2000"))
    meta, states = read(path)
    assert meta.ref_frame_a == "EME2000"
    turn = Rotation.from_euler("x", 84381.448 / 3600, degrees=True)
    expected = turn.as_matrix() @ Rotation.from_quat(quaternions(columns)).as_matrix()
    assert_allclose(Rotation.from_quat(scalar_last(states)).as_matrix(), expected,
                    atol=budgets.numpy_formula)


def test_another_name_of_the_ecliptic_is_not_turned(files):
    path, columns = files(text('frame_a = "ECLIPJ2000"', axes="ecliptic-J2000"))
    meta, states = read(path)
    assert meta.ref_frame_a == "ECLIPJ2000"
    assert numpy.array_equal(scalar_last(states), quaternions(columns))


@pytest.mark.parametrize(("form", "version"), [
    ("quaternion", 1), ("quaternion", 2), ("quaternion-rate", 2), ("euler", 1), ("euler", 2),
    ("spin", 1), ("spin", 2)])
def test_our_reader_gives_back_what_was_written(run, table, files, form, version):
    path, columns = files(text(f'form = "{form}"\nversion = {version}'))
    result = run.ok("convert", "--from", "aem", "--to", "csv", path)
    names, rows = table(result.stdout)
    back = dict(zip(names, numpy.array(rows).T, strict=True))
    assert_allclose(back["t"], 60 * columns["t"], rtol=budgets.numpy_rounding)
    ours = Rotation.from_quat(quaternions(columns)).as_matrix()
    assert_allclose(Rotation.from_quat(quaternions(back)).as_matrix(), ours,
                    atol=budgets.numpy_formula)
    rates = {"quaternion-rate": ["w1", "w2", "w3"], "spin": ["w3"]}.get(form, [])
    assert [name for name in names if name.startswith("w")] == rates
    for name in rates:
        assert_allclose(back[name], numpy.radians(columns[name]) / 60, rtol=budgets.numpy_formula)


def test_a_moving_frame_needs_the_inertial_quaternion(run, files, tmp_path):
    frame = "[frame.precessing]\naxis = [0, 0, 1]\nrate = 5\n"
    path, columns = files(text(columns='"q", "q_inertial"', more=frame))
    inertial = numpy.array([columns[name] for name in ("Qx", "Qy", "Qz", "Qw")]).T
    assert numpy.array_equal(scalar_last(read(path)[1]), inertial)
    assert not numpy.array_equal(inertial, quaternions(columns))
    (tmp_path / "b.toml").write_text(text(more=frame), encoding="utf-8")
    assert '"q_inertial" among the columns' in run.rejected("run", tmp_path / "b.toml", "--out",
                                                            tmp_path / "b.aem")


def test_an_event_that_stops_the_run_sets_stop_time(files):
    event = '[[event]]\nname = "half"\ncolumn = "psi"\nvalue = 90\nstops = true\n'
    path, columns = files(text(more=event, stop=300))
    content = path.read_text(encoding="ascii")
    last = content.splitlines()[-2].split()[0]
    assert re.search(r"\nSTOP_TIME = (.*)\n", content)[1] == last
    assert columns["t"][-1] < 300


def test_utc_has_its_leap_second(run, table, files):
    """2016-12-31 ended with 23:59:60; rows 0.25 min apart go through it."""
    path, columns = files(text(epoch="2016-12-31T23:59:15 UTC", stop=1))
    epochs = [s.quaternion_state.epoch for s in read(path)[1]]
    assert [e[11:23] for e in epochs] == ["23:59:15.000", "23:59:30.000", "23:59:45.000",
                                          "23:59:60.000", "00:00:14.000"]
    names, rows = table(run("convert", "--from", "aem", "--to", "csv", path).stdout)
    assert [row[0] for row in rows] == [0, 15, 30, 45, 60]


def test_a_run_that_was_killed_leaves_the_file_of_the_straight_one(run, polhode, tmp_path):
    torque = '[[perturbation]]\nkind = "damping"\ncoefficients = [1e-9, 1e-9, 1e-9]\n'
    scenario = tmp_path / "a.toml"
    scenario.write_text(text('form = "quaternion-rate"', stop=24000, step=0.1, more=torque),
                        encoding="utf-8")
    run.ok("run", scenario, "--out", tmp_path / "s.aem")
    resumed = ["run", scenario, "--out", tmp_path / "k.aem", "--resume"]
    kills = 0
    for seconds in (0.05, 0.15, 0.4):
        process = subprocess.Popen([polhode, *resumed, "--checkpoint", "0"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.kill()
            kills += 1
        process.wait()
    assert run(*resumed).returncode == 0 and kills >= 1
    assert (tmp_path / "k.aem").read_bytes() == (tmp_path / "s.aem").read_bytes()


def test_equal_runs_give_equal_files_and_the_origin_is_told(files):
    first, _ = files(text())
    content = first.read_bytes()
    assert files(text())[0].read_bytes() == content
    lines = content.decode("ascii").splitlines()
    assert lines[0] == "CCSDS_AEM_VERS = 1.0"
    assert "CCSDS_AEM_VERS = 2.0\n" in files(text().replace("version = 1\n", ""))[0].read_text()
    assert lines[-1] == "DATA_STOP"
    assert "CREATION_DATE = 1970-01-01T00:00:00" in lines
    assert 'COMMENT | title = "A body"' in lines and "OBJECT_NAME = A body" in lines
    assert max(map(len, lines)) <= 254
    dated, _ = files(text('creation_date = "2026-01-31T12:00:00"'))
    assert "CREATION_DATE = 2026-01-31T12:00:00" in dated.read_text(encoding="ascii")


@pytest.mark.parametrize("scenario, message", [
    (text().replace('epoch = "2029-04-13T21:46:00 TDB"\n', ""), "expected epoch in [state]"),
    (text(epoch="2029-04-13T21:46:00 UT1"), "UT1, which does not run evenly"),
    (text(stop=-3, step=-0.25), "the dates of an AEM rise"),
    (text(columns='"omega"'), 'expected "q" among the columns'),
    (text('form = "spin"', columns='"q"'), 'expected "omega" among the columns'),
    (text(stop=1e13, step=1e12), "a date far from our time"),
])
def test_what_cannot_be_an_aem(run, tmp_path, scenario, message):
    (tmp_path / "a.toml").write_text(scenario, encoding="utf-8")
    assert message in run.rejected("run", tmp_path / "a.toml", "--out", tmp_path / "a.aem")
    assert not list(tmp_path.glob("*.aem*"))


# A message for the first of them alone: the state, then the AEM, then what acts on the body.
@pytest.mark.parametrize("old, new, key", [
    ("G = 1", "G = -1", "state.andoyer"),
    ("[output.aem]", '[[perturbation]]\nkind = "gravity-gradient"\norbit = "none"\n[output.aem]',
     "output.aem.creation_date"),
])
def test_what_is_wrong_is_reported_in_one_order(run, tmp_path, old, new, key):
    wrong = ANDOYER_AEM.replace(old, new)
    assert wrong != ANDOYER_AEM
    (tmp_path / "a.toml").write_text(wrong, encoding="utf-8")
    result = run("run", tmp_path / "a.toml", "--out", tmp_path / "a.aem")
    assert result.returncode == 2 and f": {key}" in result.stderr, result.stderr
    assert result.stderr.count("\n") == 1


@pytest.mark.parametrize("key, message", [
    ('creation_date = "yesterday"', "expected a date such as"),
    ('quaternion_type = "FIRST"\nversion = 2', 'expected "LAST" in version 2'),
    ('direction = "B2A"\nform = "euler"', 'expected "A2B"'),
    ('form = "quaternion-rate"\nversion = 1', "expected 2 with form quaternion-rate"),
    ('object_name = "Fl\u00fcgel"', "printable ASCII"),
    ('form = "matrix"', "quaternion"),
])
def test_keys_that_do_not_go_together(run, tmp_path, key, message):
    (tmp_path / "a.toml").write_text(text(key), encoding="utf-8")
    assert message in run.rejected("info", tmp_path / "a.toml")


GOOD = """CCSDS_AEM_VERS = 1.0
CREATION_DATE = 2002-309T17:22:31
ORIGINATOR = NASA/JPL
META_START
OBJECT_NAME = MARS GLOBAL SURVEYOR
OBJECT_ID = 1996-062A
REF_FRAME_A = EME2000
REF_FRAME_B = SC_BODY_1
ATTITUDE_DIR = A2B
TIME_SYSTEM = TDB
START_TIME = 1996-11-28T21:29:07.2555
STOP_TIME = 1996-12-28T21:28:00.5555
ATTITUDE_TYPE = QUATERNION
QUATERNION_TYPE = LAST
META_STOP
DATA_START
1996-11-28T21:29:07.2555 0.5 0.5 0.5 0.5
1996-333T21:30:07.2555 0 0 0 1
DATA_STOP
"""


def test_days_of_the_year_are_dates(run, table):
    names, rows = table(run("convert", "--from", "aem", "--to", "csv", stdin=GOOD).stdout)
    assert names == ["t", "qw", "qx", "qy", "qz"]
    assert rows == [[0, 0.5, 0.5, 0.5, 0.5], [60, 1, 0, 0, 0]]


def test_a_60th_second_is_read_on_days_that_had_one(run, table):
    """UTC had one at the end of June 1997, none at that of December."""
    utc = GOOD.replace("TDB", "UTC")
    there = utc.replace("1996-333T21:30:07.2555", "1997-06-30T23:59:60.5")
    run.ok("convert", "--from", "aem", "--to", "csv", stdin=there)
    assert "1997-12-31T23:59:60.5" in run.rejected("convert", "--from", "aem", "--to", "csv",
                                                   stdin=there.replace("06-30", "12-31"))


@pytest.mark.parametrize("old, new, line, message", [
    ("CCSDS_AEM_VERS = 1.0", "CCSDS_OEM_VERS = 1.0", 1, "expected CCSDS_AEM_VERS"),
    ("CCSDS_AEM_VERS = 1.0", "CCSDS_AEM_VERS = 3.0", 1, "expected 1.0 or 2.0"),
    ("OBJECT_ID = 1996-062A\n", "", 14, "no OBJECT_ID"),
    ("= QUATERNION\n", "= SPIN/NUTATION\n", 15, "ATTITUDE_TYPE: got"),
    ("A2B", "AB", 15, "expected A2B or B2A"),
    ("TIME_SYSTEM = TDB", "TIME_SYSTEM = MET", 15, "TIME_SYSTEM: got"),
    ("QUATERNION_TYPE = LAST\n", "", 14, "no QUATERNION_TYPE"),
    ("= QUATERNION\n", "= QUATERNION/RATE\n", 15,
     "in two ways; expected its name of version 2: QUATERNION/ANGVEL"),
    ("= QUATERNION\n", "= EULER_ANGLE/RATE\n", 15,
     "EULER_ANGLE/ANGVEL if it is the angular velocity, EULER_ANGLE/DERIVATIVE if it is the rates"),
    ("0 0 0 1", "0 0 0", 18, "expected those of QUATERNION"),
    ("0 0 0 1", "0 0 0 x", 18, "expected a finite number"),
    ("0 0 0 1", "0 0 0 nan", 18, "expected a finite number"),
    ("0 0 0 1", "0 0 0 2", 18, "a quaternion of length 2"),
    ("1996-333T21:30:07.2555", "1996-333T21:29:07.2555", 18, "not later than"),
    ("1996-333T21:30:07.2555", "1996-02-30T21:29:07", 18, "expected a date such as"),
    ("DATA_STOP\n", "", 18, "ends before DATA_STOP"),
    ("DATA_START\n", "", 16, "expected DATA_START"),
    ("META_STOP\n", "", 15, "DATA_START"),
])
def test_what_is_wrong_in_a_file_is_told_with_its_line(run, old, new, line, message):
    assert old in GOOD
    result = run("convert", "--from", "aem", "--to", "csv", stdin=GOOD.replace(old, new, 1))
    assert result.returncode == 2 and result.stdout == ""
    assert result.stderr.startswith(f"<stdin>:{line}: ") and message in result.stderr


def segment(meta="", rows="", **changes):
    """META and data of a segment of GOOD with other values, and other rows."""
    text = GOOD[GOOD.index("META_START"):]
    for key, value in {"QUATERNION_TYPE": "FIRST", **changes}.items():
        text = re.sub(rf"\n{key} = .*", f"\n{key} = {value}", text)
    text = text.replace("META_STOP", meta + "META_STOP")
    return re.sub(r"(?s)DATA_START\n.*DATA_STOP", f"DATA_START\n{rows}DATA_STOP", text)


HEAD_OF_GOOD = GOOD[:GOOD.index("META_START")]


def test_rates_of_one_segment_stay_when_another_has_none(run, table):
    day = "1996-11-28T21:"
    first = f"{day}30:00 1 0 0 0 0 0.01 0 0\n"
    both = (HEAD_OF_GOOD + segment(ATTITUDE_TYPE="QUATERNION/DERIVATIVE", rows=first)
            + segment(rows=f"{day}31:00 0 0 1 0\n")
            + segment(ATTITUDE_TYPE="SPIN", rows=f"{day}32:00 -90 90 0 9\n"))
    result = run.ok("convert", "--from", "aem", "--to", "csv", stdin=both)
    assert result.stdout.splitlines()[-4:] == [
        "t,qw,qx,qy,qz,w1,w2,w3,segment", "0,1,0,0,0,0.02,0,0,1", "60,0,0,1,0,,,,2",
        f"120,1,0,0,0,,,{math.radians(9)!r},3"]


@pytest.mark.parametrize("change", [{"OBJECT_NAME": "B"}, {"OBJECT_ID": "2026-002A"},
                                    {"REF_FRAME_A": "ITRF-97"}, {"REF_FRAME_B": "INSTRUMENT_7"}])
def test_segments_of_different_objects_or_frames_are_no_table(run, change):
    rows = "1996-11-28T21:30:00 1 0 0 0\n"
    both = HEAD_OF_GOOD + segment(rows=rows) + segment(rows=rows.replace("30", "31"), **change)
    result = run("convert", "--from", "aem", "--to", "csv", stdin=both)
    assert result.returncode == 2 and result.stdout == ""
    assert "segment 2 is of " in result.stderr and str(*change.values()) in result.stderr


@pytest.mark.parametrize("sequence", ["321", "ZXZ", "132"])
@pytest.mark.parametrize("direction", ["A2B", "B2A"])
def test_rates_of_euler_angles_are_the_velocity_that_their_attitudes_have(run, table, sequence,
                                                                          direction):
    """By differences of the attitudes that SciPy makes of the angles, in the order of rotations."""
    angles, rates = numpy.array([30.0, 60.0, -20.0]), numpy.array([1.0, -2.0, 0.5])
    numbers = " ".join(map(str, [*angles, *rates]))
    result = run("convert", "--from", "aem", "--to", "csv", stdin=HEAD_OF_GOOD + segment(
        f"EULER_ROT_SEQ = {sequence}\n", f"1996-11-28T21:30:00 {numbers}\n",
        ATTITUDE_TYPE="EULER_ANGLE/DERIVATIVE", ATTITUDE_DIR=direction))
    names, [row] = table(result.stdout)
    axes = sequence.translate(str.maketrans("123", "XYZ"))
    step = 1e-4  # s
    before, there, after = (Rotation.from_euler(axes, angles + dt * rates, degrees=True)
                            for dt in (-step, 0, step))
    if direction == "B2A":
        before, there, after = before.inv(), there.inv(), after.inv()
    assert_allclose(Rotation.from_quat([*row[2:5], row[1]]).as_matrix(), there.as_matrix(),
                    atol=budgets.numpy_formula)
    assert_allclose(row[5:], (before.inv() * after).as_rotvec() / (2 * step),
                    atol=budgets.aem_euler_rates)


def test_a_packed_file_with_a_byte_order_mark_is_read(run, tmp_path):
    path = tmp_path / "a.aem.gz"
    path.write_bytes(gzip.compress(b"\xef\xbb\xbf" + GOOD.encode()))
    packed = run("convert", "--from", "aem", "--to", "csv", path)
    assert packed.stdout == run("convert", "--from", "aem", "--to", "csv", stdin=GOOD).stdout != ""


def interpolated(form, t, columns, at):
    """Attitudes at times between rows, by SciPy: as INTERPOLATION_METHOD says, from the rows
    around each, at the ends from the first or the last ones."""
    q = quaternions(columns)
    count = min({"quaternion": 8, "quaternion-rate": 4}.get(form, 2), len(t))  # NaN: counts
    angles = numpy.unwrap(Rotation.from_quat(q).as_euler("ZXZ"), axis=0)
    w = numpy.radians(numpy.array([columns[f"w{i}"] for i in (1, 2, 3)]).T)  # per min
    found = []
    for x in at:
        first = int(numpy.clip(numpy.searchsorted(t, x) - count // 2, 0, len(t) - count))
        rows = slice(first, first + count)
        if form == "quaternion":
            found.append(BarycentricInterpolator(t[rows], q[rows])(x))
        elif form == "quaternion-rate":
            v = numpy.hstack([w[rows], numpy.zeros((count, 1))])
            slope = [0.5 * hamilton(one, rate) for one, rate in zip(q[rows], v, strict=True)]
            both = numpy.stack([q[rows], slope], axis=1).reshape(-1, 4)
            found.append(KroghInterpolator(numpy.repeat(t[rows], 2), both)(x))
        else:
            part = (x - t[first]) / (t[first + 1] - t[first])
            angle = (1 - part) * angles[first] + part * angles[first + 1]
            found.append(Rotation.from_euler("ZXZ", angle).as_quat())
    return Rotation.from_quat(found)


def hamilton(p, q):
    """Products of quaternions with the scalar last."""
    return numpy.append(p[3] * q[:3] + q[3] * p[:3] + numpy.cross(p[:3], q[:3]),
                        p[3] * q[3] - p[:3] @ q[:3])


FORMS = ["quaternion", "quaternion-rate", "euler", "spin"]


@pytest.fixture
def told(run, tmp_path):
    """told() -> the error in degrees that the run of a.toml warns of; 0 without a warning"""

    def warned():
        result = run.ok("run", tmp_path / "a.toml", "--out", tmp_path / "a.aem")
        found = re.findall(r"a.aem: between rows .* is off by about (\S+) deg", result.stderr)
        return float(found[0]) if found else 0.0

    return warned


@pytest.mark.parametrize(("form", "step"), [("quaternion", 0.5), ("quaternion-rate", 1),
                                            ("euler", 0.08), ("spin", 0.08)])
def test_the_error_of_interpolation_between_rows_is_told(files, told, form, step):
    """With that of SciPy, which is no more than what is told and not much less."""
    scenario = text(f'form = "{form}"\nversion = 2', stop=40 * step, step=step)
    _, coarse = files(scenario)
    estimate = told()
    _, fine = files(scenario.replace(f"step = {step}", f"step = {step / 2}"))
    there = interpolated(form, coarse["t"], coarse, fine["t"][1::2])
    away = there.inv() * Rotation.from_quat(quaternions(fine)[1::2])
    error = numpy.degrees(away.magnitude().max())
    assert 0.01 < error < budgets.aem_rounding * estimate
    assert estimate < budgets.aem_told * error


def spinner(form, turns, columns):
    """Rows a minute apart of a body that turns about axis 3 so many times from row to row."""
    made = text(f'form = "{form}"\nversion = 2', stop=40, step=1, columns=columns)
    return made.replace("[3, 20, 100]", f"[0, 0, {360 * turns}]")


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("turns", [1, 2, 3])
def test_whole_turns_between_rows_are_told(files, told, form, turns):
    """At an eighth of the step, where the ways of 1, 2 and 3 turns are apart."""
    scenario = spinner(form, turns, '"q", "omega"')
    _, coarse = files(scenario)
    estimate = told()
    _, fine = files(scenario.replace("step = 1\n", "step = 0.125\n"))
    there = interpolated(form, coarse["t"], coarse, fine["t"][1::8])
    away = there.inv() * Rotation.from_quat(quaternions(fine)[1::8])
    error = numpy.degrees(away.magnitude().max())
    assert 0.01 < error < budgets.aem_rounding * estimate
    assert estimate < budgets.aem_told * error


@pytest.mark.parametrize("form", ["quaternion", "euler"])
def test_without_the_columns_omega_whole_turns_are_those_of_the_initial_rate(files, told, form):
    files(spinner(form, 1, '"q"'))
    assert told() == 180


@pytest.mark.parametrize("form", FORMS)
def test_two_rows_are_judged(files, told, form):
    scenario = text(f'form = "{form}"\nversion = 2', stop=1, step=1)
    _, coarse = files(scenario)
    estimate = told()
    _, fine = files(scenario.replace("step = 1\n", "step = 0.125\n"))
    there = interpolated(form, coarse["t"], coarse, fine["t"][1:-1])
    away = there.inv() * Rotation.from_quat(quaternions(fine)[1:-1])
    error = numpy.degrees(away.magnitude().max())
    assert 0.01 < error < budgets.aem_two_rows * estimate
    assert estimate < budgets.aem_told * error


@pytest.mark.parametrize(("form", "rows", "degree"), [
    ("quaternion", 2, 1), ("quaternion", 3, 2), ("quaternion", 7, 6), ("quaternion", 8, 7),
    ("quaternion", 9, 7), ("quaternion-rate", 2, 3), ("quaternion-rate", 3, 5),
    ("quaternion-rate", 4, 7), ("quaternion-rate", 5, 7), ("euler", 2, 1), ("spin", 3, 1)])
def test_the_degree_is_one_that_the_rows_allow(files, form, rows, degree):
    path, _ = files(text(f'form = "{form}"\nversion = 2', stop=0.25 * (rows - 1)))
    assert f"\nINTERPOLATION_DEGREE = {degree}\nMETA_STOP\n" in path.read_text(encoding="ascii")


def test_an_event_that_leaves_few_rows_leaves_their_degree(files):
    event = '[[event]]\nname = "soon"\ncolumn = "psi"\nvalue = {}\nstops = true\n'
    _, columns = files(text(columns='"q", "omega", "euler"'))
    path, _ = files(text(more=event.format((columns["psi"][1] + columns["psi"][2]) / 2)))
    assert "\nINTERPOLATION_DEGREE = 2\n" in path.read_text(encoding="ascii")  # of three rows


@pytest.mark.parametrize("form", FORMS)
def test_automatic_rows_of_a_spinner_need_no_warning(files, told, form):
    _, columns = files(spinner(form, 1, '"q", "omega"').replace("step = 1\n", 'step = "auto"\n'))
    assert 360 * numpy.diff(columns["t"]).max() < 60  # degrees
    assert told() == 0
