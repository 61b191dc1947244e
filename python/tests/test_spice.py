# SPDX-License-Identifier: MIT
"""polhode.spice.write_ck: what SPICE reads back, and through it an independent account of the
direction of the rotation and of the axes of the angular velocity."""

import warnings

import budgets
import numpy as np
import polhode
import polhode.spice
import pytest
import spiceypy
from closeness import assert_allclose
from rejections import rejected
from scenario_texts import ROOT
from scipy.spatial.transform import Rotation

TEXT = (ROOT / "examples/apophis-2029.toml").read_text(encoding="utf-8").replace(
    "stop = 240\nstep = 0.5", "stop = 40\nstep = 0.1")  # close enough for SPICE's interpolation
LSK = """KPL/LSK
\\begindata
DELTET/DELTA_T_A = 32.184
DELTET/K         = 1.657D-3
DELTET/EB        = 1.671D-2
DELTET/M         = ( 6.239996D0 1.99096871D-7 )
DELTET/DELTA_AT  = ( 36, @2015-JUL-1
                     37, @2017-JAN-1 )
\\begintext
"""


@pytest.fixture(autouse=True)
def no_kernels():
    spiceypy.kclear()
    yield
    spiceypy.kclear()


@pytest.fixture(scope="module")
def results():
    return polhode.Scenario.from_text(TEXT).run()


def matrices(results):
    """Body to inertial."""
    return Rotation.from_quat(results.groups["q"][:, [1, 2, 3, 0]]).as_matrix()


def test_spice_reads_the_attitudes_and_rates(results, tmp_path):
    kernels = polhode.spice.write_ck(results, tmp_path / "a.bc", structure=-99942000)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.bc", "a.tf", "a.tsc"]
    spiceypy.furnsh(list(kernels))
    et = polhode.spice.ephemeris_time(results.scenario.epoch, 3600 * results.t)
    omega = np.radians(results.groups["omega"]) / 3600  # rad/s along the body axes
    body_to_inertial = matrices(results)
    for k in range(0, len(et), 30):
        ticks = spiceypy.sce2c(-99942, et[k])
        C, rate, _ = spiceypy.ckgpav(-99942000, ticks, 0.0, "ECLIPJ2000")
        assert_allclose(C, body_to_inertial[k].T, atol=budgets.numpy_formula)
        # SPICE has it in the reference frame
        assert_allclose(rate, body_to_inertial[k] @ omega[k], rtol=budgets.numpy_formula)
        assert_allclose(spiceypy.pxform("POLHODE_BODY", "ECLIPJ2000", et[k]), body_to_inertial[k],
                        atol=budgets.numpy_formula)


def test_a_vector_of_the_body_goes_where_it_should(results, tmp_path):
    """Into the equator of J2000 by SPICE's own frames: the pole, (250, -75) deg on the ecliptic."""
    kernels = polhode.spice.write_ck(
        polhode.Scenario.from_text(TEXT).with_columns(["q", "omega", "g"]).run(), tmp_path / "a.bc"
    )
    spiceypy.furnsh(list(kernels))
    g = results.scenario.initial_state.g
    et = polhode.spice.ephemeris_time(results.scenario.epoch, [0.0])[0]
    towards = spiceypy.pxform("POLHODE_BODY", "J2000", et) @ np.array(g)
    longitude, latitude = np.radians([250, -75])
    ecliptic = [np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude),
                np.sin(latitude)]
    turn = Rotation.from_euler("x", 84381.448 / 3600, degrees=True)
    assert_allclose(towards / np.linalg.norm(towards), turn.apply(ecliptic),
                    atol=budgets.numpy_formula)


