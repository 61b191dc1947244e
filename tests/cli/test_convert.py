# SPDX-License-Identifier: MIT
"""`polhode convert` as a stream."""

import gzip
import math
import os
import random
import subprocess
import threading
import time

import budgets
import pytest
from closeness import largest

CHARTS = ["rotor", "attitude-rate", "attitude-rate-inertial", "matrix", "euler", "euler-rates",
          "andoyer", "poincare-0-0", "poincare-0-pi", "poincare-pi-0", "poincare-pi-pi",
          "serret", "sadov"]
MOMENTS = ["--moments", "2,1,2.5"]


def rotor_table(rows, seed=3):
    draw = random.Random(seed)
    lines = ["t,qw,qx,qy,qz,g1,g2,g3,name"]
    for k in range(rows):
        q = [draw.gauss(0, 1) for _ in range(4)]
        length = math.sqrt(sum(x * x for x in q))
        numbers = [k / 4, *(x / length for x in q), *(draw.gauss(0, 1) for _ in range(3))]
        lines.append(",".join(map(repr, numbers)) + f",row {k}")
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("chart", CHARTS)
def test_there_and_back(run, table, chart):
    text = rotor_table(200)
    there = run.ok("convert", "--from", "rotor", "--to", chart, *MOMENTS, stdin=text)
    back = run.ok("convert", "--from", chart, "--to", "rotor", *MOMENTS, stdin=there.stdout)
    first, last = text.splitlines(), back.stdout.splitlines()
    assert first[0] == last[0] and len(first) == len(last)
    for a, b in zip(first[1:], last[1:], strict=True):
        *a, name_a = a.split(",")
        *b, name_b = b.split(",")
        a, b = [float(x) for x in a], [float(x) for x in b]
        assert name_a == name_b and a[0] == b[0]
        sign = 1 if sum(x * y for x, y in zip(a[1:5], b[1:5], strict=True)) > 0 else -1
        # charts that hold the state by angles lose digits near their singularities: no row is there
        back = [sign * y for y in b[1:5]] + b[5:]
        assert largest(abs(x - y) for x, y in zip(a[1:], back, strict=True)) < budgets.cli_carried


def test_a_bad_row_stops_it_with_its_line_number(run):
    text = rotor_table(5000)
    good = run("convert", "--from", "rotor", "--to", "andoyer", stdin=text)
    lines = text.splitlines()
    lines[4000] = lines[4000].replace(",", ",x", 1)
    bad = run("convert", "--from", "rotor", "--to", "andoyer", stdin="\n".join(lines) + "\n")
    assert bad.returncode == 2
    assert bad.stderr.startswith("<stdin>:4001: qw: got \"x") and bad.stderr.count("\n") == 1
    assert bad.stdout == "".join(line + "\n" for line in good.stdout.splitlines()[:4000])


