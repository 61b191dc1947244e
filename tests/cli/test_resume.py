# SPDX-License-Identifier: MIT
"""A run that was stopped, killed or had no disk left goes on, and leaves the files of the straight
run: CSV byte for byte, HDF5 by h5diff."""

import os
import signal
import subprocess
import time

import budgets
import killed_runs
import pytest
from slowdown import SLOWDOWN

KILLS = 8
SEED = 20260101
SECONDS = 60 * SLOWDOWN
SHORT = "stop = 3000\nstep = 0.1"
DAMPED = ('[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [0.1, 0.2, 1]\n'
          '[[perturbation]]\nkind = "damping"\ncoefficients = [1e-9, 1e-9, 1e-9]')
METHODS = {"free": "",
           "free-events": '[[event]]\ncolumn = "w2"\n[[event]]\nname = "n"\ncolumn = "qw"\n',
           "adaptive": '[method]\nkind = "adaptive"\ntolerance = 1e-9\n',
           "double-double": '[method]\nkind = "adaptive"\nprecision = "double-double"\n',
           "splitting": '[method]\nkind = "splitting"\nstep = 0.1\nscheme = "order4"\n',
           "variation": '[method]\nkind = "variation-of-constants"\ntolerance = 1e-10\n'}


def stopped(polhode, arguments, after, by=signal.SIGINT):
    """The run, stopped by a signal when it has written a file."""
    begun = time.time_ns()
    process = subprocess.Popen([polhode, *map(str, arguments)], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + SECONDS
    while killed_runs.changed(after) < begun and process.poll() is None:
        assert time.monotonic() < deadline, f"{after} was not written"
        time.sleep(0.005)
    process.send_signal(by)
    out, err = process.communicate(timeout=SECONDS)
    return process.returncode, out, err


@pytest.fixture
def long(scenario):
    """A scenario of hours, and the same of seconds."""
    return scenario(time="stop = 1e9\nstep = 20", state=DAMPED)


def test_killed_at_random_moments(polhode, tmp_path):
    scenario = tmp_path / "body.toml"
    scenario.write_text(killed_runs.SCENARIO.format(stop=9000))
    straight, killed = tmp_path / "straight", tmp_path / "killed"
    straight.mkdir()
    killed.mkdir()
    seconds = killed_runs.straight_run(polhode, scenario, straight)
    said, kills = killed_runs.killed_run(polhode, scenario, killed, KILLS, SEED, seconds / 4)
    assert killed_runs.differences(straight, killed) == []
    assert kills >= 2 and any("continues at" in text for text in said), said


def test_changes_and_dates_go_on_with_the_run(polhode, run, long, tmp_path):
    outputs = ["--out", tmp_path / "a.csv", "--out", tmp_path / "a.h5"]
    changes = ["--set", "output.columns=[\"date\", \"tumbler\", \"q\"]",
               "--set", "state.epoch=2013-01-05 UTC"]
    code, _, err = stopped(polhode, ["run", long, *changes, *outputs], tmp_path / "a.csv.part")
    assert code == 130 and "'state.epoch=2013-01-05 UTC'" in err.splitlines()[-1]
    refused = run("run", long, *outputs, "--resume")
    assert refused.returncode == 2 and "--restart" in refused.stderr  # another scenario
    short = ["run", long, *changes, "--set", "time.stop=40", *outputs]
    run.ok(*short, "--restart")
    assert run(*short, "--resume").stdout.startswith(f"{long.name}: nothing to do")


def test_complete_it_sweeps_what_a_kill_at_its_very_end_left(run, scenario, tmp_path):
    path, outs = scenario(), [tmp_path / "a.csv", tmp_path / "a.h5"]
    command = ["run", path, "--out", outs[0], "--out", outs[1]]
    run.ok(*command)
    before = {one: one.read_bytes() for one in tmp_path.iterdir()}
    for left in ("a.csv.checkpoint.part", "a.h5.checkpoint.part", "a.h5.part-undo"):
        (tmp_path / left).write_text("killed here")
    assert "nothing to do: complete" in run(*command, "--resume").stdout
    assert {one: one.read_bytes() for one in tmp_path.iterdir()} == before


@pytest.mark.parametrize("by, status", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_stops_it_in_order(polhode, run, long, tmp_path, by, status):
    path = tmp_path / "a.csv"
    code, out, err = stopped(polhode, ["run", long, "--out", path], tmp_path / "a.csv.part", by)
    assert code == status and out == ""
    assert err.splitlines()[-1].endswith(
        f"; continue with: {polhode} run {long} --out {path} --resume")
    assert (tmp_path / "a.csv.checkpoint").exists() and not path.exists()


@pytest.mark.parametrize("method", METHODS)
def test_stopped_often_it_leaves_the_straight_run(polhode, run, scenario, tmp_path, method):
    """The scenario's rows start late, so that the first stop may be on the way to them."""
    state = DAMPED.split("[[")[0] if method.startswith("free") else DAMPED
    body = scenario(state="[state]\nepoch = \"2016-12-31 UTC\"\n" + state,
                    time="start = 40\nstop = 5000\nstep = 0.2",
                    columns='"q", "date", "omega", "tumbler"')
    text = body.read_text().replace("[output]", METHODS[method] + "[output]")
    body.write_text(text)

    def outputs(name):
        paths = ["--out", tmp_path / f"{name}.csv", "--out", tmp_path / f"{name}.h5"]
        return paths + ["--events", tmp_path / f"{name}.events.csv"] * ("[[event]]" in text)

    run.ok("run", body, *outputs("s"))
    arguments = [polhode, "run", body, *outputs("r"), "--resume"]
    codes, pause = [], 0.002
    while 0 not in codes and pause < SECONDS:
        begun = time.time_ns()
        process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        # the command of a wheel starts an interpreter first, which takes long on a busy machine
        killed_runs.wait_for_writing(process, tmp_path, begun)
        time.sleep(pause)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=SECONDS)[1]
        codes.append(process.returncode)
        assert codes[-1] in (0, 130, -signal.SIGINT), said  # the last: after the run's end
        pause *= 1.1
    assert codes[-1] == 0 and 130 in codes
    assert (tmp_path / "s.csv").read_bytes() == (tmp_path / "r.csv").read_bytes()
    assert subprocess.run(["h5diff", tmp_path / "s.h5", tmp_path / "r.h5"]).returncode == 0
    kinds = ["csv", "h5"]
    if "[[event]]" in text:
        kinds.append("events.csv")
        straight, resumed = (tmp_path / f"{name}.events.csv" for name in "sr")
        assert straight.read_bytes() == resumed.read_bytes()
        assert len(straight.read_text().splitlines()) > 1000
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(
        ["body.toml", *(f"{name}.{kind}" for name in "sr" for kind in kinds)])


def test_an_unfinished_run_is_not_overwritten(polhode, run, long, tmp_path):
    path, checkpoint = tmp_path / "a.csv", tmp_path / "a.csv.checkpoint"
    stopped(polhode, ["run", long, "--out", path], tmp_path / "a.csv.part")
    before = (tmp_path / "a.csv.part").read_bytes()
    done = run("run", long, "--out", path)
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert done.stderr.startswith(f"{checkpoint}: an unfinished run is there (body.toml at t = ")
    assert "--resume continues it, --restart" in done.stderr
    assert (tmp_path / "a.csv.part").read_bytes() == before
    # with --restart it begins anew
    (tmp_path / "a.csv.part").unlink()
    code, _, err = stopped(polhode, ["run", long, "--out", path, "--restart"],
                           tmp_path / "a.csv.part")
    assert code == 130 and "continues at" not in err


def test_no_output_of_an_unfinished_run_is_overwritten(polhode, run, long, scenario, tmp_path):
    """Whichever of them another run names, in whatever folder: the run goes on afterwards."""
    short = scenario(name="short.toml")
    with long.open("a") as file:
        file.write('[[event]]\ncolumn = "qw"\nvalue = 0.3\n')
    folders = [tmp_path / name for name in "ab"]
    for folder in folders:
        folder.mkdir()
    first, second, events = folders[0] / "p.csv", folders[1] / "p.h5", tmp_path / "e.csv"
    arguments = ["run", long, "--out", first, "--out", second, "--events", events]
    assert stopped(polhode, arguments, folders[1] / "p.h5.part")[0] == 130
    checkpoint = folders[0] / "p.csv.checkpoint"
    before = (folders[1] / "p.h5.part").read_bytes()
    for other in (second, events):
        done = run("run", short, "--out", other, cwd=tmp_path)
        assert done.returncode == 2 and done.stderr.count("\n") == 1
        place, rest = done.stderr.split(": an unfinished run is there ")
        assert checkpoint.samefile(place)
        assert "rows, in p.csv, p.h5, e.csv); --resume continues it, --restart begins anew" in rest
    assert "outputs was" in run.rejected("run", long, "--out", "b/p.h5", "--resume", cwd=tmp_path)
    assert (folders[1] / "p.h5.part").read_bytes() == before
    code, _, err = stopped(polhode, [*arguments, "--resume"], folders[1] / "p.h5.part")
    assert code == 130 and "continues at t = " in err
    # on purpose; then the rows of the run are gone, and it says what it lacks and what to do
    run.ok("run", short, "--out", second, "--restart")
    done = run(*arguments, "--resume")
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert done.stderr.startswith(f"{second}.part: cannot be continued: it is gone; expected the ")
    assert "put it back, or --restart runs the scenario anew" in done.stderr


def test_an_output_whose_checkpoint_is_gone(polhode, run, long, scenario, tmp_path):
    """Moved with its folder it is found; otherwise the message says which file is missing."""
    here, there = tmp_path / "here", tmp_path / "there"
    here.mkdir()
    stopped(polhode, ["run", long, "--out", here / "p.csv", "--out", here / "p.h5"],
            here / "p.h5.part")
    here.rename(there)
    short = scenario(name="short.toml")
    done = run("run", short, "--out", there / "p.h5")
    assert done.returncode == 2
    assert done.stderr.startswith(
        f"{there}/p.csv.checkpoint: an unfinished run is there (body.toml at t = ")
    (there / "p.csv.checkpoint").rename(tmp_path / "away")
    for option in ([], ["--resume"]):
        done = run("run", short, "--out", there / "p.h5", *option)
        assert done.returncode == 2 and done.stderr == (
            f"{there}/p.h5.checkpoint: an unfinished run or map is there; expected its checkpoint "
            f"{there}/p.csv.checkpoint, which is gone: put it back, or --restart begins anew\n")
    run.ok("run", short, "--out", there / "p.h5", "--restart")
    assert not (there / "p.h5.checkpoint").exists()


@pytest.mark.parametrize("change, named", [
    (lambda text: text.replace("0.2, 1]", "0.2, 1.1]"), "scenario was"),
    (lambda text: text.replace('columns = ["q", "omega", "g"]', 'columns = ["q"]'), "columns was"),
])
def test_another_run_is_refused_by_name(polhode, run, long, tmp_path, change, named):
    path = tmp_path / "a.csv"
    stopped(polhode, ["run", long, "--out", path], tmp_path / "a.csv.part")
    part = (tmp_path / "a.csv.part").read_bytes()
    assert "outputs was" in run.rejected("run", long, "--out", path, "--out", tmp_path / "b.csv",
                                         "--resume")
    changed = change(long.read_text())
    assert changed != long.read_text()
    long.write_text(changed)
    done = run("run", long, "--out", path, "--resume")
    assert done.returncode == 2 and named in done.stderr and done.stderr.count("\n") == 1
    assert (tmp_path / "a.csv.part").read_bytes() == part


def test_damaged_checkpoints_and_parts_are_refused(polhode, run, long, tmp_path):
    path, checkpoint = tmp_path / "a.csv", tmp_path / "a.csv.checkpoint"
    stopped(polhode, ["run", long, "--out", path], tmp_path / "a.csv.part")
    whole = checkpoint.read_bytes()
    for damaged in (b"", whole[:-1], whole[:200], whole[:-9] + b"x" + whole[-8:]):
        checkpoint.write_bytes(damaged)
        assert "is not a checkpoint" in run.rejected("run", long, "--out", path, "--resume")
    checkpoint.write_bytes(whole)
    part = (tmp_path / "a.csv.part").read_bytes()
    for damaged in (part[:100], b"X" + part[1:]):
        (tmp_path / "a.csv.part").write_bytes(damaged)
        assert "a.csv.part: cannot be continued" in run.rejected("run", long, "--out", path,
                                                                 "--resume")


def test_complete_runs_have_nothing_to_do(run, scenario, tmp_path):
    path = tmp_path / "a.csv"
    body = scenario()
    first = run("run", body, "--out", path, "--resume")
    assert first.returncode == 0 and "no checkpoint to continue from" in first.stderr
    before = path.stat().st_mtime_ns
    again = run("run", body, "--out", path, "--resume")
    assert (again.returncode, again.stdout, again.stderr) == (
        0, f"body.toml: nothing to do: complete in {path}\n", "")
    assert path.stat().st_mtime_ns == before
    body.write_text(body.read_text().replace("0.2, 1]", "0.2, 1.1]"))
    assert "of another scenario" in run.rejected("run", body, "--out", path, "--resume")
    run.ok("run", body, "--out", path, "--restart")


def test_complete_rows_are_no_complete_events(run, scenario, tmp_path):
    rows, events = tmp_path / "a.csv", tmp_path / "e.csv"
    body = scenario()
    body.write_text(body.read_text().replace("[output]", '[[event]]\ncolumn = "qw"\n[output]'))
    command = ["run", body, "--out", rows, "--events", events]
    run.ok(*command)
    assert "nothing to do" in run(*command, "--resume").stdout
    events.write_bytes(rows.read_bytes())
    other = run(*command, "--resume")
    assert other.returncode == 2 and other.stderr.startswith(
        f"{events}: is there, of another run or map of this scenario; ")


def with_epoch(path):
    """The scenario with dates, as an AEM needs them."""
    path.write_text(path.read_text().replace(
        "[state.", "[state]\nepoch = \"2026-03-20 UTC\"\n[state.", 1))
    return path


@pytest.mark.parametrize("extension", ["csv", "h5", "aem"])
def test_a_complete_file_of_another_scenario_is_not_ours(run, scenario, tmp_path, extension):
    path = tmp_path / f"a.{extension}"
    title = "| A title with \xe4 like a line of a scenario, and longer than one: " + 30 * "word "
    body = with_epoch(scenario())
    body.write_text(body.read_text().replace('"A body"', f'"{title}"'), encoding="utf-8")
    run.ok("run", body, "--out", path)
    again = run("run", body, "--out", path, "--resume")
    assert again.returncode == 0 and "nothing to do" in again.stdout
    before = path.read_bytes()
    body.write_text(body.read_text().replace("0.2, 1]", "0.2, 1.1]"))
    assert "is there, of another scenario" in run.rejected("run", body, "--out", path, "--resume")
    path.write_text("old")
    assert "does not say of which scenario" in run.rejected("run", body, "--out", path, "--resume")
    path.write_bytes(before)
    run.ok("run", body, "--out", path, "--restart")


# Rows far from the sixteen times at which the torque is looked at.
BURN = """[[perturbation]]
kind = "torque-table"
file = "burn.csv"
between = "step"
outside = "zero"
"""


def burn(folder, size):
    (folder / "burn.csv").write_text(
        f"t,x,y,z\n0,0,0,0\n1.1,{size},0,0\n1.2,0,0,0\n5,0,0,0\n")


def test_a_table_that_changed_is_another_run(polhode, run, long, tmp_path):
    path = tmp_path / "a.csv"
    long.write_text(long.read_text().replace("[[perturbation]]", BURN + "[[perturbation]]"))
    burn(tmp_path, 1e-3)
    stopped(polhode, ["run", long, "--out", path], tmp_path / "a.csv.part")
    assert "# file burn.csv: " in (tmp_path / "a.csv.part").read_text(encoding="utf-8")
    part = (tmp_path / "a.csv.part").read_bytes()
    burn(tmp_path, 2e-3)
    done = run("run", long, "--out", path, "--resume")
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert 'files of the scenario was "burn.csv: ' in done.stderr
    assert (tmp_path / "a.csv.part").read_bytes() == part
    burn(tmp_path, 1e-3)
    with subprocess.Popen([polhode, "run", long, "--out", path, "--resume"],
                          stderr=subprocess.PIPE, text=True) as process:
        assert "continues at" in process.stderr.readline()
        process.kill()


@pytest.mark.parametrize("extension", ["csv", "h5", "aem"])
def test_a_complete_file_with_another_table_is_not_ours(run, scenario, tmp_path, extension):
    path = tmp_path / f"a.{extension}"
    body = with_epoch(scenario(state="[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\n"
                                     "omega_body = [0.1, 0.2, 1]\n" + BURN))
    burn(tmp_path, 1e-3)
    run.ok("run", body, "--out", path)
    assert "nothing to do" in run("run", body, "--out", path, "--resume").stdout
    burn(tmp_path, 2e-3)
    assert "with other files" in run.rejected("run", body, "--out", path, "--resume")


def test_what_cannot_be_continued(run, scenario):
    assert "resume needs outputs that are files" in run.rejected("run", scenario(), "--resume")
    both = run("run", scenario(), "--resume", "--restart")
    assert both.returncode == 2


def test_one_run_at_a_time(polhode, run, long, tmp_path):
    path = tmp_path / "a.csv"
    checkpoint = tmp_path / "a.csv.checkpoint"
    process = subprocess.Popen([polhode, "run", long, "--out", path, "--checkpoint", "0.1"],
                               stderr=subprocess.DEVNULL)
    try:
        deadline = time.monotonic() + SECONDS
        while not checkpoint.exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGSTOP)
        done = run("run", long, "--out", path, "--restart")
        assert checkpoint.exists()  # that of the run that is going on
        resumed = run("run", long, "--out", path, "--resume")
    finally:
        process.kill()
        process.wait()
    for refused in (done, resumed):
        assert refused.returncode == 2
        assert refused.stderr.endswith("a.csv.part: another process is writing it\n")


