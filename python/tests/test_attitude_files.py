# SPDX-License-Identifier: MIT
"""ephemeris.read_aem: attitudes and angular velocities of every form, several segments."""

import pathlib

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode import ephemeris
from rejections import rejected
from scenario_texts import ROOT
from scipy.spatial.transform import Rotation

CORPUS = ROOT / "tests/fuzz/corpus/aem"


def rotation(q):
    return Rotation.from_quat(np.asarray(q)[..., [1, 2, 3, 0]])


def test_a_run_comes_back(tmp_path):
    scenario = polhode.load(ROOT / "examples/apophis.toml")
    path = tmp_path / "apophis.aem"
    few = scenario.text.replace("step = 0.5", "step = 60")
    results = polhode.Scenario.from_text(few).run()
    with pytest.warns(UserWarning, match="between rows a reader that interpolates as"):
        results.write(path)  # 60 h apart
    read = ephemeris.read_aem(path)
    [segment] = read.segments
    assert read.version == "2.0" and read.originator == "POLHODE"
    assert segment.frame_a == "EME2000" and segment.time_system == "UTC"
    assert segment.epochs[1] == "2013-01-07T12:00:00.000000000" and len(segment) == len(results.t)
    assert np.array_equal(segment.t, 3600 * results.t) and segment.omega is None
    ecliptic = Rotation.from_euler("x", 84381.448 / 3600, degrees=True)
    assert_allclose(rotation(segment.q).as_matrix(),
                    (ecliptic * rotation(results.groups["q"])).as_matrix(),
                    atol=budgets.numpy_formula)


def test_two_segments_of_other_forms():
    first, second = ephemeris.read_aem(CORPUS / "derivative.aem").segments
    # scalar first, B2A: the inverse; w = 2 q* dq/dt of A2B
    assert np.array_equal(first.q, [[1, 0, 0, 0], [0, -1, 0, 0]])
    assert_allclose(first.omega[0], [-0.2, 0, -1], atol=budgets.numpy_rounding)
    assert first.center == "MARS" and second.center == ""
    assert second.epochs == ["1996-333T22:00:00"]
    assert_allclose(second.t, [1852.7445], rtol=budgets.numpy_rounding)
    turn = Rotation.from_euler("ZYX", [10, 20, 30], degrees=True)
    assert_allclose(rotation(second.q[0]).as_matrix(), turn.as_matrix(),
                    atol=budgets.numpy_formula)
    rates = turn.inv().apply(np.radians([0.1, 0.2, 0.3]))  # given along A
    assert_allclose(second.omega[0], rates, rtol=budgets.numpy_formula)


def test_angular_velocity_is_that_of_the_attitudes():
    """Differences of the attitudes of a file give its rates: their frame and their sign."""
    [segment] = ephemeris.read_aem(CORPUS / "quaternion-rate-1.aem").segments
    step = segment.t[1]
    between = rotation(segment.q[0]).inv() * rotation(segment.q[2])
    assert_allclose(between.as_rotvec() / (2 * step), segment.omega[1], rtol=budgets.aem_difference)


def test_the_rate_of_a_spin_is_kept():
    [segment] = ephemeris.read_aem(CORPUS / "spin-2.aem").segments
    assert segment.omega is None
    assert segment.spin_rate[0] == np.radians(0.0031686874209190777) and len(segment) == 4
    [other] = ephemeris.read_aem(CORPUS / "quaternion-2.aem").segments
    assert other.spin_rate is None and other.omega is None


def test_errors_name_the_file_and_the_line(tmp_path):
    path = tmp_path / "bad.aem"
    path.write_text("CCSDS_AEM_VERS = 1.0\nORIGINATOR =\n", encoding="ascii")
    rejected(
        polhode.DomainError, "bad.aem:2: ORIGINATOR: got nothing", ephemeris.read_aem, path
    )
    rejected(ValueError, "cannot be read", ephemeris.read_aem, pathlib.Path(tmp_path) / "none.aem")
