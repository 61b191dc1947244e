# SPDX-License-Identifier: MIT
"""Maps and ensembles on executors: the bits of threads, whoever computes a cell; workers that
die."""

import concurrent.futures
import multiprocessing
import os
import pathlib
import shutil
import subprocess
import sys

import polhode
import pytest
from interrupts import LATEST, seconds_from_signal
from open_mpi import ENVIRONMENT
from polhode import Scenario, vary
from scenario_texts import FREE
from slowdown import SLOWDOWN

TEXT = FREE.replace("[1, 2, 2.5]", "[1, 1.7, 2.2]") + """
[output]
columns = ["q", "omega", "tumbler"]
"""
MOMENT = {"body.moments[1]": vary.uniform(1.1, 1.9)}  # below 1.2 there is no such body
KEEPS = ["statistics", "final", "rows"]


def scenario(keep="statistics", **keys):
    keys = {"size": 300, "chunk": 16, "keep": keep, **keys}
    return Scenario.from_text(TEXT).with_ensemble(MOMENT, **keys)


@pytest.fixture(scope="module")
def processes():
    """Two processes that know nothing of this one."""
    spawn = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=spawn) as executor:
        yield executor


@pytest.mark.parametrize("keep", KEEPS)
def test_processes_give_the_bits_of_threads(keep, processes, tmp_path):
    of = scenario(keep)
    told = []
    found = of.ensemble(
        tmp_path / "p.csv", executor=processes, progress=lambda k, size: told.append(k)
    )
    threads = of.ensemble(tmp_path / "t.csv", threads=2)
    assert found == threads and found.failures == threads.failures and found.failed > 0
    assert (tmp_path / "p.csv").read_bytes() == (tmp_path / "t.csv").read_bytes()
    assert told == sorted(told) and told[-1] == 300


def test_processes_write_a_file_for_each_chunk(processes, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # the processes stay where they were
    of = scenario("rows", size=60)
    (tmp_path / "t").mkdir()
    found = of.ensemble("p-{chunk}.csv", executor=processes, any_machine=True)
    threads = of.ensemble("t/p-{chunk}.csv", threads=2)
    assert found == threads and found.failures == threads.failures
    assert len(found.chunk_files) == 4
    for ours, theirs in zip(found.chunk_files, threads.chunk_files):
        assert pathlib.Path(ours).read_bytes() == pathlib.Path(theirs).read_bytes()


MAP = """
[map]
kind = "{kind}"
[[map.axis]]
key = "body.moments[1]"
from = 1.1
to = 1.9
count = {count}
"""  # below 1.2 there is no such body


def map_of(kind="chaos", count=17):
    return Scenario.from_text(TEXT + MAP.format(kind=kind, count=count))


@pytest.mark.parametrize("kind", ["chaos", 'andoyer-section"\nangle = "g'])
def test_processes_give_the_map_of_threads(kind, processes, tmp_path):
    of, told = map_of(kind), []
    found = of.map(
        tmp_path / "p.csv", executor=processes, progress=lambda k, size: told.append((k, size))
    )
    threads = of.map(tmp_path / "t.csv", threads=2)
    assert found == threads and found.failures == threads.failures and found.failures
    assert (found.cell == threads.cell).all()
    assert (tmp_path / "p.csv").read_bytes() == (tmp_path / "t.csv").read_bytes()
    assert told == [(k, 17) for k in range(1, 18)]


def test_a_map_on_an_executor_is_resumed_on_threads(tmp_path):
    path, told = tmp_path / "m.csv", []
    of = map_of(count=100)

    class Enough(Exception):
        pass

    def stop(cells, size):
        if cells == 7:
            raise Enough

    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        with pytest.raises(Enough):
            of.map(path, executor=executor, progress=stop)
        with pytest.raises(ValueError, match="an unfinished map is there"):
            of.map(path, executor=executor)
    assert of.map(path, resume=True, progress=lambda k, size: told.append(k)) == of.map()
    assert told[0] == 8


def test_threads_of_an_executor_do_too():
    of = scenario(quantiles=[0.5], bins=8)
    with concurrent.futures.ThreadPoolExecutor(3) as executor:
        assert of.ensemble(executor=executor) == of.ensemble()
        assert of.ensemble(executor=executor, size=40).size == 40


class OnePerCall(concurrent.futures.Executor):
    """Runs a task when it is waited for, by another thread, and remembers what was submitted."""

    def __init__(self):
        self.pool = concurrent.futures.ThreadPoolExecutor(1)
        self._max_workers = 2
        self.cells, self.open, self.opened = [], 0, []

    def submit(self, function, *arguments):
        self.cells.append(arguments[-2:])
        self.open += 1
        self.opened.append(self.open)
        future = self.pool.submit(function, *arguments)
        future.add_done_callback(self.close)
        return future

    def close(self, future):
        self.open -= 1


def test_cells_are_submitted_in_order_and_few_at_a_time():
    executor = OnePerCall()
    of = scenario("rows", size=1000)
    assert of.ensemble(executor=executor) == of.ensemble()
    ends = [end for _, end in executor.cells]
    assert [begin for begin, _ in executor.cells] == [0, *ends[:-1]]
    assert all(number <= 8 for number in executor.opened)
    assert any(end - begin > 1 for begin, end in executor.cells)  # short ones together


def test_a_worker_that_dies_leaves_what_is_done(tmp_path):
    # Few rows: an answer that fits into a pipe is there or not. In the middle of one that does not
    # a killed process leaves its reader waiting for ever, whatever the executor computes.
    of = Scenario.from_text(TEXT.replace("step = 0.5", "step = 2")).with_ensemble(
        MOMENT, size=3000, chunk=16, keep="rows")
    path = tmp_path / "e.csv"
    spawn = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=spawn) as executor:

        def kill(members, size):
            if members == 64:
                for process in executor._processes.values():
                    process.kill()

        with pytest.raises(RuntimeError, match="scenario.toml: a worker of the executor") as raised:
            of.ensemble(path, executor=executor, progress=kill)
    assert isinstance(raised.value.__cause__, concurrent.futures.process.BrokenProcessPool)
    assert not path.exists() and path.with_name("e.csv.checkpoint").exists()
    told = []
    again = of.ensemble(path, resume=True, progress=lambda k, size: told.append(k))
    assert again == of.ensemble() and told[0] > 64


