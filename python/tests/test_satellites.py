# SPDX-License-Identifier: MIT
"""Satellites from two-line elements and OMM: against the verification run of SGP4 itself and the
published example of its axes."""

import gzip
import json
import pathlib

import budgets
import numpy as np
import polhode
import pytest
import sgp4
from closeness import assert_allclose
from polhode import satellites
from polhode.satellites.__main__ import main
from rejections import rejected
from scenario_texts import BODY, STATE

VANGUARD = ("1 00005U 58002B   00179.78495062  .00000023  00000-0  28098-4 0  4753",
            "2 00005  34.2682 348.7242 1859667 331.7664  19.3264 10.82419157413667")
OMM = {
    "OBJECT_NAME": "VANGUARD 1",
    "OBJECT_ID": "1958-002B",
    "EPOCH": "2000-06-27T18:50:19.733568",
    "MEAN_MOTION": "10.82419157",
    "ECCENTRICITY": "0.1859667",
    "INCLINATION": "34.2682",
    "RA_OF_ASC_NODE": "348.7242",
    "ARG_OF_PERICENTER": "331.7664",
    "MEAN_ANOMALY": "19.3264",
    "EPHEMERIS_TYPE": "0",
    "CLASSIFICATION_TYPE": "U",
    "NORAD_CAT_ID": "5",
    "ELEMENT_SET_NO": "475",
    "REV_AT_EPOCH": "41366",
    "BSTAR": "0.28098E-4",
    "MEAN_MOTION_DOT": "0.00000023",
    "MEAN_MOTION_DDOT": "0",
}


def tle(epoch="00179.78495062", kind="0"):
    """Line 1 with another epoch or ephemeris type, and its checksum."""
    line = VANGUARD[0].replace("00179.78495062", epoch)
    line = line[:62] + kind + line[63:68]
    return line + str((sum(int(c) for c in line if c.isdigit()) + line.count("-")) % 10)


def verification(number):
    """Minutes, km, km/s along TEME, of the verification run that comes with sgp4."""
    text = (pathlib.Path(sgp4.__file__).parent / "tcppver.out").read_text()
    rows = text.split(f"{number} xx")[1].split(" xx")[0].splitlines()
    return np.array([[float(x) for x in row.split()[:7]] for row in rows if len(row.split()) >= 7])


def test_positions_are_those_of_the_verification_run():
    satellite = satellites.satellite_from_tle(*VANGUARD)
    rows = verification(5)
    assert len(rows) > 10
    x, v = satellite.states(satellite.epoch, 60 * rows[:, 0])
    for k, row in enumerate(rows):
        turn = polhode.ephemeris.j2000_from_teme(
            polhode.ephemeris.date_after(satellite.epoch, 60 * row[0])
        )
        assert_allclose(turn.T @ x[k], row[1:4], atol=budgets.sgp4_km)
        assert_allclose(turn.T @ v[k], row[4:7], atol=budgets.sgp4_km_s)


def test_axes_are_those_of_the_published_example():
    """Vallado et al. (2006), example of 2004-04-06: the same position along TEME and the GCRS. The
    difference are the corrections of the pole that were observed then, 0.02 arcsec."""
    date = polhode.ephemeris.calendar_date("UTC", 2004, 4, 6, 7, 51, 28.386009)
    teme = np.array([5094.18016210, 6127.64465950, 6380.34453270])
    gcrs = np.array([5102.50895790, 6123.01140070, 6378.13692820])
    there = polhode.ephemeris.j2000_from_teme(date) @ teme
    assert np.linalg.norm(there - gcrs) < budgets.teme_km
    assert np.linalg.norm(teme - gcrs) > 1000 * budgets.teme_km
    turn = polhode.ephemeris.j2000_from_teme(date)
    assert_allclose(turn @ turn.T, np.eye(3), atol=budgets.numpy_rounding)


