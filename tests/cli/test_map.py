# SPDX-License-Identifier: MIT
"""`polhode map`: the same bytes for any number of threads, and after any number of kills."""

import os
import signal
import subprocess
import time

import budgets
import h5py
import numpy
import pytest
from ensemble_files import dimensions, expect_other_sines_rejected
from slowdown import SLOWDOWN

SECONDS = 60 * SLOWDOWN

MAP = """
[map]
kind = "chaos"
[[map.axis]]
key = "body.moments[1]"
from = 1.2
to = 2.4
count = 13
[[map.axis]]
key = "state.attitude-rate.omega_body[2]"
from = 0
to = 1
count = 11
"""


@pytest.fixture
def map_file(scenario):
    path = scenario(time="stop = 2000\ncount = 2")
    path.write_text(path.read_text() + MAP)
    return path


def test_any_number_of_threads_gives_the_same_file(run, map_file, tmp_path):
    outputs = []
    for threads in (1, 2, 5):
        out = tmp_path / f"{threads}.csv"
        result = run.ok("map", map_file, "--out", out, "--threads", threads)
        assert "cells             143" in result.stdout
        outputs.append(out.read_bytes())
    assert outputs[0] == outputs[1] == outputs[2]


def test_a_map_survives_kills(polhode, run, map_file, tmp_path):
    whole, out, table = tmp_path / "whole.csv", tmp_path / "part.csv", tmp_path / "part.h5"
    run.ok("map", map_file, "--out", whole)
    command = [polhode, "map", map_file, "--out", out, "--out", table, "--resume",
               "--checkpoint", "0"]
    checkpoint = tmp_path / "part.csv.checkpoint"
    kept = []
    for pause in (0.02, 0.15, 0.05, 0.1):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(pause)
        process.kill()
        process.wait()
        kept.append(checkpoint.exists())
    assert not out.exists() or not kept[-1]  # the name is that of a whole file
    run.ok(*command[1:])
    assert out.read_bytes() == whole.read_bytes()
    left = {"body.toml", "whole.csv", "part.csv", "part.h5"}
    assert {path.name for path in tmp_path.iterdir()} == left
    rows = numpy.loadtxt(whole, delimiter=",", skiprows=0, comments=["#", "body"])
    with h5py.File(table) as file:
        numpy.testing.assert_array_equal(file["chaos"][:], rows[:, 2:])
        numpy.testing.assert_array_equal(file["body.moments[1]"][:, 0], rows[:, 0])
    assert {names[0] for names in dimensions(table).values()} == {"row"}


def test_a_map_of_one_axis_has_its_dimension(run, scenario, tmp_path):
    path, out = scenario(time="stop = 20\ncount = 2"), tmp_path / "m.h5"
    path.write_text(path.read_text() + MAP[:MAP.rindex("[[map.axis]]")])
    run.ok("map", path, "--out", out)
    assert dimensions(out) == {"body.moments[1]": ("body.moments[1]",),
                               "chaos": ("body.moments[1]", "chaos_column")}


def test_a_machine_with_other_sines_does_not_go_on_unless_told(polhode, elsewhere, map_file,
                                                               tmp_path):
    path, out = map_file, tmp_path / "out.csv"
    path.write_text(path.read_text().replace("stop = 2000", "stop = 10000"))
    words = ["map", path, "--checkpoint", "0", "--out", out]
    expect_other_sines_rejected(polhode, elsewhere, words, out)


COLUMN = """
[[perturbation]]
kind = "constant-torque"
torque = [1e-4, 0, 2e-4]
[map]
kind = "column"
column = "w3"
[[map.axis]]
key = "body.moments[1]"
from = 1.4
to = 1.9
count = 6
"""


def test_a_cell_alone_has_the_numbers_of_the_map(run, scenario, tmp_path):
    path, out, rows, own = (scenario(), *(tmp_path / name for name in ("m.csv", "c.csv", "c.toml")))
    path.write_text(path.read_text() + COLUMN)
    run.ok("map", path, "--out", out)
    run.ok("map", path, "--cell", 4, "--out", rows, "--out", own)
    names, numbers = columns_of(rows)
    w3 = numbers[:, names.index("w3")]
    axis, smallest, largest, last = columns_of(out)[1][4]
    assert (smallest, largest, last) == (w3.min(), w3.max(), w3[-1])
    text = run.ok("map", path, "--cell", 4).stdout
    assert text == own.read_text() and text.startswith("# Cell 4 of body.toml, 6 cells\n")
    assert "map" not in text.replace("# Cell 4", "") and f"moments = [1, {axis}, 2.5]" in text
    run.ok("run", own, "--out", tmp_path / "again.csv")
    assert (columns_of(tmp_path / "again.csv")[1] == numbers).all()
    assert "got cell 6; expected 0 to 5" in run.rejected("map", path, "--cell", 6)
    assert "expected --cell alone, or --out PATH.csv as well" in run.rejected(
        "map", path, "--cell", 4, "--resume")