# A limit on the size of files stands for a full disk.
@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_a_disk_that_fills_up_loses_nothing(polhode, run, scenario, tmp_path, extension):
    body = scenario(time="stop = 3000\nstep = 0.1", state=DAMPED)
    straight, path = tmp_path / f"s.{extension}", tmp_path / f"r.{extension}"
    run.ok("run", body, "--out", straight)
    kilobytes = straight.stat().st_size // 1024
    starts = 0
    remedy = "raise the limit on the size of files (ulimit -f), then --resume goes on from t = "
    for share in (0.3, 0.6, 0.9):
        limit = f"ulimit -f {int(share * kilobytes)}; exec \"$@\""
        done = subprocess.run(
            ["bash", "-c", limit, "bash", polhode, "run", body, "--out", path, "--resume",
             "--checkpoint", "0"], text=True, capture_output=True, timeout=SECONDS)
        assert done.returncode == 1
        assert done.stderr.splitlines()[-1].startswith(
            f"{path}.part: cannot be written: File too large; {remedy}")
        starts += "continues at" in done.stderr
    assert starts == 2
    run.ok("run", body, "--out", path, "--resume")
    if extension == "csv":
        assert straight.read_bytes() == path.read_bytes()
    else:
        assert subprocess.run(["h5diff", straight, path]).returncode == 0


