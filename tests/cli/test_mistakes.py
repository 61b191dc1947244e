# SPDX-License-Identifier: MIT
"""48 mistakes that users make in a scenario file or behind `polhode run`: each gives one line that
names the place or the option, the value and what is required, exit code 2, and nothing on the disk
is written or lost. More, of the readers and of failed runs: test_bad_input.py; 30 in Python:
python/tests/test_mistakes.py."""

import pytest

APOPHIS = """schema = 1
[units]
time = "h"
angle = "deg"
[body]
moments = [0.61, 0.965, 1.0]
[state.tumbler]
precession_period = 30.56
rotation_period = 263
pole = { longitude = 250, latitude = -75 }
mode = "SAM"
[time]
stop = 720
step = 0.5
"""
PULL = "[[perturbation]]\nkind = \"gravity-gradient\"\norbit = \"earth\"\n[orbit.earth]\n"
STATE = APOPHIS[APOPHIS.index("[state"):APOPHIS.index("[time]")]
RATE = "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [0, 0, 1]\n"


def but(old, new):
    """The scenario with one thing else."""
    assert APOPHIS.count(old) == 1, old
    return APOPHIS.replace(old, new)


def dated(epoch):
    return but("[state.tumbler]", f"[state]\nepoch = {epoch}\n[state.tumbler]")


def pulled(orbit):
    return APOPHIS + PULL + orbit