def columns_of(path):
    """The names of the columns of a file, and its rows."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return lines[0].split(","), numpy.array([[float(x) for x in line.split(",")]
                                             for line in lines[1:]])


def test_cells_that_fail_are_named(run, scenario, tmp_path):
    path = scenario()
    path.write_text(path.read_text() + COLUMN.replace("from = 1.4", "from = 0.4"))
    done = run.ok("map", path, "--out", tmp_path / "m.csv")
    assert ("failed            4, filled with nan; to run one: polhode map FILE --cell K:\n"
            "  cell 0: " in done.stdout)
    assert "body.moments" in run.rejected("map", path, "--cell", 0, "--out", tmp_path / "c.csv")


SECTION = """
[[perturbation]]
kind = "constant-torque"
torque = [1e-4, 0, 2e-4]
[map]
kind = "andoyer-section"
angle = "g"
[[map.axis]]
key = "state.attitude-rate.omega_body[1]"
from = 0.1
to = 0.9
count = 9
"""


def test_a_section_is_the_same_for_any_number_of_threads_and_after_kills(
        polhode, run, scenario, tmp_path):
    path = scenario(time="stop = 4000\ncount = 2")
    path.write_text(path.read_text() + SECTION)
    outputs = []
    for threads in (1, 3):
        out = tmp_path / f"{threads}.csv"
        result = run.ok("map", path, "--out", out, "--threads", threads)
        assert "cells             9\npoints            " in result.stdout
        outputs.append(out.read_bytes())
    assert outputs[0] == outputs[1]
    rows = numpy.loadtxt(tmp_path / "1.csv", delimiter=",", comments=["#", "state"])
    assert len(rows) > 1000 and len(set(rows[:, 0])) == 9
    out = tmp_path / "killed.csv"
    command = [polhode, "map", path, "--out", out, "--resume", "--checkpoint", "0"]
    for pause in (0.1, 0.2, 0.3):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(pause)
        process.kill()
        process.wait()
    run.ok(*command[1:])
    assert out.read_bytes() == outputs[0]


def test_the_section_of_hyperion_has_curves_and_a_sea(run, root, tmp_path):
    out = tmp_path / "hyperion.csv"
    run.ok("map", root / "examples/hyperion-section.toml", "--out", out)
    rows = numpy.loadtxt(out, delimiter=",", comments=["#", "state"])
    n = 16.9196785  # deg/d
    across = rows[rows[:, 1] == 90]
    regular, chaotic = (across[abs(across[:, 0] / n - spin) < budgets.section_axis][:, 3:5]
                        for spin in (2.6, 1.0))
    assert len(regular) == len(chaotic) == 200

    def boxes(points):
        return len({(int(angle // 6), int(spin // 0.1)) for angle, spin in points})

    assert boxes(regular) < 60 and boxes(chaotic) > 120


@pytest.fixture
def slow_map(scenario):
    """A map that is still running while a test looks at it, on any machine."""
    path = scenario(time="stop = 100000\ncount = 2")
    path.write_text(path.read_text() + MAP)
    return path


def cells_in(checkpoint):
    """How many cells it has, as its first line says."""
    return int(checkpoint.read_bytes().partition(b" ")[0])


def begun(polhode, path, out):
    """A map that goes on, with a few cells behind it."""
    process = subprocess.Popen(
        [polhode, "map", path, "--out", out, "--threads", "2", "--checkpoint", "0"], text=True,
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    checkpoint, deadline = out.with_name(out.name + ".checkpoint"), time.monotonic() + 60
    while time.monotonic() < deadline and process.poll() is None:
        if checkpoint.exists() and cells_in(checkpoint) > 3:
            break
        time.sleep(0.005)
    assert process.poll() is None
    return process


@pytest.mark.parametrize("by, status", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_stops_a_map_in_order(polhode, run, slow_map, tmp_path, by, status):
    out, checkpoint = tmp_path / "m.csv", tmp_path / "m.csv.checkpoint"
    process = begun(polhode, slow_map, out)
    process.send_signal(by)
    err = process.communicate(timeout=SECONDS)[1]
    assert process.returncode == status and not out.exists()
    line = err.splitlines()[-1]
    assert line.startswith("body.toml: stopped after ") and line.endswith(
        f" of 143 cells; continue with: {polhode} map {slow_map} --out {out} --threads 2 --resume")
    # what is there is not thrown away by the same command, typed again
    before = checkpoint.read_bytes()
    done = run("map", slow_map, "--out", out)
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    number = int(line.split("stopped after ")[1].split()[0])
    assert number >= 3 and done.stderr.startswith(
        f"{checkpoint}: an unfinished map is there ({number} of 143 cells); --resume continues it, "
        "--restart begins anew")
    assert checkpoint.read_bytes() == before
    # on purpose it is
    slow_map.write_text(slow_map.read_text().replace("count = 13", "count = 2")
                        .replace("count = 11", "count = 1"))
    done = run("map", slow_map, "--out", out, "--resume")
    assert done.returncode == 2 and "is of another map" in done.stderr
    assert "--restart runs this one anew" in done.stderr and checkpoint.read_bytes() == before
    run.ok("map", slow_map, "--out", out, "--restart")
    assert out.exists() and not checkpoint.exists()


def test_one_map_at_a_time(polhode, run, slow_map, map_file, tmp_path):
    out, checkpoint = tmp_path / "m.csv", tmp_path / "m.csv.checkpoint"
    process = begun(polhode, slow_map, out)
    try:
        process.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, process.pid, os.WSTOPPED)  # every thread of it
        before = checkpoint.read_bytes()
        for option in ([], ["--resume"], ["--restart"]):
            for path in (slow_map, map_file):
                done = run("map", path, "--out", out, *option)
                assert done.returncode == 2
                assert done.stderr == f"{out}.part: another process is writing it\n"
        assert checkpoint.read_bytes() == before
    finally:
        process.kill()
        process.communicate()


def test_a_complete_map_has_nothing_to_do(run, map_file, tmp_path):
    out, table = tmp_path / "m.csv", tmp_path / "m.h5"
    first = run.ok("map", map_file, "--out", out, "--out", table, "--resume")
    assert first.stderr.startswith("body.toml: no cells to continue from, starts anew\n")
    before = out.stat().st_mtime_ns
    again = run("map", map_file, "--out", out, "--out", table, "--resume")
    assert (again.returncode, again.stdout, again.stderr) == (
        0, f"body.toml: nothing to do: complete in {out}, {table}\n", "")
    assert out.stat().st_mtime_ns == before
    map_file.write_text(map_file.read_text().replace("count = 11", "count = 2"))
    assert "is there, of another scenario" in run.rejected("map", map_file, "--out", out,
                                                           "--resume")
    run.ok("map", map_file, "--out", out, "--restart")


# A limit on the size of files stands for a full disk.
def test_a_disk_that_fills_up_keeps_the_cells(polhode, run, map_file, tmp_path):
    whole, out = tmp_path / "whole.csv", tmp_path / "m.csv"
    map_file.write_text(map_file.read_text().replace("from = 1.2", "from = 1.6")
                        .replace("count = 13", "count = 40"))
    run.ok("map", map_file, "--out", whole)
    assert whole.stat().st_size > 18 * 1024
    for kilobytes, status in ((8, 1), (16, 1), (None, 0)):
        limit = f"ulimit -f {kilobytes}; exec \"$@\"" if kilobytes else "exec \"$@\""
        done = subprocess.run(
            ["bash", "-c", limit, "bash", polhode, "map", map_file, "--out", out, "--resume",
             "--checkpoint", "0"], text=True, capture_output=True)
        assert done.returncode == status, done.stderr
        if status:
            line = done.stderr.splitlines()[-1]
            # which of the two grows past the limit depends on the threads: a cell that waits for an
            # earlier one is in the checkpoint, one that does not is in the file
            places = (".checkpoint.part", ".part")
            said = ": cannot be written: File too large; raise the "
            assert line.startswith(tuple(f"{out}{place}{said}" for place in places))
            assert line.endswith(" of 440 cells") and ", then --resume goes on after " in line
    assert out.read_bytes() == whole.read_bytes()


def test_a_map_does_not_overwrite_an_unfinished_run(polhode, run, scenario, map_file, tmp_path):
    body = scenario(name="long.toml", time="stop = 5e6\nstep = 0.1")
    out, checkpoint = tmp_path / "m.csv", tmp_path / "m.csv.checkpoint"
    process = subprocess.Popen([polhode, "run", body, "--out", out, "--checkpoint", "0.1"],
                               stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 60
    while not checkpoint.exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    process.kill()
    process.wait()
    before = (tmp_path / "m.csv.part").read_bytes()
    done = run("map", map_file, "--out", out)
    assert done.returncode == 2
    assert done.stderr.startswith(
        f"{checkpoint}: an unfinished run is there; expected another file")
    assert (tmp_path / "m.csv.part").read_bytes() == before
    run.ok("map", map_file, "--out", out, "--restart")
    assert not checkpoint.exists()


def test_a_map_with_another_table_does_not_go_on(polhode, run, slow_map, tmp_path):
    table, out = tmp_path / "burn.csv", tmp_path / "m.csv"
    slow_map.write_text(slow_map.read_text() + '[[perturbation]]\nkind = "torque-table"\n'
                        'file = "burn.csv"\nbetween = "step"\noutside = "zero"\n')
    table.write_text("t,x,y,z\n0,0,0,0\n1.1,1e-3,0,0\n1.2,0,0,0\n5,0,0,0\n")
    process = begun(polhode, slow_map, out)
    process.kill()
    process.communicate()
    checkpoint = tmp_path / "m.csv.checkpoint"
    before = checkpoint.read_bytes()
    table.write_text(table.read_text().replace("1e-3", "2e-3"))
    assert "is of another map" in run.rejected("map", slow_map, "--out", out, "--resume")
    assert checkpoint.read_bytes() == before


@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_a_complete_run_is_no_complete_map(run, map_file, tmp_path, extension):
    path = tmp_path / f"a.{extension}"
    for first, second in (("run", "map"), ("map", "run")):
        run.ok(first, map_file, "--out", path, "--restart")
        before = path.read_bytes()
        done = run(second, map_file, "--out", path, "--resume")
        assert (done.returncode, done.stderr) == (
            2, f"{path}: is there, of another run or map of this scenario; --restart runs this one "
               "anew\n")
        assert path.read_bytes() == before
        assert "nothing to do" in run(first, map_file, "--out", path, "--resume").stdout


def test_a_pipe_gets_one_head(run, polhode, map_file, tmp_path):
    whole = tmp_path / "whole.csv"
    run.ok("map", map_file, "--out", whole)
    done = subprocess.run([polhode, "map", map_file, "--out", "/dev/stdout"], capture_output=True,
                          timeout=SECONDS)
    assert done.returncode == 0 and done.stdout.startswith(whole.read_bytes())


def test_a_run_does_not_overwrite_an_unfinished_map(polhode, run, scenario, slow_map, tmp_path):
    out, checkpoint = tmp_path / "m.csv", tmp_path / "m.csv.checkpoint"
    process = begun(polhode, slow_map, out)
    process.kill()
    process.communicate()
    before = checkpoint.read_bytes()
    for option in ([], ["--resume"]):
        done = run("run", scenario(name="other.toml"), "--out", out, *option)
        assert done.returncode == 2 and done.stderr.startswith(
            f"{checkpoint}: an unfinished map is there; expected another file for the run, or "
            "--restart, which loses the map")
    assert checkpoint.read_bytes() == before
    run.ok("run", scenario(name="other.toml"), "--out", out, "--restart")
    assert not checkpoint.exists()


def test_a_run_does_not_take_the_file_of_a_map(polhode, run, scenario, slow_map, tmp_path):
    out = tmp_path / "m.csv"
    process = begun(polhode, slow_map, out)
    try:
        process.send_signal(signal.SIGSTOP)
        done = run("run", scenario(name="other.toml"), "--out", out)
        assert done.returncode == 2
        assert done.stderr == f"{out}.part: another process is writing it\n"
    finally:
        process.kill()
        process.communicate()


def test_what_is_no_map(run, scenario, map_file, tmp_path):
    assert "expected a table [map]" in run.rejected("map", scenario(name="plain.toml"))
    assert "--resume" in run.rejected("map", map_file, "--resume")
    (tmp_path / "m.csv.checkpoint").write_text("something else\n")
    result = run("map", map_file, "--out", tmp_path / "m.csv", "--resume")
    assert result.returncode == 2 and "is not a checkpoint of this version" in result.stderr
    assert "--restart runs this one anew" in result.stderr
