# SPDX-License-Identifier: MIT
"""`mpirun polhode ensemble` and `mpirun polhode map`: the same bytes for any number of ranks and
threads, after kills too, and clear words where ranks cannot work."""

import os
import pathlib
import shutil
import signal
import subprocess

import pytest
from ensemble_files import (
    COLLOCATION,
    TORQUE,
    bytes_of,
    mark,
    rows_of,
    wait_for_another,
)
from open_mpi import ENVIRONMENT
from slowdown import SLOWDOWN

SECONDS = 120 * SLOWDOWN


@pytest.fixture(scope="module", autouse=True)
def needs_mpi(polhode):
    if shutil.which("mpirun") is None:
        pytest.skip("no mpirun")
    told = subprocess.run([polhode, "info", "--cpu"], capture_output=True, text=True, check=True)
    if "by MPI" not in told.stdout:
        pytest.skip("built without POLHODE_MPI")


def summary(done):
    """What a command printed, but for how to draw its file."""
    return done.stdout.partition("to draw it")[0]


@pytest.fixture
def command(polhode):
    """command(ranks, "ensemble", ...): the words of a shell."""
    return lambda ranks, *words: ["mpirun", "-n", str(ranks), str(polhode), *map(str, words)]


@pytest.fixture
def ranks(command):
    """ranks(4, "ensemble", path, ...) -> CompletedProcess, whatever its exit code."""

    def call(count, *words):
        return subprocess.run(command(count, *words), capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=SECONDS, env=ENVIRONMENT)

    return call


@pytest.mark.parametrize("keep", ["statistics", "final", "rows"])
def test_any_number_of_ranks_gives_the_same_files(run, ranks, ensemble, tmp_path, keep):
    path = ensemble(f'size = 100\nchunk = 7\nkeep = "{keep}"',
                    extra=COLLOCATION if keep == "statistics" else TORQUE,
                    columns='"q", "omega", "andoyer", "tumbler"')
    outs = [tmp_path / "alone.csv", tmp_path / "alone.h5"]
    run.ok("ensemble", path, "--out", outs[0], "--out", outs[1])
    marks = {tuple(mark(out) for out in outs)}
    for count, threads in ((1, 2), (2, 1), (2, 2), (4, 1)):
        outs = [tmp_path / f"{count}-{threads}.csv", tmp_path / f"{count}-{threads}.h5"]
        done = ranks(count, "ensemble", path, "--out", outs[0], "--out", outs[1],
                     "--threads", threads)
        assert done.returncode == 0, done.stderr
        assert done.stdout.count("members           100\n") == 1
        marks.add(tuple(mark(out) for out in outs))
    assert len(marks) == 1


def test_stages_that_follow_each_other_at_once_are_told_apart(run, ranks, ensemble, tmp_path):
    """The first members and the rest are two stages, of cells that take no time here."""
    path, alone = ensemble("size = 64\nchunk = 4", time="stop = 1\nstep = 1"), tmp_path / "a.csv"
    run.ok("ensemble", path, "--out", alone)
    for _ in range(6):
        done = ranks(4, "ensemble", path, "--out", tmp_path / "b.csv", "--restart")
        assert done.returncode == 0, done.stderr
        assert mark(tmp_path / "b.csv") == mark(alone)


def children(process):
    """The processes that another one has started."""
    found = subprocess.run(["ps", "--no-headers", "-o", "pid", "--ppid", str(process.pid)],
                           capture_output=True, text=True, check=False)
    return [int(word) for word in found.stdout.split()]


def test_killed_ranks_and_another_number_of_them_lose_nothing(run, ranks, command, ensemble,
                                                              tmp_path):
    """First one rank is killed, then mpirun with all of them, then the leader; each time the job
    ends, and the next one goes on from its checkpoint."""
    path = ensemble("size = 1600\nchunk = 20", extra=TORQUE, time="stop = 400\nstep = 4")
    whole, out = tmp_path / "whole.csv", tmp_path / "part.csv"
    run.ok("ensemble", path, "--out", whole)
    checkpoint = pathlib.Path(f"{out}.checkpoint")
    words = ["ensemble", path, "--out", out, "--resume", "--checkpoint", "0"]
    kept = []
    for count, victim in ((2, 1), (3, None), (4, 0)):
        before = bytes_of(checkpoint)
        process = subprocess.Popen(command(count, *words), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, env=ENVIRONMENT)
        wait_for_another(checkpoint, before, process)
        started = children(process)
        assert len(started) == count
        for one in started if victim is None else [started[victim]]:
            os.kill(one, signal.SIGKILL)
        assert process.wait(timeout=SECONDS) != 0
        kept.append(int(checkpoint.read_bytes().split(b" ")[0]))
        assert not out.exists()
    assert kept == sorted(kept) and 0 < kept[0] and kept[-1] < 1600
    done = run.ok(*words)
    assert f"continues after {kept[-1]} of 1600 members" in done.stderr
    assert out.read_bytes() == whole.read_bytes()
    assert "nothing to do: complete" in ranks(2, *words).stdout