# What is wrong: the scenario, and what follows FILE: or the whole start of the line.
IN_THE_FILE = {
    "a key in camel case": (
        but("precession_period", "precessionPeriod"),
        "8:1: state.tumbler.precessionPeriod: unknown key; did you mean precession_period?"),
    "a chart at the top": (
        but("[state.tumbler]", "[tumbler]"),
        "7:2: tumbler: unknown table; did you mean [state.tumbler]?"),
    "keys of a chart in state": (
        but("[state.tumbler]", "[state]"),
        "8:1: state.precession_period: unknown key; it belongs in [state.tumbler], as do "
        "rotation_period, pole, mode"),
    "a key above its table": (
        but("schema = 1", "schema = 1\nmoments = [1, 2, 2.5]"),
        "2:1: moments: unknown key; it belongs in [body]"),
    "a key of the top in a table": (
        but("[body]", "[body]\ntitle = \"Apophis\""),
        "6:1: body.title: unknown key; it belongs at the top of the file, above all tables"),
    "a table in a table": (
        but("[body]", "[body]\nunits = { time = \"h\" }"),
        "6:1: body.units: unknown key; it belongs in [units]"),
    "a key of another kind of file": (
        but("[body]", "[body]\nellipticity = 0.003"),
        "6:1: body.ellipticity: unknown key; expected"),
    "two pairs of brackets": (
        but("[body]", "[[body]]"),
        "5:1: body: got [a table]; expected a table [body] with one of moments, tensor, shape with "
        "density; it stands in one pair of brackets"),
    "one pair of brackets": (
        APOPHIS + "[perturbation]\nkind = \"damping\"\n",
        "15:1: perturbation: got a table; expected tables [[perturbation]]"),
    "a table twice": (
        APOPHIS + "[time]\nstop = 3\n",
        "15:1: file: not TOML: Error while parsing table header: cannot redefine existing table "
        "'time'"),
    "no state": (
        APOPHIS.replace(STATE, ""),
        "1:1: state: got nothing; expected a table [state] with one of tumbler, attitude-rate,"),
    "no body": (
        but("[body]\nmoments = [0.61, 0.965, 1.0]\n", ""),
        "1:1: body: got nothing; expected a table [body] with one of moments, tensor, shape"),
    "an empty body": (
        but("moments = [0.61, 0.965, 1.0]\n", ""),
        "5:1: body: got none of them; expected exactly one of moments, tensor, shape"),
    "moments and a tensor": (
        but("[body]", "[body]\ntensor = [[1, 0, 0], [0, 2, 0], [0, 0, 2.5]]"),
        "6:10: body: got moments, tensor; expected exactly one of moments, tensor, shape"),
    "moments as text": (
        but("[0.61, 0.965, 1.0]", "\"0.61, 0.965, 1.0\""),
        "6:11: body.moments: got \"0.61, 0.965, 1.0\"; expected an array of 3 numbers"),
    "two moments": (
        but("[0.61, 0.965, 1.0]", "[0.61, 1.0]"),
        "6:11: body.moments: got [0.61, 1]; expected an array of 3 numbers"),
    "moments by name": (
        but("[0.61, 0.965, 1.0]", "{ A = 0.61, B = 0.965, C = 1 }"),
        "6:11: body.moments: got a table; expected an array of 3 numbers"),
    "moments of zero": (
        but("[0.61, 0.965, 1.0]", "[0, 0, 0]"),
        "6:11: body.moments: got [0, 0, 0]; Body: moments (0, 0, 0) must be positive and finite"),
    "a moment of 1e400": (
        but("1.0]", "1e400]"),
        "6:30: file: not TOML: Error while parsing floating-point: '1e400' could not be "
        "interpreted as a value; numbers reach up to 1e308"),
    "a decimal comma": (
        but("step = 0.5", "step = 0,5"),
        "14:9: file: not TOML: Error while parsing key-value pair: expected a comment or "
        "whitespace, saw ','; decimals have a point, arrays brackets"),
    "no digit before the point": (
        but("step = 0.5", "step = .5"),
        "14:8: file: not TOML: Error while parsing floating-point: expected decimal digit, saw "
        "'.'; a number has a digit before its point"),
    "a word without quotes": (
        but("\"SAM\"", "SAM"),
        "11:8: file: not TOML: Error while parsing value: could not determine value type; text "
        "stands in quotes"),
    "a mode in lower case": (
        but("\"SAM\"", "\"sam\""),
        "11:8: state.tumbler.mode: got \"sam\"; expected \"SAM\" or \"LAM\""),
    "quotes of a word processor": (
        but("\"SAM\"", "\u201cSAM\u201d"),
        "11:8: file: not TOML: got a typographic character outside of quotes; expected plain "
        "quotes: \""),
    "a minus of a web page": (
        but("-75", "\u221275"),
        "10:38: file: not TOML: got a typographic character outside of quotes; expected a plain "
        "minus: -"),
    "UTF-16": (
        APOPHIS.encode("utf-16"), "1:1: file: not TOML: got UTF-16; expected a file in UTF-8"),
    "Latin-1": (
        but("schema = 1", "schema = 1\ntitle = \"M\xfcller\"").encode("latin-1"),
        "2:10: file: not TOML: Encountered invalid utf-8 sequence"),
    "JSON": (
        "{\"schema\": 1, \"body\": {\"moments\": [1, 2, 2.5]}}",
        "1:1: file: not TOML: Error while parsing root table: expected keys, tables, whitespace or "
        "comments, saw '{'; this looks like JSON"),
    "YAML": (
        "schema: 1\nbody:\n  moments: [1, 2, 2.5]\n",
        "1:7: file: not TOML: Error while parsing key-value pair: expected '=', saw ':'; a key and "
        "its value have = between them"),
    "a unit of another kind": (
        but("30.56", "\"30.56 deg\""),
        "8:21: state.tumbler.precession_period: got \"30.56 deg\"; expected a time: a number (of "
        "h), \"1 h\" or { value = 1, unit = \"h\" }; \"deg\" is not a unit of time here"),
    "a unit without a number": (
        but("30.56", "\"h\""),
        "8:21: state.tumbler.precession_period: got \"h\"; expected a time:"),
    "a unit in units that is a number": (
        but("time = \"h\"", "time = 3600"),
        "3:8: units.time: got 3600; expected a unit in quotes such as"),
    "a period of zero": (
        but("30.56", "0"),
        "8:21: state.tumbler.precession_period: got 0; expected a positive time"),
    "a latitude beyond the pole": (
        but("-75", "-95"),
        "10:38: state.tumbler.pole.latitude: got -95; expected an angle from -90 to 90 deg"),
    "a pole as a list": (
        but("{ longitude = 250, latitude = -75 }", "[250, -75]"),
        "10:8: state.tumbler.pole: got [250, -75]; expected a table [state.tumbler.pole] with one "
        "of longitude with latitude, ra with dec"),
    "a quaternion of three": (
        APOPHIS.replace(STATE, RATE.replace("[1, 0, 0, 0]", "[0, 0, 1]")),
        "8:14: state.attitude-rate.quaternion: got [0, 0, 1]; expected an array of 4 numbers"),
    "a step that is NaN": (
        but("step = 0.5", "step = nan"),
        "14:8: time.step: got nan; expected a time:"),
    "rows without end": (
        but("step = 0.5", "step = 1e-30"),
        "14:8: time.step: got 1e-30; SaveAt: a step of 1e-30 makes more than 2^53 rows"),
    "step and count": (
        but("step = 0.5", "step = 0.5\ncount = 3"),
        "15:9: time: got stop, step, count; expected exactly one of stop with step, stop with "
        "count, at"),
    "a date without an epoch": (
        but("720", "\"2013-01-05 UTC\""),
        "13:8: time.stop: got \"2013-01-05 UTC\"; expected a time:"),
    "month 13": (
        dated("\"2013-13-05 UTC\""),
        "8:9: state.epoch: got \"2013-13-05 UTC\"; expected a date with its scale"),
    "a torque without a kind": (
        APOPHIS + "[[perturbation]]\ntorque = [0, 0, 1]\n",
        "15:1: perturbation[0].kind: got nothing; expected \"gravity-gradient\","),
    "a short name of a key": (
        pulled("kind = \"kepler\"\na = 7000\ngm = 3\n"),
        "20:1: orbit.earth.a: unknown key; did you mean semi_major_axis? with kind \"kepler\" "
        "expected kind, gm, "
        "semi_major_axis,"),
    "a longitude of the pericentre": (
        pulled("kind = \"kepler\"\nsemi_major_axis = 7000\ngm = 3\nPomega = 1\n"),
        "22:1: orbit.earth.Pomega: unknown key; did you mean pericentre_argument?"),
    "an argument of another name": (
        pulled("kind = \"kepler\"\nsemi_major_axis = 7000\ngm = 3\nargp = 1\n"),
        "22:1: orbit.earth.argp: unknown key; did you mean pericentre_argument?"),
    "a true anomaly": (
        pulled("kind = \"kepler\"\nsemi_major_axis = 7000\ngm = 3\nf = 1\n"),
        "22:1: orbit.earth.f: unknown key; did you mean mean_anomaly?"),
    "a mean anomaly that is misspelt": (
        pulled("kind = \"kepler\"\nsemi_major_axis = 7000\ngm = 3\nmean_anomoly = 1\n"),
        "22:1: orbit.earth.mean_anomoly: unknown key; did you mean mean_anomaly? with kind "
        "\"kepler\" expected kind,"),
    "an empty table of an orbit": (
        pulled("kind = \"table\"\nfile = \"empty.csv\"\n"),
        "20:8: orbit.earth.file: got \"empty.csv\"; empty.csv: holds no row"),
    "a frame that is called otherwise": (
        APOPHIS + "[frame.lvlh]\n",
        "15:8: frame.lvlh: unknown key; expected precessing, orbit-plane or local-vertical"),
}
BEHIND_RUN = {
    "--set without a value": (["--set", "time.stop"],
                              "--set: got \"time.stop\"; expected KEY=VALUE, such as"),
    "--set of nothing there": (
        ["--set", "perturbation[0].kind=drag"],
        "--set: perturbation[0].kind: the file has no perturbation; expected a key that it has, or "
        "one that its tables may have"),
    "--out of what it reads": (
        ["--set", "perturbation=[{ kind = \"torque-table\", file = \"torque.csv\" }]",
         "--out", "./torque.csv"],
        "./torque.csv: is a file that the scenario reads, torque.csv; expected another to write"),
}