def fails(*arguments):
    raise OSError("no room")


class Failing(concurrent.futures.ThreadPoolExecutor):
    def submit(self, function, *arguments):
        return super().submit(function if arguments[-2] < 3 else fails, *arguments)


def test_what_a_worker_raises_is_said(tmp_path):
    path = tmp_path / "e.h5"
    with Failing(1) as executor:
        with pytest.raises(RuntimeError, match="failed, from chunk [34] on: OSError: no room"):
            scenario("rows").ensemble(path, executor=executor)
    assert path.with_name("e.h5.checkpoint").exists()
    with concurrent.futures.ThreadPoolExecutor(1) as closed:
        pass
    with pytest.raises(RuntimeError, match="at chunk 0: RuntimeError: cannot schedule new futures"):
        scenario().ensemble(executor=closed)


def test_what_a_worker_of_a_map_raises_is_said(tmp_path):
    path = tmp_path / "m.csv"
    with Failing(1) as executor:
        with pytest.raises(RuntimeError, match="failed, from cell [34] on: OSError: no room"):
            map_of().map(path, executor=executor)
    assert path.with_name("m.csv.checkpoint").exists()


def test_what_is_no_executor_is_refused():
    with pytest.raises(TypeError, match="^map: executor: got 3; expected a concurrent.futures"):
        map_of().map(executor=3)
    with pytest.raises(TypeError, match="executor: got 3; expected a concurrent.futures.Executor"):
        scenario().ensemble(executor=3)
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        with pytest.raises(ValueError, match="got threads and an executor"):
            scenario().ensemble(threads=2, executor=executor)


def test_what_a_listener_raises_ends_it(processes):
    class Enough(Exception):
        pass

    def stop(members, size):
        raise Enough

    with pytest.raises(Enough):
        scenario().ensemble(executor=processes, progress=stop)
    assert scenario().ensemble(executor=processes) == scenario().ensemble()


def test_ctrl_c_leaves_an_ensemble_to_continue(processes, tmp_path):
    path, told = tmp_path / "e.csv", []
    of = scenario("rows", size=10**6)
    took = seconds_from_signal(
        lambda: of.ensemble(path, executor=processes, progress=lambda k, size: told.append(k)),
        lambda: bool(told),
    )
    assert took < LATEST and path.with_name("e.csv.checkpoint").exists()


def test_ctrl_c_leaves_a_map_to_continue(processes, tmp_path):
    path, told = tmp_path / "m.csv", []
    of = map_of(count=10**6)
    took = seconds_from_signal(
        lambda: of.map(path, executor=processes, progress=lambda k, size: told.append(k)),
        lambda: bool(told),
    )
    assert took < LATEST and path.with_name("m.csv.checkpoint").exists()


@pytest.mark.skipif("POLHODE_TEST_FULL" not in os.environ, reason="Dask: make test-full")
def test_dask_gives_the_bits_of_threads():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=2, dashboard_address=None
    ) as cluster, distributed.Client(cluster) as client:
        for keep in KEEPS:
            of = scenario(keep)
            assert of.ensemble(executor=client.get_executor()) == of.ensemble()
        with pytest.raises(TypeError, match=r"client.get_executor\(\) of Dask"):
            of.ensemble(executor=client)


PROGRAM = """
import sys
import polhode
if __name__ == "__main__":
  {start}
    if executor is not None:
        for keep in ("statistics", "rows"):
            of = polhode.load(sys.argv[1]).with_ensemble(keep=keep)
            of.ensemble(f"{{sys.argv[2]}}/mpi-{{keep}}.csv", executor=executor)
"""
# By its own manager: rank 0 leads; or on a communicator of the program.
STARTS = {
    "mpi4py.futures": (
        ["-m", "mpi4py.futures"],
        "from mpi4py.futures import MPIPoolExecutor\n  with MPIPoolExecutor() as executor:",
    ),
    "communicator": (
        [],
        "from mpi4py.futures import MPICommExecutor\n  with MPICommExecutor(root=0) as executor:",
    ),
}


@pytest.mark.parametrize("start", STARTS)
def test_mpi_gives_the_bits_of_threads(start, tmp_path):
    pytest.importorskip("mpi4py")
    mpirun = shutil.which("mpirun")
    if mpirun is None:
        pytest.skip("no mpirun on this machine: tools/install-deps brings Open MPI")
    module, with_executor = STARTS[start]
    program, file = tmp_path / "program.py", tmp_path / "e.toml"
    program.write_text(PROGRAM.format(start=with_executor))
    scenario().save(file)
    found = pathlib.Path(polhode.__file__).parents[1]
    command = [mpirun, "-n", "3", sys.executable, *module, program, file, tmp_path]
    done = subprocess.run(
        command, env={**ENVIRONMENT, "PYTHONPATH": str(found)}, stdin=subprocess.DEVNULL,
        capture_output=True, text=True, timeout=120 * SLOWDOWN,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    for keep in ("statistics", "rows"):
        ours = tmp_path / f"ours-{keep}.csv"
        polhode.load(file).with_ensemble(keep=keep).ensemble(ours)
        assert (tmp_path / f"mpi-{keep}.csv").read_bytes() == ours.read_bytes()