def test_a_signal_stops_all_ranks_and_keeps_the_members(command, ensemble, tmp_path):
    path = ensemble("size = 100000\nchunk = 10", extra=TORQUE, time="stop = 400\nstep = 4")
    out = tmp_path / "out.csv"
    # mpirun of Open MPI 5 does not pass on what ranks say after a signal: it is kept by rank
    mpirun, program = (words := command(2, "ensemble", path, "--out", out))[:3], words[3:]
    process = subprocess.Popen(
        [*mpirun, "sh", "-c", f'exec "$@" 2>"{tmp_path}/errors.$OMPI_COMM_WORLD_RANK"', "sh",
         *program, "--checkpoint", "0"], stdout=subprocess.DEVNULL, env=ENVIRONMENT)
    checkpoint = pathlib.Path(f"{out}.checkpoint")
    wait_for_another(checkpoint, b"", process)
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=SECONDS)
    assert process.returncode != 0
    error = "".join(file.read_text() for file in tmp_path.glob("errors.*"))
    assert error.count("of 100000 members; continue with: ") == 1
    assert checkpoint.exists() and not out.exists()


def test_what_several_ranks_cannot_do(ranks, ensemble, tmp_path):
    path = ensemble("size = 40\nchunk = 20")
    done = ranks(3, "ensemble", path, "--out", tmp_path / "a.csv")
    assert done.returncode == 2
    assert ("body.toml: ensemble: 3 processes for 2 chunks of members; expected a chunk for each "
            "at least: fewer processes, or a smaller ensemble.chunk" in done.stderr)
    done = ranks(2, "ensemble", "-", "--out", tmp_path / "a.csv")
    assert done.returncode == 2 and "expected a file that all can read" in done.stderr
    done = ranks(2, "ensemble", tmp_path / "none.toml")
    assert done.returncode == 2 and done.stderr.count("none.toml") == 1
    assert not (tmp_path / "a.csv").exists()


def test_a_rank_with_another_file_says_so(polhode, ensemble, tmp_path):
    """As where a file is on the disk of each machine: each rank in a directory of its own. (mpirun
    of Open MPI 5.0.7 crashes when it is given two programs.)"""
    path = ensemble("size = 40\nchunk = 5")
    other = tmp_path / "other"
    other.mkdir()
    words = [str(polhode), "ensemble", "body.toml", "--restart", "--out", str(tmp_path / "a.csv")]
    for text, message in ((path.read_text().replace("sigma = 0.05", "sigma = 0.06"),
                           "rank 1: body.toml: is not the ensemble that is run: scenario was "),
                          (None, "rank 1: body.toml: ")):
        if text is None:
            (other / "body.toml").unlink()
        else:
            (other / "body.toml").write_text(text)
        done = subprocess.run(
            ["mpirun", "-n", "2", "sh", "-c",
             f'test "$OMPI_COMM_WORLD_RANK" = 0 || cd "{other}"; exec "$@"', "sh", *words],
            cwd=tmp_path, capture_output=True, text=True, timeout=SECONDS, env=ENVIRONMENT)
        assert done.returncode == 1
        assert message in done.stderr


def test_a_member_that_fails_is_named_whichever_rank_it_was_on(run, ranks, ensemble, tmp_path):
    vary = ('[[ensemble.vary]]\nkind = "uniform"\nkey = "body.moments[1]"\nlow = 1.4\n'
            'high = 2.4\n')
    path = ensemble("size = 100\nchunk = 5", vary=vary)
    alone = run("ensemble", path, "--out", tmp_path / "a.csv")
    several = ranks(2, "ensemble", path, "--out", tmp_path / "b.csv")
    assert "failed            " in alone.stdout
    assert summary(several) == summary(alone)
    member = alone.stdout.split("  member ")[1].split(":")[0]
    done = ranks(2, "ensemble", path, "--member", member, "--out", tmp_path / "member.csv")
    assert done.returncode != 0 and done.stderr.count("body.moments") == 1


@pytest.mark.parametrize("keep", ["final", "rows"])
def test_each_chunk_may_have_a_file_of_its_own(run, ranks, ensemble, tmp_path, keep):
    path = ensemble(f'size = 110\nchunk = 10\nkeep = "{keep}"', extra=TORQUE)
    whole = tmp_path / "whole.csv"
    run.ok("ensemble", path, "--out", whole)
    whole, marks = rows_of(whole), set()
    for count in (1, 2, 3):
        folder = tmp_path / str(count)
        folder.mkdir()
        out = folder / "rows-{chunk}.csv"
        done = ranks(count, "ensemble", path, "--out", out)
        assert done.returncode == 0, done.stderr
        names = [f"rows-{k:02d}.csv" for k in range(11)]
        assert sorted(one.name for one in folder.iterdir()) == [*names, "rows-index.csv"]
        index, begin = rows_of(folder / "rows-index.csv"), 0
        assert (index["first_member"] == 10 * index["chunk"]).all()
        assert (index["members"] == 10).all() and (index["failed"] == 0).all()
        for name, size in zip(names, index["rows"].astype(int)):
            part = rows_of(folder / name)
            for column in whole:
                assert (part[column] == whole[column][begin:begin + size]).all()
            begin += size
        assert begin == len(whole["member"])
        marks.add(tuple(mark(folder / name) for name in [*names, "rows-index.csv"]))
        assert "nothing to do: complete" in run("ensemble", path, "--out", out, "--resume").stdout
    assert len(marks) == 1