def test_there_are_52():
    assert len(IN_THE_FILE) + len(BEHIND_RUN) == 52


def refused(run, folder, scenario, arguments):
    """The line of a run that is refused, and leaves the folder as it was."""
    (folder / "body.toml").write_bytes(
        scenario if isinstance(scenario, bytes) else scenario.encode())
    (folder / "empty.csv").write_text("")
    (folder / "torque.csv").write_text("t,torque1,torque2,torque3\n0,0,0,0\n999,0,0,0\n")
    (folder / "out.csv").write_text("an older file\n")
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    result = run("run", "body.toml", *arguments, cwd=folder)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before
    assert result.returncode == 2 and result.stdout == "", result
    lines = result.stderr.splitlines()
    assert len(lines) == 1 and lines[0].isascii(), result.stderr
    return lines[0]


@pytest.mark.parametrize("what", IN_THE_FILE)
def test_a_mistake_in_the_file_is_one_line(run, tmp_path, what):
    scenario, line = IN_THE_FILE[what]
    assert refused(run, tmp_path, scenario, ["--out", "out.csv"]).startswith("body.toml:" + line)


@pytest.mark.parametrize("what", BEHIND_RUN)
def test_a_mistake_behind_run_is_one_line(run, tmp_path, what):
    arguments, line = BEHIND_RUN[what]
    if "--out" not in arguments:
        arguments = [*arguments, "--out", "out.csv"]
    assert refused(run, tmp_path, APOPHIS, arguments).startswith(line)


def test_two_outputs_are_one_file(run, tmp_path):
    line = refused(run, tmp_path, APOPHIS, ["--out", "out.csv", "--out", "./out.csv"])
    assert line == "./out.csv: is the same file as out.csv; expected another to write"
    line = refused(run, tmp_path, APOPHIS, ["--out", ""])
    assert line == "run: got an empty path; expected a file to write, or -"