def test_an_omm_is_its_elements():
    tle = satellites.satellite_from_tle(*VANGUARD)
    csv = ",".join(OMM) + "\n" + ",".join(OMM.values()) + "\n"
    xml = "<ndm><omm>" + "".join(f"<{k}>{v}</{k}>" for k, v in OMM.items()) + "</omm></ndm>"
    for source in (OMM, csv, xml):
        omm = satellites.satellite_from_omm(source)
        assert omm.name == "VANGUARD 1"
        assert abs(polhode.ephemeris.seconds_between(tle.epoch, omm.epoch)) < budgets.tle_epoch
        x, _ = omm.states(tle.epoch, [0.0, 86400.0])
        y, _ = tle.states(tle.epoch, [0.0, 86400.0])
        assert_allclose(x, y, atol=budgets.omm_km)


def test_a_scenario_reads_the_table(tmp_path):
    satellite = satellites.satellite_from_tle(*VANGUARD)
    epoch = polhode.ephemeris.calendar_date("UTC", 2000, 6, 28)
    orbit = satellite.orbit(epoch, 0, 7200)
    satellite.write(tmp_path / "vanguard.csv.gz", "2000-06-28T00:00:00 UTC", 0, 7200)
    head = gzip.decompress((tmp_path / "vanguard.csv.gz").read_bytes()).decode()
    assert "t counts from 2000-06-28T00:00:00.000 UTC; " in head.splitlines()[1]
    assert "t [s], x [km], y [km], z [km], vx [km/s]" in head.splitlines()[2]
    assert [file.name for file in tmp_path.iterdir()] == ["vanguard.csv.gz"]
    scenario = polhode.Scenario.from_text(
        f"""
        schema = 1
        [units]
        length = "km"
        [body]
        moments = [1, 2, 2.5]
        [state]
        epoch = "2000-06-28T00:00:00 UTC"
        axes = "equator-J2000"
        [state.attitude-rate]
        quaternion = [1, 0, 0, 0]
        omega_body = [0, 0.001, 0.01]
        [orbit.earth]
        kind = "table"
        file = "{tmp_path / "vanguard.csv.gz"}"
        gm = 398600.4418
        [[perturbation]]
        kind = "gravity-gradient"
        orbit = "earth"
        [time]
        stop = 7200
        count = 13
        """,
    )
    t = np.linspace(0, 7200, 29)
    assert_allclose(scenario.orbits["earth"].position(t), orbit.position(t), atol=budgets.sgp4_km)
    # between rows
    x, v = satellite.states(epoch, t)
    assert_allclose(orbit.position(t), x, atol=budgets.sgp4_km)
    # what SGP4 gives is not the derivative of its positions, in a real difference
    assert_allclose(orbit.velocity(t), v, atol=budgets.sgp4_slope)
    assert len(scenario.run().t) == 13


@pytest.mark.parametrize(("epoch", "axes", "what"), [
    ("2000-06-28T00:00:00 UTC", "equator-J2000", None),
    ("2000-06-28T00:00:32 TAI", "equator-J2000", None),  # TAI - UTC was 32 s
    ("2000-06-29T00:00:00 UTC", "equator-J2000",
     "a.csv:2: t counts from 2000-06-28T00:00:00.000 UTC, -86400 s after epoch = "),
    ("2000-06-28T00:00:00 TAI", "equator-J2000", "UTC, 32"),
    ("2000-06-28T00:00:00 UTC", "ecliptic-J2000",
     'a.csv:2: its axes are equator-J2000; expected axes = "equator-J2000"'),
    ("2000-06-28T00:00:00 UTC", "inertial", 'in [state], not "inertial"'),
])  # fmt: skip
def test_a_table_of_another_epoch_or_other_axes_is_refused(tmp_path, epoch, axes, what):
    satellite = satellites.satellite_from_tle(*VANGUARD)
    satellite.write(tmp_path / "a.csv", "2000-06-28T00:00:00 UTC", 0, 7200)
    data = {
        "schema": 1, "units": {"length": "km"}, "body": {"moments": [1, 2, 2.5]},
        "state": {"epoch": epoch, "axes": axes,
                  "attitude-rate": {"quaternion": [1, 0, 0, 0], "omega_body": [0, 0, 1]}},
        "orbit": {"earth": {"kind": "table", "file": "a.csv", "gm": 398600.4418}},
    }  # fmt: skip
    if what is None:
        polhode.Scenario.from_dict(data, str(tmp_path / "s.toml"))
        return
    with pytest.raises(ValueError, match=r"orbit.earth.file: got \"a.csv\"") as refusal:
        polhode.Scenario.from_dict(data, str(tmp_path / "s.toml"))
    assert what in str(refusal.value) and "\n" not in str(refusal.value)