def test_rows_appear_while_more_are_awaited(polhode):
    """A stream, not a batch: rows come out before the input ends."""
    process = subprocess.Popen([polhode, "convert", "--from", "rotor", "--to", "euler"],
                               stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    writer = threading.Thread(target=lambda: (process.stdin.write(rotor_table(20000)),
                                              process.stdin.flush()))
    writer.start()
    assert process.stdout.readline() == "t,phi,theta,psi,Phi,Theta,Psi,name\n"
    closer = threading.Thread(target=lambda: (writer.join(), process.stdin.close()))
    closer.start()
    assert len(process.stdout.readlines()) == 20000
    closer.join()
    assert process.wait() == 0


def test_memory_does_not_grow_with_rows(polhode, tmp_path):
    head, rows = rotor_table(20000).split("\n", 1)
    path = tmp_path / "rows.csv"
    peak = []
    for repeat in (1, 40):  # 3 MB, 120 MB
        with path.open("w", encoding="utf-8") as file:
            file.write(head + "\n")
            for _ in range(repeat):
                file.write(rows)
        with (tmp_path / "out.csv").open("wb") as out:
            process = subprocess.Popen(
                [polhode, "convert", "--from", "rotor", "--to", "andoyer", path], stdout=out)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = status
        assert status == 0
        peak.append(usage.ru_maxrss)
    assert peak[1] < 1.1 * peak[0]


def test_a_million_rows(run, polhode, tmp_path):
    """A smoke test of throughput: docs/accuracy has the rate, nothing is asserted on it."""
    text = rotor_table(20000)
    head, rows = text.split("\n", 1)
    path = tmp_path / "rows.csv"
    with path.open("w", encoding="utf-8") as file:
        file.write(head + "\n")
        for _ in range(50):
            file.write(rows)
    start = time.process_time()
    with (tmp_path / "out.csv").open("wb") as out:
        subprocess.run([polhode, "convert", "--from", "rotor", "--to", "andoyer", path], stdout=out,
                       check=True)
    print(f"convert: {time.process_time() - start:.2f} s")
    with (tmp_path / "out.csv").open("rb") as out:
        assert sum(1 for _ in out) == 1_000_001


def test_help_lists_every_chart(run):
    text = run("convert", "--help").stdout
    assert all(f"  {chart}: " in text for chart in CHARTS)


def test_compressed_tables_read_the_same(polhode, run, tmp_path):
    text = rotor_table(20)
    packed = tmp_path / "rows.csv.gz"
    packed.write_bytes(gzip.compress(text.encode()))
    plain = run("convert", "--from", "rotor", "--to", "andoyer", stdin=text)
    read = run("convert", "--from", "rotor", "--to", "andoyer", packed)
    assert read.returncode == 0 and read.stdout == plain.stdout, read.stderr
    piped = subprocess.run([polhode, "convert", "--from", "rotor", "--to", "andoyer"],
                           input=packed.read_bytes(), capture_output=True, check=False)
    assert piped.returncode == 2 and piped.stdout == b""
    assert piped.stderr == b"<stdin>: is packed by gzip; expected text, or a .gz file as FILE\n"
    packed.write_bytes(packed.read_bytes()[:-12])
    broken = run("convert", "--from", "rotor", "--to", "andoyer", packed)
    assert broken.returncode == 2
    assert broken.stderr == f"{packed}: cannot be unpacked: it ends before its end\n"


def test_a_run_tells_convert_its_branch(polhode, run, tmp_path):
    """Serret's sign_g3 and Sadov's lobe stand in a comment of the run; convert heeds it."""
    for chart, omega in (("serret", "[0.5, 0.25, -1]"), ("sadov", "[-1.5, 0.25, 0.1]")):
        scenario = tmp_path / f"{chart}.toml"
        scenario.write_text(
            "schema = 1\n[body]\nmoments = [3, 4, 6]\n[state.attitude-rate]\n"
            f"quaternion = [0.8, 0, 0.6, 0]\nomega_body = {omega}\n"
            f'[time]\nat = [0]\n[output]\ncolumns = ["{chart}"]\n')
        table = run("run", str(scenario), "-o", "-").stdout
        back = run("convert", "--from", chart, "--to", "attitude-rate", "--moments", "3,4,6",
                   stdin=table).stdout.splitlines()[-1].split(",")
        rates = [float(x) for x in back[-3:]]
        wanted = [float(x) for x in omega.strip("[]").split(",")]
        assert rates == pytest.approx(wanted, abs=budgets.cli_carried)


@pytest.mark.parametrize("chart", ["poincare-0-0", "poincare-0-pi", "poincare-pi-0",
                                   "poincare-pi-pi"])
def test_a_run_in_a_chart_is_the_run_of_the_hub(run, scenario, table, chart):
    """Columns of a Poincare-type set have names of their own, sigma_0_pi; convert knows them."""
    path = scenario(columns=f'"{chart}", "q", "g"')
    names, rows = table(run("run", path).stdout)
    assert len(rows) == 21
    numbers = "\n".join(",".join(map(repr, row[:7])) for row in rows)
    back = run.ok("convert", "--from", chart, "--to", "rotor",
                  stdin=",".join(names[:7]) + "\n" + numbers + "\n")
    for row, state in zip(rows, table(back.stdout)[1], strict=True):
        hub = [row[names.index(name)] for name in "qw qx qy qz g1 g2 g3".split()]
        sign = 1 if sum(x * y for x, y in zip(hub[:4], state[1:5], strict=True)) > 0 else -1
        turned = [sign * x for x in state[1:5]] + state[5:]
        assert largest(abs(x - y) for x, y in zip(hub, turned, strict=True)) < budgets.cli_carried


def test_two_poincare_sets_stand_next_to_each_other(run, scenario, table):
    names, rows = table(run("run", scenario(columns='"poincare-0-0", "poincare-pi-0"')).stdout)
    assert names == ["t", "sigma_0_0", "Q1_0_0", "Q2_0_0", "G", "P1_0_0", "P2_0_0",
                     "sigma_pi_0", "Q1_pi_0", "Q2_pi_0", "P1_pi_0", "P2_pi_0"]
    assert all(len(row) == len(names) for row in rows)


def test_degrees_of_a_run_are_refused(polhode, run, tmp_path):
    table = "# units: t [h], phi [deg], theta [deg]\nt,phi,theta,psi,Phi,Theta,Psi\n0,1,1,1,1,1,1\n"
    assert "phi is in deg; expected radians" in run.rejected("convert", "--from", "euler", "--to",
                                                             "rotor", stdin=table)
