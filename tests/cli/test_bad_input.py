# SPDX-License-Identifier: MIT
"""Bad input is a one-line error that names file, line, value and requirement: exit code 2, no
output, no crash. A run that fails says so in one line: exit code 1, PATH.part stays."""

import os
import random
import signal
import subprocess
import time

import pytest
from scenario_parts import BODY as HEAD

ANDOYER = "[state.andoyer]\nl = 1\ng = 2\nh = 3\nL = 0.5\nG = 1\nH = 0.1\n"
TUMBLER = ("[state.tumbler]\nmode = \"SAM\"\nprecession_period = 30.56\nrotation_period = 263\n"
           "pole = { longitude = 1, latitude = 1 }\n")

# what is wrong, the scenario, where, what the message holds
SCENARIOS = {
    "triangle": ("schema = 1\n[body]\nmoments = [1, 1, 3]\n" + ANDOYER, "3:11: body.moments",
                 "(1, 1, 3)"),
    "negative": ("schema = 1\n[body]\nmoments = [1, -1, 1]\n" + ANDOYER, "3:11: body.moments",
                 "-1"),
    "nan": ("schema = 1\n[body]\nmoments = [1, nan, 1]\n" + ANDOYER, "3:15: body.moments",
            "got nan; expected an array of 3 numbers"),
    "infinite": (HEAD + ANDOYER.replace("G = 1", "G = inf"), "9:5: state.andoyer.G", "got inf"),
    "tensor": ("schema = 1\n[body]\ntensor = [[1, 2, 0], [0, 1, 0], [0, 0, 1]]\n" + ANDOYER,
               "3:10: body.tensor", "mirror"),
    "quaternion": (HEAD + "[state.attitude-rate]\n"
                   "quaternion = [0, 0, 0, 0]\nomega_body = [1, 2, 3]\n",
                   "5:14: state.attitude-rate.quaternion", "got [0, 0, 0, 0]"),
    "L beyond G": (HEAD + ANDOYER.replace("L = 0.5", "L = 1.5"), "8:5: state.andoyer.L", "got 1.5"),
    "H beyond G": (HEAD + ANDOYER.replace("H = 0.1", "H = -7"), "10:5: state.andoyer.H", "got -7"),
    "period pair": (HEAD + TUMBLER.replace("263", "0.5"), "7:19: state.tumbler.rotation_period",
                    "at least"),
    "psi0": (HEAD.replace("[1, 2, 2.5]", "[0.61, 0.965, 1]") + TUMBLER + "psi0 = 1.5\n",
             "9:8: state.tumbler.psi0", "psi_max = 0.939"),
    "serret energy": (HEAD + "[state.serret]\ng0 = 0\nh = 0\nt0 = 0\nG = 1\nH = 0\nT = 9\n",
                      "4:1: state.serret", "needs T in [G^2/2I3, G^2/2I1]"),
    "sadov actions": (HEAD + "[state.sadov]\nphi_l = 0\nphi_g = 0\nphi_h = 0\n"
                      "I_l = 2\nI_g = 1\nI_h = 0\n",
                      "4:1: state.sadov", "|I_l| <= I_g"),
    "unknown unit": (HEAD + ANDOYER + "[time]\nstop = \"3 hours\"\nstep = 1\n", "12:8: time.stop",
                     "did you mean h?"),
    "wrong dimension": (HEAD + ANDOYER + "[time]\nstop = \"3 deg\"\nstep = 1\n", "12:8: time.stop",
                        "is not a unit of time"),
    "reciprocal": (HEAD + ANDOYER + "[time]\nstop = \"3 1/s\"\nstep = 1\n", "12:8: time.stop",
                   "is not a unit of time"),
    "misspelt key": (HEAD.replace("moments", "momnets") + ANDOYER, "3:1: body.momnets",
                     "did you mean moments?"),
    "misspelt key of a kind": (
        HEAD + ANDOYER +
        "[[perturbation]]\nkind = \"internal-damping\"\nrate = 1\nwoble_time = 5\n",
        "14:1: perturbation[0].woble_time",
        "unknown key; did you mean wobble_time? with kind \"internal-damping\" expected kind, k, "
        "grows, wobble_time or rate"),
    "key far from any": (
        HEAD + ANDOYER +
        "[[perturbation]]\nkind = \"damping\"\nxyzzyx = 5\ncoefficients = [1, 1, 1]\n",
        "13:1: perturbation[0].xyzzyx",
        "unknown key; with kind \"damping\" expected kind or coefficients"),
    "negative wobble time": (
        HEAD + ANDOYER + "[[perturbation]]\nkind = \"internal-damping\"\nrate = 1\n"
        "wobble_time = \"-100 d\"\n",
        "14:15: perturbation[0].wobble_time", "got \"-100 d\"; expected a positive time"),
    "inertia not symmetric": (
        "schema = 1\n[body]\ntensor = [[1, 0.5, 0], [0.25, 2, 0], [0, 0, 2.5]]\n" + ANDOYER,
        "3:10: body.tensor", "got [[1, 0.5, 0], [0.25, 2, 0], [0, 0, 2.5]]; "),
    "unit of an array": (
        HEAD + ANDOYER + "[[perturbation]]\nkind = \"constant-torque\"\n"
        "torque = { value = [1, 2, 3], unit = \"Nmm\" }\n",
        "perturbation[0].torque",
        "got { value = [1, 2, 3], unit = \"Nmm\" }; expected an array of 3 numbers"),
    "a multiple of a unit": (
        "schema = 1\n[units]\nlength = \"um\"\n" + HEAD.partition("\n")[2] + ANDOYER,
        "3:10: units.length", "unknown unit \"um\"; expected s, min"),
    "index of an axis": (
        HEAD + ANDOYER + "[time]\nstop = 1\ncount = 2\n[map]\nkind = \"chaos\"\n[[map.axis]]\n"
        "key = \"body.moments\"\nfrom = 1\nto = 2\ncount = 3\n",
        "17:7: map.axis[0].key", "did you mean body.moments[0]?"),
    "misspelt table": (HEAD.replace("[body]", "[bdoy]") + ANDOYER, "2:2: bdoy",
                       "did you mean body?"),
    "misspelt column": (HEAD + ANDOYER + "[output]\ncolumns = [\"omgea\"]\n",
                        "12:12: output.columns", "did you mean \"omega\"?"),
    "two charts": (HEAD + ANDOYER + TUMBLER, "state", "expected exactly one of"),
    "no such day": (HEAD + "[state]\nepoch = \"2013-02-29 UTC\"\n" + ANDOYER, "5:9: state.epoch",
                    "no such day"),
    "step that leads away": (HEAD + ANDOYER + "[time]\nstop = 1\nstep = -1\n", "13:8: time.step",
                             "got -1"),
    "wrong schema": (HEAD.replace("1\n", "2\n", 1) + ANDOYER, "1:10: schema", "got 2; expected 1"),
    "not TOML": (HEAD + "moments = \n", "4:11: file", "not TOML"),
    "key twice": (HEAD + "moments = [1, 1, 1]\n" + ANDOYER, "4:11: file", "not TOML"),
    "empty": ("", "1:1: file", "expected a scenario"),
    "a comment": ("# nothing\n", "1:1: file", "expected a scenario"),
    "deep key": ("a." * 1000000 + "a = 1\n", "1:502: file", "dots"),
    "deep array": ("a = " + "[" * 1000000, "1:", "not TOML"),
}