def test_what_has_no_files_of_chunks(run, ensemble, tmp_path):
    out = tmp_path / "a-{chunk}.csv"
    done = run("ensemble", ensemble("size = 40"), "--out", out)
    assert done.returncode == 2
    assert 'for statistics, which are of all chunks; expected ensemble.keep = "rows"' in done.stderr
    path = ensemble('size = 40\nkeep = "rows"')
    assert "expected no other where each chunk has a file" in run.rejected("ensemble", path,
                                                                           "--out", out, "--out",
                                                                           tmp_path / "b.csv")


MAP = """
[map]
kind = "{kind}"
[[map.axis]]
key = "body.moments[1]"
from = 1.2
to = 2.4
count = 13
[[map.axis]]
key = "state.attitude-rate.omega_body[1]"
from = 0.1
to = 0.9
count = 11
"""


@pytest.fixture
def map_file(scenario):
    """map_file(stop) writes a scenario with a map of 143 cells, of which some have no body."""

    def write(stop, kind="chaos", extra=""):
        path = scenario(time=f"stop = {stop}\ncount = 2")
        path.write_text(path.read_text() + TORQUE + MAP.format(kind=kind) + extra)
        return path

    return write


@pytest.mark.parametrize("kind, extra", [("chaos", ""), ("andoyer-section", 'angle = "g"\n')])
def test_a_map_has_the_same_files_for_any_number_of_ranks(run, ranks, map_file, tmp_path, kind,
                                                          extra):
    path = map_file(300, kind)
    path.write_text(path.read_text().replace("[[map.axis]]", extra + "[[map.axis]]", 1))
    outs = [tmp_path / "alone.csv", tmp_path / "alone.h5"]
    alone = run.ok("map", path, "--out", outs[0], "--out", outs[1])
    assert "cells             143" in alone.stdout and "failed            " in alone.stdout
    marks = {tuple(mark(out) for out in outs)}
    for count, threads in ((2, 1), (2, 2), (3, 1)):
        outs = [tmp_path / f"{count}-{threads}.csv", tmp_path / f"{count}-{threads}.h5"]
        done = ranks(count, "map", path, "--out", outs[0], "--out", outs[1], "--threads", threads)
        assert done.returncode == 0, done.stderr
        assert summary(done) == summary(alone)
        marks.add(tuple(mark(out) for out in outs))
    assert len(marks) == 1


def test_a_map_that_was_killed_on_ranks_goes_on_on_threads(run, ranks, command, map_file,
                                                           tmp_path):
    path = map_file(20000)
    whole, out = tmp_path / "whole.csv", tmp_path / "part.csv"
    run.ok("map", path, "--out", whole)
    checkpoint = pathlib.Path(f"{out}.checkpoint")
    words = ["map", path, "--out", out, "--resume", "--checkpoint", "0"]
    kept = []
    for count, victim in ((2, 1), (3, 0)):
        before = bytes_of(checkpoint)
        process = subprocess.Popen(command(count, *words), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, env=ENVIRONMENT)
        wait_for_another(checkpoint, before, process)
        os.kill(children(process)[victim], signal.SIGKILL)
        assert process.wait(timeout=SECONDS) != 0
        kept.append(int(checkpoint.read_bytes().split(b" ")[0]))
        assert not out.exists()
    assert 0 < kept[0] < kept[1] < 143
    done = run.ok(*words)
    assert f"continues after {kept[1]} of 143 cells" in done.stderr
    assert out.read_bytes() == whole.read_bytes()
    assert "nothing to do: complete" in ranks(2, *words).stdout


def test_what_several_ranks_cannot_do_with_a_map(ranks, map_file, tmp_path):
    path = map_file(10)
    path.write_text(path.read_text().replace("count = 13", "count = 1").replace("count = 11",
                                                                               "count = 2"))
    done = ranks(3, "map", path, "--out", tmp_path / "a.csv")
    assert done.returncode == 2
    assert ("body.toml: map: 3 processes for 2 cells; expected a cell for each at least: fewer "
            "processes" in done.stderr)
    done = ranks(2, "map", "-", "--out", tmp_path / "a.csv")
    assert done.returncode == 2 and "expected a file that all can read" in done.stderr
    assert not (tmp_path / "a.csv").exists()