def test_the_epoch_of_a_table_is_a_date(tmp_path):
    """59.9996 s are not 60.000 s of the same minute."""
    satellite = satellites.satellite_from_tle(*VANGUARD)
    cases = {59.9996: "00:01:00.000", 59.9994: "00:00:59.999", 30.0: "00:00:30.000"}
    for second, time in cases.items():
        epoch = polhode.ephemeris.calendar_date("UTC", 2000, 6, 28, 0, 0, second)
        satellite.write(tmp_path / "a.csv", epoch, 0, 600)
        assert f"from 2000-06-28T{time} UTC" in (tmp_path / "a.csv").read_text()


@pytest.mark.parametrize(("line1", "line2", "what"), [
    (VANGUARD[0][:-1] + "4", VANGUARD[1], "line 1: its checksum is 4; its characters give 3"),
    (VANGUARD[0], VANGUARD[1][:-1] + "0", "line 2: its checksum is 0; its characters give 7"),
    (VANGUARD[0][:-1], VANGUARD[1], "line 1: has 68 characters; expected 69"),
    (VANGUARD[1], VANGUARD[0], 'line 1: begins with "2 "'),
    (VANGUARD[0], VANGUARD[1].replace("34.2682", "34.26x2")[:-1] + "9",
     'line 2: its inclination " 34.26x2", in columns 9 to 16, is not a number'),
    (VANGUARD[0].replace("28098-4", "28o98-4")[:-1] + "3", VANGUARD[1],
     'line 1: its drag term " 28o98-4"'),
    (VANGUARD[0], VANGUARD[1].replace("10.82419157", "00.00000000")[:-1] + "9",
     "line 2: its mean motion is 0"),
    (tle("21367.63955392"), VANGUARD[1], "the day of its epoch is 367.64; expected 1 to 365"),
    (tle("21000.50000000"), VANGUARD[1], "the day of its epoch is 0.5; expected 1 to 365"),
    (tle(kind="4"), VANGUARD[1], "its ephemeris type, in column 63, is 4; SGP4 elements"),
    (VANGUARD[0], VANGUARD[1].replace(" 34.2682", "184.2682")[:-1] + "3",
     "line 2: its inclination is 184.2682; expected at most 180 deg"),
])
def test_lines_that_are_wrong_say_where(line1, line2, what):
    rejected(ValueError, what, satellites.satellite_from_tle, line1, line2)


@pytest.mark.parametrize(("call", "message"), [
    (lambda: satellites.satellite_from_omm({k: v for k, v in OMM.items() if k != "BSTAR"}),
     "the field BSTAR is missing"),
    (lambda: satellites.satellite_from_omm({**OMM, "INCLINATION": "x"}), "OMM: .*x"),
    (lambda: satellites.satellite_from_omm("<omm>"), "not XML"),
    (lambda: satellites.satellite_from_omm("A,B\n"), "0 messages"),
    (lambda: satellites.satellite_from_omm(as_csv(OMM, OMM)), "2 messages; expected one"),
])  # fmt: skip
def test_messages_that_are_wrong_say_where(call, message):
    rejected(ValueError, message, call)


def message(number, name="", **fields):
    """A message of a catalogue."""
    return {**OMM, "OBJECT_NAME": name, "NORAD_CAT_ID": number, **fields}


def leaves(fields, *names):
    return "".join(f"<{k}>{fields[k]}</{k}>" for k in names if fields.get(k))