def check_one_line(result, code):
    assert result.returncode == code, result.stderr
    assert result.stdout == ""
    lines = result.stderr.splitlines()
    assert len(lines) == 1, result.stderr
    assert len(lines[0]) < 700
    return lines[0]


@pytest.mark.parametrize("what", SCENARIOS)
def test_scenario(run, tmp_path, what):
    text, place, message = SCENARIOS[what]
    path, out = tmp_path / "bad.toml", tmp_path / "bad.csv"
    path.write_text(text, encoding="utf-8")
    for arguments in (["info", path], ["run", path, "--out", out], ["cite", path]):
        line = check_one_line(run(*arguments), 2)
        assert line.startswith(f"{path}:") and place in line and message in line, line
    line = check_one_line(run("info", "-", stdin=text), 2)
    assert line.startswith("<stdin>:") and message in line, line
    assert not list(tmp_path.glob("bad.csv*"))


def test_every_mistake_is_a_line_in_the_order_of_the_file(run, tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text("schema = 1\ntitel = 2\n[body]\nmoments = [1, 2]\n" + ANDOYER +
                    "[time]\nstop = \"1 hour\"\nstep = 1\n", encoding="utf-8")
    lines = run("info", path).stderr.splitlines()
    assert [int(line.removeprefix(f"{path}:").split(":")[0]) for line in lines] == [2, 4, 13]


def test_noise(run, tmp_path, full):
    path = tmp_path / "noise.toml"
    noise = random.Random(5)
    for size in (1, 100, 10_000, 1_000_000) + ((16 << 20,) if full else ()):
        path.write_bytes(noise.randbytes(size))
        line = check_one_line(run("info", path), 2)
        assert line.startswith(f"{path}:1:") and line.isascii()


def test_100_megabytes_of_noise(run, tmp_path):
    path = tmp_path / "noise.toml"
    block = random.Random(6).randbytes(1 << 20)
    with path.open("wb") as file:
        for _ in range(100):
            file.write(block)
    start = time.monotonic()
    line = check_one_line(run("info", path), 2)
    assert line == f"{path}:1:1: file: got more than 16 MB; expected a scenario of at most 16 MB"
    assert time.monotonic() - start < SECONDS_FOR_A_LARGE_FILE


SECONDS_FOR_A_LARGE_FILE = 20  # it is read up to its 16th megabyte, not parsed


def test_folders_and_missing_files(run, scenario, tmp_path):
    (tmp_path / "out.csv").mkdir()
    for arguments in (["info", tmp_path], ["info", tmp_path / "no.toml"],
                      ["run", scenario(), "--out", tmp_path / "out.csv"],
                      ["run", scenario(), "--out", tmp_path / "no/folder.csv"],
                      ["run", scenario(), "--out", tmp_path / "no/folder.h5"],
                      ["run", scenario(), "--out", tmp_path / "out.txt"],
                      ["run", scenario(), "--out", tmp_path / "a.csv", "--out", tmp_path / "a.csv"],
                      ["convert", "--from", "rotor", "--to", "euler", tmp_path]):
        line = check_one_line(run(*arguments), 2)
        assert str(tmp_path) in line or "body.toml" in line
    assert os.listdir(tmp_path / "out.csv") == []
    assert sorted(os.listdir(tmp_path)) == ["body.toml", "out.csv"]


def test_no_permission_no_output(run, scenario, tmp_path):
    if os.geteuid() == 0:
        pytest.skip("root may write anywhere")
    folder = tmp_path / "locked"
    folder.mkdir(mode=0o500)
    check_one_line(run("run", scenario(), "--out", folder / "a.csv"), 2)


def test_a_scenario_without_times_does_not_run(run, tmp_path):
    path = tmp_path / "a.toml"
    path.write_text(HEAD + ANDOYER, encoding="utf-8")
    run.ok("info", path)
    assert check_one_line(run("run", path), 2) == (
        f"{path}: time: got nothing; expected a table [time], stop with step or count, or at")


@pytest.mark.parametrize("arguments", [
    [], ["run"], ["no-such-command"], ["info", "--no-such-option", "x"], ["init", "no-chart"],
    ["convert", "--from", "rotor"], ["convert", "--from", "rotor", "--to", "x"],
    ["convert", "--from", "rotor", "--to", "sadov"],
    ["convert", "--from", "rotor", "--to", "sadov", "--moments", "1,2"],
    ["convert", "--from", "rotor", "--to", "sadov", "--moments", "1,2,x"],
    ["convert", "--from", "rotor", "--to", "sadov", "--moments", "1,1,3"],
    ["convert", "--from", "rotor", "--to", "sadov", "--moments", "1,nan,1"],
])
def test_wrong_arguments(run, arguments):
    check_one_line(run(*arguments), 2)


# the argument at fault, and what it could have been
@pytest.mark.parametrize("arguments, message", [
    (["--versio"], 'polhode: got option "--versio"; expected one of --help, --version'),
    (["rum", "x"], 'polhode: got command "rum"; expected one of run, map, ensemble, fit, '),
    (["run", "x", "--otu", "y"],
     'polhode run: got option "--otu"; expected one of --help, --set, --out'),
    (["run", "x", "y"], 'polhode run: got "y"; expected nothing after FILE'),
    (["convert", "--form", "rotor"],
     'polhode convert: got option "--form"; expected one of --help, --from, --to, --moments'),
    (["convert", "--from", "rotr", "--to", "euler"],
     'convert: --from: unknown chart "rotr"; expected rotor, '),
    (["convert", "--from", "rotor", "--to", "eulr"], "; did you mean euler?"),
    (["convert", "--from", "rotor", "--to", "sadov", "--moments", "1,1,3"],
     'convert: --moments: got "1,1,3"; Body: moments (1, 1, 3) break '),
    (["run", "x", "--checkpoint", "-3"],
     'polhode run: --checkpoint: got "-3"; expected a number of seconds, from 0 to 1e9'),
    (["map", "x", "--checkpoint", "soon"],
     'polhode map: --checkpoint: got "soon"; expected a number of seconds, from 0 to 1e9'),
    (["ensemble", "x", "--threads", "0"],
     'polhode ensemble: --threads: got "0"; expected a whole number, 1 or more'),
    (["ensemble", "x", "--member", "first"],
     'polhode ensemble: --member: got "first"; expected the index of a member, 0 or more'),
    (["map", "x", "--threads", "0"],
     'polhode map: --threads: got "0"; expected a whole number, 1 or more'),
    (["init", "tumblr"], 'polhode init: got "tumblr"; expected a chart (tumbler, '),
    (["init", "elipse"], " an orbit (kepler, "),
])
def test_message_names_the_argument(run, arguments, message):
    assert message in check_one_line(run(*arguments), 2)


@pytest.mark.parametrize("axes", ["", 'axes = "inertial"'])
def test_ra_and_dec_need_named_axes(run, tmp_path, axes):
    path = tmp_path / "a.toml"
    tumbler = TUMBLER.replace("{ longitude = 1, latitude = 1 }", "{ ra = 1, dec = 0.5 }")
    body = HEAD.replace("[1, 2, 2.5]", "[0.61, 0.965, 1]")
    path.write_text(body + f"[state]\n{axes}\n" + tumbler, encoding="utf-8")
    line = check_one_line(run("info", path), 2)
    assert line.startswith(f"{path}:10:") and "state.tumbler.pole" in line
    assert 'ra and dec need axes = "ecliptic-J2000" or "equator-J2000"' in line


def test_a_full_disk(run, scenario):
    """What cannot be written is a failed run, not a bad scenario."""
    line = check_one_line(run("run", scenario(), "--out", "/dev/full"), 1)
    assert line == "/dev/full: cannot be written: No space left on device"


@pytest.mark.parametrize("arguments", [["run"], ["info"], ["cite"], ["init"], ["schema"],
                                       ["--version"], ["run", "--help"], ["convert"]])
def test_a_full_standard_output(polhode, scenario, arguments):
    if arguments[-1] in ("run", "info", "cite"):
        arguments = [*arguments, str(scenario())]
    stdin = None
    if arguments[0] == "convert":
        arguments = ["convert", "--from", "andoyer", "--to", "rotor"]
        stdin = b"l,g,h,L,G,H\n1,1,1,0,1,0\n"
    with open("/dev/full", "wb") as full_disk:
        result = subprocess.run([polhode, *arguments], input=stdin, stdout=full_disk,
                                stderr=subprocess.PIPE)
    assert result.returncode == 1
    assert result.stderr.count(b"\n") == 1 and b"<stdout>: cannot be written" in result.stderr


# A limit on the size of files stands for a full disk: writing beyond it fails like one.
@pytest.mark.parametrize("extension", ["csv", "h5"])
@pytest.mark.parametrize("kilobytes", [0, 1, 40, 700])
def test_a_disk_that_fills_up(polhode, scenario, tmp_path, table, extension, kilobytes):
    path, old = tmp_path / f"a.{extension}", b"an older file"
    path.write_bytes(old)
    command = f"ulimit -f {kilobytes}; exec \"$@\""
    result = subprocess.run(
        ["bash", "-c", command, "bash", polhode, "run",
         scenario(time="stop = 1000\nstep = 0.1"), "--out", path],
        text=True, capture_output=True)
    line = check_one_line(result, 1)
    assert line == (f"{path}.part: cannot be written: File too large; raise the limit on the size "
                    "of files (ulimit -f), then run it again")
    assert path.read_bytes() == old
    if extension == "csv":
        lines = (tmp_path / "a.csv.part").read_text(encoding="utf-8").splitlines()
        rows = [line for line in lines[:-1] if not line.startswith("#")][1:]  # the last is cut
        assert len(rows) > 1000 or kilobytes < 700
        assert all(line.count(",") == 10 for line in rows)
    elif kilobytes == 700:
        h5py = pytest.importorskip("h5py")
        with h5py.File(tmp_path / "a.h5.part") as file:
            assert len(file["t"]) == len(file["q"]) >= 1024
            assert list(file["t"][:3]) == [0.0, 0.1, 0.2]
            assert abs(file["q"][-1]).max() > 0


@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_a_killed_run_leaves_its_blocks(polhode, scenario, tmp_path, extension):
    path = tmp_path / f"a.{extension}"
    part = tmp_path / f"a.{extension}.part"
    process = subprocess.Popen(
        [polhode, "run", scenario(time="stop = 5e6\nstep = 0.1"), "--out", path])
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and (not part.exists() or part.stat().st_size < 2_000_000):
        time.sleep(0.02)
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert part.stat().st_size >= 2_000_000
    assert not path.exists()
    if extension == "csv":
        lines = part.read_text(encoding="utf-8").splitlines()
        assert len(lines) > 1024
    else:
        h5py = pytest.importorskip("h5py")
        with h5py.File(part) as file:
            assert len(file["t"]) >= 1024
            assert list(file["t"][:3]) == [0.0, 0.1, 0.2]