def test_time_scales_are_those_of_spice(tmp_path):
    lsk = tmp_path / "lsk.tls"
    lsk.write_text(LSK, encoding="ascii")
    spiceypy.furnsh(str(lsk))
    utc = polhode.spice.ephemeris_time("2029-04-13T21:46:00 UTC", [0.0, 60.0])
    assert_allclose(utc[0], spiceypy.str2et("2029-04-13T21:46:00"), rtol=budgets.numpy_rounding)
    tt = polhode.spice.ephemeris_time("2029-04-13T21:47:09.184 TT", [0.0, 60.0])
    tai = polhode.spice.ephemeris_time("2029-04-13T21:46:37 TAI", [0.0, 60.0])
    tdb = polhode.spice.ephemeris_time("JD 2451545.0 TDB", [0.0, 60.0])
    assert_allclose(tt, utc, rtol=budgets.numpy_rounding)
    assert_allclose(tai, utc, rtol=budgets.numpy_rounding)
    assert list(tdb) == [0.0, 60.0]
    z = polhode.spice.ephemeris_time("2029-04-13T21:46:00Z", [0.0, 60.0])
    assert list(z) == list(utc)


EPOCHS = ["2029-04-13T21:46:00 UTC", "2016-12-31T23:59:60 UTC", "2016-12-31T23:59:59 UTC",
          "JD 2457754.0 UTC",
          "2029-04-13T21:47:09.184 TT", "2029-04-13T21:46:37 TAI"]  # fmt: skip


def test_leap_seconds_need_no_kernel(tmp_path):
    """The numbers are those of SPICE with a kernel."""
    seconds = np.array([[0.0, 60.0], [1e6, 1e8]])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # 2029: more leap seconds may come
        without = [polhode.spice.ephemeris_time(epoch, seconds) for epoch in EPOCHS]
    lsk = tmp_path / "lsk.tls"
    lsk.write_text(LSK, encoding="ascii")
    spiceypy.furnsh(str(lsk))
    for epoch, et in zip(EPOCHS, without, strict=True):
        assert et.shape == (2, 2)
        assert_allclose(et, polhode.spice.ephemeris_time(epoch, seconds),
                        atol=budgets.spice_time_s)


def test_a_kernel_wins(tmp_path):
    before = polhode.spice.ephemeris_time("2018-01-01 UTC", 0.0)
    lsk = tmp_path / "lsk.tls"
    lsk.write_text(LSK.replace("37, @2017", "40, @2017"), encoding="ascii")
    spiceypy.furnsh(str(lsk))
    after = polhode.spice.ephemeris_time("2018-01-01 UTC", 0.0)
    assert_allclose(after - before, 3.0, atol=budgets.spice_time_s)


def test_a_utc_epoch_whose_leap_seconds_are_not_known_yet_warns(tmp_path):
    scenario = polhode.Scenario.from_text(TEXT.replace("TDB\"", "UTC\"").replace("2029-", "2049-"))
    with pytest.warns(UserWarning, match="beyond the leap seconds that are known here"):
        polhode.spice.write_ck(scenario.run(), tmp_path / "a.bc")
    for wrong in ("2026-02-30 TT", "JD x TDB", "2026-05-01", "JD 2461161.5Z"):
        rejected(ValueError, f"got .*{wrong}", polhode.spice.ephemeris_time, wrong, 0.0)
    with pytest.raises(ValueError, match="in UTC, TAI, TT or TDB"):
        polhode.spice.ephemeris_time("2026-05-01 UT1", 0.0)


def test_a_file_of_that_name_stays_until_the_new_one_is_complete(results, tmp_path):
    path = tmp_path / "a.bc"
    path.write_bytes(b"before")
    with pytest.raises(spiceypy.utils.exceptions.SpiceyError):
        polhode.spice.write_ck(results, path, reference="NOWHERE")
    assert path.read_bytes() == b"before"
    polhode.spice.write_ck(results, path)
    polhode.spice.write_ck(results, path)  # over its own
    assert path.read_bytes().startswith(b"DAF/CK")