def as_xml(*found):
    """As CelesTrak and Space-Track write them."""
    segments = "".join(
        '<omm id="CCSDS_OMM_VERS" version="2.0"><header><CREATION_DATE/><ORIGINATOR/></header>'
        f"<body><segment><metadata>{leaves(one, 'OBJECT_NAME', 'OBJECT_ID')}</metadata><data>"
        f"<meanElements>{leaves(one, *ELEMENTS)}</meanElements>"
        f"<tleParameters>{leaves(one, *PARAMETERS)}</tleParameters><userDefinedParameters>"
        "<COMMENT>a</COMMENT><COMMENT>b</COMMENT>"
        '<USER_DEFINED parameter="PERIOD">92</USER_DEFINED>'
        '<USER_DEFINED parameter="SEMIMAJOR_AXIS">6796</USER_DEFINED>'
        "</userDefinedParameters></data></segment></body></omm>"
        for one in found)
    return f'<?xml version="1.0"?>\n<ndm>{segments}</ndm>\n'


def as_kvn(*found):
    return "".join("CCSDS_OMM_VERS = 2.0\nCOMMENT a comment\n"
                   + "".join(f"{k} = {v}{' [deg]' if k == 'INCLINATION' else ''}\n"
                             for k, v in one.items() if v) for one in found)


def as_csv(*found):
    return "".join(",".join(row) + "\n" for row in (OMM, *(one.values() for one in found)))


def as_json(*found):
    return json.dumps(list(found))


ELEMENTS = ("EPOCH", "MEAN_MOTION", "ECCENTRICITY", "INCLINATION", "RA_OF_ASC_NODE",
            "ARG_OF_PERICENTER", "MEAN_ANOMALY")
PARAMETERS = ("EPHEMERIS_TYPE", "CLASSIFICATION_TYPE", "NORAD_CAT_ID", "ELEMENT_SET_NO",
              "REV_AT_EPOCH", "BSTAR", "MEAN_MOTION_DOT", "MEAN_MOTION_DDOT")


@pytest.mark.parametrize("written", [as_xml, as_kvn, as_csv, as_json])
def test_a_file_gives_every_message_and_each_its_own_fields(written, tmp_path):
    found = [message("52001", "FIRST", INCLINATION="51.6", MEAN_ANOMALY="30"),
             message("123456789", "SECOND", INCLINATION="98.1", BSTAR="0.0007")]
    (tmp_path / "a.omm.gz").write_bytes(gzip.compress(b"\xef\xbb\xbf" + written(*found).encode()))
    read = satellites.satellites_from_file(tmp_path / "a.omm.gz")
    assert [(one.name, one.number) for one in read] == [("FIRST", "52001"),
                                                        ("SECOND", "123456789")]
    for one, fields in zip(read, found, strict=True):
        assert_allclose(np.degrees(one.elements.inclo), float(fields["INCLINATION"]),
                        atol=budgets.numpy_formula)
        assert one.elements.bstar == float(fields["BSTAR"])
    # a field that the second lacks is not that of the first
    del found[1]["BSTAR"]
    if written is not as_csv:
        with pytest.raises(ValueError, match="a: message 2 .SECOND.: the field BSTAR is missing"):
            satellites.satellites_from_text(written(*found), "a")


def test_epochs_of_messages_and_days_with_a_leap_second():
    """The day of 2016-12-31 has 86,401 s: noon is 43,200 s after midnight."""
    noon = polhode.ephemeris.Date("2016-12-31T12:00:00 UTC")
    line1 = "1 04859U 21001A   16366.50000000  .00000000  00000+0  00000+0 0  9995"
    line2 = "2 04859  51.6000 123.4000 0001234  10.0000  20.0000 15.50000000    15"
    read = [satellites.satellite_from_tle(line1, line2)]
    for epoch in ("2016-12-31T12:00:00", "2016-366T12:00:00.000Z"):
        read.append(satellites.satellite_from_omm({**OMM, "EPOCH": epoch}))
    for one in read:
        assert abs(polhode.ephemeris.seconds_between(noon, one.epoch)) < budgets.tle_epoch


