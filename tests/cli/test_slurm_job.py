# SPDX-License-Identifier: MIT
"""packaging/slurm/ensemble.sbatch, without Slurm: the shell that runs it gets the signals that it
would send, and `scontrol` is a stand-in that writes down what it is told."""

import pathlib
import signal
import subprocess

import pytest
from ensemble_files import TORQUE
from slowdown import SLOWDOWN
from test_mpi import ENVIRONMENT, needs_mpi, wait_for_another  # noqa: F401

SECONDS = 120 * SLOWDOWN


@pytest.fixture
def job(root, polhode, tmp_path):
    """job(words of polhode ensemble) -> the process; told: what scontrol was told."""
    folder = tmp_path / "bin"
    folder.mkdir()
    # mpirun of Open MPI 5 does not pass on what ranks say after a signal: it is kept by rank
    (folder / "polhode").write_text(
        f'#!/bin/sh\nexec {pathlib.Path(polhode).resolve()} "$@" '
        f'2>>{tmp_path}/errors.$OMPI_COMM_WORLD_RANK\n')
    (folder / "polhode").chmod(0o755)
    (folder / "scontrol").write_text(f'#!/bin/sh\necho "$@" >> {tmp_path}/told\n')
    (folder / "scontrol").chmod(0o755)
    environment = {**ENVIRONMENT, "SLURM_JOB_ID": "17", "OMPI_MCA_odls_base_sigkill_timeout": "1",
                   "PATH": f"{folder}:{ENVIRONMENT['PATH']}"}

    def start(*words):
        return subprocess.Popen(
            ["bash", str(root / "packaging/slurm/ensemble.sbatch"), *map(str, words)],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            env=environment)

    start.errors = lambda: "".join(
        file.read_text() for file in sorted(tmp_path.glob("errors.*")))
    start.told = lambda: (tmp_path / "told").read_text() if (tmp_path / "told").exists() else ""
    return start


def test_a_job_whose_time_is_up_goes_on_and_one_that_is_cancelled_stays(job, ensemble, tmp_path):
    path = ensemble("size = 100000\nchunk = 10", extra=TORQUE, time="stop = 400\nstep = 4")
    out, kept = tmp_path / "out.csv", b""
    checkpoint = pathlib.Path(f"{out}.checkpoint")
    for sent, told in ((signal.SIGUSR1, "requeue 17\n"), (signal.SIGTERM, "requeue 17\n")):
        process = job(path, "--out", out, "--checkpoint", "0")
        wait_for_another(checkpoint, kept, process)
        process.send_signal(sent)
        said, error = process.communicate(timeout=SECONDS)
        assert process.returncode not in (0, -sent), error
        error = job.errors()
        assert "of 100000 members; continue with: " in error
        assert ("continues after " in error) == (kept != b"")
        assert job.told() == told and ("job 17 goes on later" in said) == (sent == signal.SIGUSR1)
        kept = checkpoint.read_bytes()
        for file in tmp_path.glob("errors.*"):
            file.unlink()
        assert not out.exists()


def test_a_job_that_is_complete_has_nothing_to_do(job, ensemble, tmp_path):
    path, out = ensemble("size = 100\nchunk = 5"), tmp_path / "out.csv"
    for last in ("members           100\n", "nothing to do: complete"):
        process = job(path, "--out", out)
        said, error = process.communicate(timeout=SECONDS)
        assert process.returncode == 0 and last in said, error
    assert out.exists() and not job.told()


def test_a_job_of_nothing_says_how_it_is_used(job):
    process = job()
    _, error = process.communicate(timeout=SECONDS)
    assert process.returncode == 2 and "usage: sbatch ensemble.sbatch FILE.toml" in error