@pytest.mark.parametrize("change, message", [
    ({"path": "a.csv"}, "ends with .bc"),
    ({"structure": 5}, "below -999"),
    ({"columns": ["q"]}, "no columns 'omega'"),
    ({"axes": "inertial"}, "expected reference"),
])
def test_what_is_missing_is_told(change, message, tmp_path):
    text = TEXT.replace('"ecliptic-J2000"', f'"{change.get("axes", "ecliptic-J2000")}"')
    scenario = polhode.Scenario.from_text(text)
    scenario = scenario.with_columns(change.get("columns", ["q", "omega"]))
    rejected(ValueError, message, polhode.spice.write_ck, scenario.run(),
             tmp_path / change.get("path", "a.bc"), structure=change.get("structure", -99942000))


# 1.1 deg/s with a nutation of some 20 degrees
TUMBLER = """schema = 1
[units]
angle = "deg"
[body]
moments = [1, 2, 2.5]
[state]
epoch = "2026-01-01T00:00:00 TDB"
axes = "equator-J2000"
[state.attitude-rate]
quaternion = [0.8, 0.2, 0.4, 0.4]
omega_body = [0.9, 0.3, 0.5]
[time]
stop = 3600
step = 60
[output]
columns = ["q", "omega"]
"""


def error_between_rows(kernels, scenario, times):
    """The largest angle in degrees between what SPICE has and the free rotation."""
    spiceypy.kclear()
    spiceypy.furnsh(list(kernels))
    et = polhode.spice.ephemeris_time(scenario.epoch, times)
    there = np.array([spiceypy.pxform("POLHODE_BODY", "J2000", x) for x in et])
    q = polhode.FreeRotation(scenario.body, scenario.initial_state).at(times).q
    away = Rotation.from_matrix(there).inv() * Rotation.from_quat(q[:, [1, 2, 3, 0]])
    return np.degrees(away.magnitude().max())


@pytest.mark.parametrize(("omega", "step"), [
    ([0, 0, 6], 60), ([0, 0, 12], 60), ([0, 0, 18], 60), ([0, 0, 1.2], 601), ([0.9, 0.3, 0.5], 600)
])  # fmt: skip
def test_whole_turns_between_rows_are_told(omega, step, tmp_path):
    scenario = polhode.Scenario.from_text(TUMBLER).replace(
        {"state.attitude-rate.omega_body": omega, "time.step": step, "time.stop": 20 * step})
    with pytest.warns(UserWarning, match="off by about") as told:
        kernels = polhode.spice.write_ck(scenario.run(), tmp_path / "a.bc")
    error = error_between_rows(kernels, scenario, np.arange(0, 20 * step, step / 8))
    said = float(str(told[0].message).split("about ")[1].split(" deg")[0])
    assert_allclose(said, error, rtol=budgets.ck_between_rows)


def test_the_error_of_the_interpolation_between_rows_is_told_and_automatic_rows_keep_it(tmp_path):
    scenario = polhode.Scenario.from_text(TUMBLER)
    with pytest.warns(UserWarning, match="off by about") as told:
        kernels = polhode.spice.write_ck(scenario.run(), tmp_path / "a.bc")
    error = error_between_rows(kernels, scenario, np.arange(30, 3600, 60.0))
    assert 1.0 < error < 10.0  # degrees
    said = float(str(told[0].message).split("about ")[1].split(" deg")[0])
    assert_allclose(said, error, rtol=budgets.ck_between_rows)
    for wanted in (0.01, 0.001):
        auto = scenario.replace({"time.step": "auto", "time.error": f"{wanted} deg"})
        results = auto.run()
        assert results.t[0] == 0 and results.t[-1] == 3600
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            kernels = polhode.spice.write_ck(results, tmp_path / "b.bc")
        middle = 0.5 * (results.t[1:] + results.t[:-1])
        error = error_between_rows(kernels, auto, middle[:: len(middle) // 100])
        assert 0.5 * wanted < error < wanted