@pytest.mark.parametrize(("fields", "what"), [
    ({"EPHEMERIS_TYPE": "4"}, 'EPHEMERIS_TYPE: got "4"; SGP4 elements have 0'),
    ({"MEAN_ELEMENT_THEORY": "DSST"}, 'MEAN_ELEMENT_THEORY: got "DSST"'),
    ({"MEAN_ELEMENT_THEORY": "SGP4-XP"}, "MEAN_ELEMENT_THEORY"),
    ({"TIME_SYSTEM": "TAI"}, "SGP4 elements have UTC"),
    ({"REF_FRAME": "GCRF"}, "SGP4 elements have TEME"),
    ({"CENTER_NAME": "MARS"}, "SGP4 elements have EARTH"),
    ({"INCLINATION": "180.5"}, 'INCLINATION: got "180.5"; expected a number from 0 to 180'),
    ({"MEAN_MOTION": "0"}, "MEAN_MOTION"),
    ({"ECCENTRICITY": "nan"}, "ECCENTRICITY"),
    ({"EPOCH": "2026-02-30T00:00:00"}, 'EPOCH: got "2026-02-30T00:00:00"'),
    ({"NORAD_CAT_ID": "1234567890"}, "expected up to nine digits"),
    ({"INCLINATION": "1_0"}, 'INCLINATION: got "1_0"; expected a number from 0 to 180'),
    ({"RA_OF_ASC_NODE": "\u0661\u0660"}, "RA_OF_ASC_NODE: got"),  # 10 in Arabic digits
    ({"BSTAR": "1e-0_4"}, 'BSTAR: got "1e-0_4"'), ({"MEAN_MOTION": "1_0.8"}, "MEAN_MOTION: got"),
    ({"MEAN_MOTION_DOT": "2_3e-8"}, 'MEAN_MOTION_DOT: got "2_3e-8"; expected a number'),
    ({"MEAN_MOTION_DDOT": "nan"}, "MEAN_MOTION_DDOT: got"),
    ({"ELEMENT_SET_NO": "4_75"}, "ELEMENT_SET_NO: got"),
    ({"REV_AT_EPOCH": "4_1366"}, "REV_AT_EPOCH: got"),
])  # fmt: skip
def test_elements_of_another_theory_or_beyond_their_range_are_rejected(fields, what):
    rejected(ValueError, what, satellites.satellite_from_omm, {**OMM, **fields})


@pytest.mark.parametrize(("text", "what"), [
    ("<ndm><omm><A>1</A><A>2</A></omm></ndm>", "the field A is there twice"),
    ('[{"A": 1, "A": 2}]', "the field A is there twice"),
    ("CCSDS_OMM_VERS = 2.0\nA = 1\nA = 2\n", "the field A is there twice"),
    ("CCSDS_OMM_VERS = 2.0\nA\n", 'line 2: got "A"; expected KEYWORD = value'),
    ("[1]", "expected a list of messages in JSON"), ("[1", "not JSON"), ("[]", "0 messages"),
    ("A,MEAN_MOTION\n1\n", "message 1: has 1 fields; the first line names 2"),
])  # fmt: skip
def test_a_damaged_message_says_what_is_wrong(text, what):
    rejected(ValueError, f"a: .*{what}", satellites.satellites_from_text, text, "a")


def test_elements_that_are_old_warn():
    satellite = satellites.satellite_from_tle(*VANGUARD)
    with pytest.warns(UserWarning, match="365 d from its elements, of 2000-06-27T18:50:19.734 UTC"):
        satellite.orbit("2001-06-28T00:00:00 UTC", 0, 3600)


def test_a_satellite_that_has_decayed_says_so():
    satellite = satellites.satellite_from_omm({**OMM, "BSTAR": "0.9", "MEAN_MOTION": "16.4",
                                               "ECCENTRICITY": "0.0005"})  # fmt: skip
    with pytest.warns(UserWarning), pytest.raises(ValueError, match="SGP4 has no position"):
        satellite.states(satellite.epoch, [86400.0 * 100])


FROM_TO = ["--from", "2000-06-28T00:00:00Z", "--to", "2000-06-28 02:00:00 UTC"]
LINES = "\n".join(VANGUARD) + "\n"