def test_a_checkpoint_that_cannot_be_made_leaves_the_one_before(polhode, run, long, tmp_path):
    path, checkpoint = tmp_path / "a.csv", tmp_path / "a.csv.checkpoint"
    stopped(polhode, ["run", long, "--out", path], tmp_path / "a.csv.part")
    before = checkpoint.read_bytes()
    (tmp_path / "a.csv.checkpoint.part").mkdir()
    done = run("run", long, "--out", path, "--resume", "--checkpoint", "0")
    assert done.returncode == 1 and "continues at" in done.stderr
    assert done.stderr.splitlines()[-1] == f"{checkpoint}.part: cannot be written: Is a directory"
    assert checkpoint.read_bytes() == before
    (tmp_path / "a.csv.checkpoint.part").rmdir()
    with subprocess.Popen([polhode, "run", long, "--out", path, "--resume"],
                          stderr=subprocess.PIPE, text=True) as process:
        assert "continues at" in process.stderr.readline()
        process.kill()


def test_events_do_not_fill_the_memory(polhode, scenario, tmp_path):
    """Twenty times the events, the same memory."""
    peaks, stops = [], (2000, 40000)
    events = "".join(f'[[event]]\nname = "e{i}"\ncolumn = "qw"\nvalue = 0.{i}\n' for i in range(8))
    for stop in stops:
        body = scenario(time=f"stop = {stop}\ncount = 2", state=DAMPED, name=f"{stop}.toml")
        with body.open("a") as file:
            file.write(events)
        process = subprocess.Popen([polhode, "run", body, "--out", tmp_path / f"{stop}.csv",
                                    "--events", tmp_path / f"{stop}.events.csv"],
                                   stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        assert process.returncode == 0
        peaks.append(usage.ru_maxrss)
    lines = [(tmp_path / f"{stop}.events.csv").read_text().count("\n") for stop in stops]
    assert lines[1] > 10 * lines[0] > 10000
    assert peaks[1] < budgets.run_memory * peaks[0], peaks