@pytest.fixture
def command(tmp_path, monkeypatch, capsys):
    """command(elements, *words) -> its exit status, what it prints, what it complains of."""
    monkeypatch.chdir(tmp_path)

    def go(elements, *words):
        pathlib.Path("a.tle").write_text(elements)
        status = main(["a.tle", *(words or FROM_TO), "--out", "a.csv"])
        said = capsys.readouterr()
        return status, said.out, said.err

    return go


def test_the_command_writes_the_positions_of_sgp4_and_their_slopes(command):
    status, out, err = command("VANGUARD 1\n" + LINES)
    assert (status, err) == (0, "")
    assert out == (
        "a.csv: VANGUARD 1, 121 rows, 60 s apart, up to 0.3 days from its elements\n"
        'for a scenario with epoch = "2000-06-28T00:00:00.000 UTC" in [state]\n'
    )
    rows = np.loadtxt("a.csv", delimiter=",", skiprows=4)
    satellite = satellites.satellite_from_tle(*VANGUARD)
    epoch = polhode.ephemeris.Date("2000-06-28T00:00:00Z")
    x, v = satellite.states(epoch, rows[:, 0])
    assert_allclose(rows[:, 1:4], x, atol=budgets.sgp4_km)
    assert_allclose(rows[:, 4:], v, atol=budgets.sgp4_slope)
    # the slope itself: a plain difference of positions nearby
    later, before = (satellite.states(epoch, rows[:, 0] + h)[0] for h in (0.5, -0.5))
    assert_allclose(rows[:, 4:], later - before, atol=budgets.sgp4_plain_difference)


def test_a_table_is_right_between_its_rows_in_orbits_of_every_kind():
    verified = pathlib.Path(sgp4.__file__).parent / "SGP4-VER.TLE"
    lines = [line[:69] for line in verified.read_text().splitlines() if line[:2] in ("1 ", "2 ")]
    spacings = {"06251": 60.0, "11801": 30.0, "14128": 900.0, "21897": 30.0, "28626": 900.0}
    for one, other in zip(lines[::2], lines[1::2], strict=True):
        if one[2:7] not in spacings:
            continue
        satellite = satellites.satellite_from_tle(one, other)
        assert satellite.spacing == spacings[one[2:7]]
        orbit = satellite.orbit(satellite.epoch, 0, 86400)
        t = np.linspace(0, 86400, 1001)
        x, _ = satellite.states(satellite.epoch, t)
        assert_allclose(orbit.position(t), x, atol=budgets.sgp4_between_rows)


def test_the_command_takes_the_elements_that_are_nearest(command):
    older = (VANGUARD[0].replace("00179.", "00169.")[:-1] + "2", VANGUARD[1])
    text = "0 VANGUARD 1\n" + "\n".join(older) + "\n\n# newer\n0 VANGUARD 1\n" + LINES
    status, out, _ = command(text)
    assert status == 0
    assert "0.3 days" in out
    assert [one.name for one in satellites.satellites_from_file("a.tle")] == ["VANGUARD 1"] * 2
    assert command(text, *FROM_TO, "--epoch", "2000-06-27 UTC", "--step", "2 min")[0] == 0
    assert np.loadtxt("a.csv", delimiter=",", skiprows=4)[:2, 0].tolist() == [86400, 86520]


OTHER = LINES.replace("00005U", "00006U").replace("4753", "4754").replace(
    "2 00005", "2 00006").replace("413667", "413668")  # fmt: skip


@pytest.mark.parametrize(("text", "words", "what"), [
    (LINES.replace("4753", "4754"), [], "a.tle:1: line 1: its checksum is 4; its characters give "),
    ("A\n" + LINES.replace("413667", "413660"), [], "a.tle:3: line 2: its checksum is 0; "),
    (LINES.splitlines()[0], [], "a.tle:1: line 1 of elements has no line 2 below it"),
    (LINES.splitlines()[1], [], "a.tle:1: line 2 of elements has no line 1 above it"),
    (LINES.splitlines()[0] + "\nA\n", [], 'a.tle:2: expected line 2 of the elements of line 1, '
     'which begins with "2 "; got "A"'),
    ("A\nB\n", [], 'a.tle:2: expected line 1 of the elements of "A"'),
    ("", [], "a.tle: holds no two-line elements"),
    (LINES + "/EX\n", [], 'a.tle:3: expected line 1 of the elements of "/EX"'),
    (LINES + OTHER, [], "a.tle: holds several satellites; expected --satellite with one of 00005"),
    (LINES, [*FROM_TO, "--satellite", "ISS"], "a.tle: no satellite is ISS; there are 00005"),
    (LINES, ["--from", "2001-06-28Z", "--to", "2001-06-29Z"], "a.tle: the elements of 00005 are of "
     "2000-06-27T18:50:19.734 UTC, 365.3 days from the interval"),
    (LINES, ["--from", "2000-07-27T19:00Z", "--to", "2000-07-28Z"], "a.tle: the elements of 00005 "
     "are of 2000-06-27T18:50:19.734 UTC, 30.1 days from the interval"),
    (LINES, ["--from", "2000-06-28", "--to", "2000-06-29Z"], "--from: Date: got "),
    (LINES, ["--from", "2000-06-28Z", "--to", "2000-06-31Z"], "--to: Date: got "),
    (LINES, ["--from", "2000-06-29Z", "--to", "2000-06-28Z"], "--to 2000-06-28Z must be later"),
    (LINES, [*FROM_TO, "--step", "-1"], '--step: got "-1"; expected a time'),
    (LINES, [*FROM_TO, "--step", "1 km"], '--step: got "1 km"; expected a time'),
    (LINES, [*FROM_TO, "--step", "1e-9"], "7.2e+12 rows; expected at most 200000"),
    (LINES, [*FROM_TO, "--step", "0.03"], "2.4e+05 rows; expected at most 200000"),
    ("DEB\n" + LINES + "DEB\n" + OTHER, [], "a.tle: holds several satellites; expected --satellite "
     "with one of 5 (DEB), 6 (DEB)"),
    ("DEB\n" + LINES + "DEB\n" + OTHER, [*FROM_TO, "--satellite", "DEB"], "a.tle: holds several "
     "satellites; expected --satellite with one of 5 (DEB), 6 (DEB)"),
])  # fmt: skip
def test_the_command_says_in_one_line_what_is_wrong(command, text, words, what):
    status, out, err = command(text, *words)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert err.startswith("python -m polhode.satellites: " + what), err
    assert not pathlib.Path("a.csv").exists()


@pytest.mark.parametrize("number", ["6", "00006"])
def test_a_number_tells_satellites_of_one_name_apart(command, number):
    text = "DEB\n" + LINES + "DEB\n" + OTHER
    assert command(text, *FROM_TO, "--satellite", number)[0] == 0


def test_a_month_that_begins_at_the_elements_is_a_table_with_a_warning(command):
    month = ["--from", "2000-06-28Z", "--to", "2000-07-28T12:00:00Z", "--step", "1 h"]
    status, _, err = command(LINES, *month)
    assert status == 0
    assert err.startswith("warning: a.tle: the interval goes on until 30.8 days from the elements")


def test_old_elements_are_taken_where_that_is_asked_for(command):
    far = ["--from", "2001-06-28Z", "--to", "2001-06-29Z", "--any-age"]
    assert command(LINES, *far)[0] == 0


@pytest.mark.parametrize(("file", "keys"), [
    ("a.tle", 'kind = "table"\nfile = "a.tle"'), ("a.tle", 'kind = "tle"'),
    ("a.tle", 'kind = "table"\ntle = "a.tle"'), ("a.tle", 'line1 = "1 00005U"'),
    ("a.oem", 'kind = "table"\nfile = "a.oem"'),
])  # fmt: skip
def test_a_scenario_says_how_elements_become_an_orbit(tmp_path, file, keys):
    (tmp_path / file).write_text("VANGUARD 1\n" + LINES)
    text = BODY + STATE + "[orbit.earth]\n" + keys
    with pytest.raises(ValueError, match="python -m polhode.satellites TLE --from DATE --to DATE"):
        polhode.Scenario.from_text(text, str(tmp_path / "a.toml"))
