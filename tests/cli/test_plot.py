# SPDX-License-Identifier: MIT
"""`polhode plot`: a picture of what each command wrote, by the Python package."""

import os
import re
import subprocess
import sys

import pytest

VARY = """
[[ensemble.vary]]
kind = "uniform"
key = "body.moments[0]"
low = 0.60
high = 0.63
"""


@pytest.fixture
def free(root, tmp_path):
    """A free tumbler, Apophis for ten hours."""
    text = (root / "examples/apophis.toml").read_text()
    path = tmp_path / "body.toml"
    path.write_text(re.sub(r"(?m)^stop = .*", "stop = 10", text))
    return path


@pytest.fixture
def draw(polhode, build, tmp_path):
    """draw("plot", ...) with the package of this build, or without any."""

    def run(*arguments, package=True, python=sys.executable):
        environment = {**os.environ, "POLHODE_PYTHON": python}
        environment["PYTHONPATH"] = str(build / "python") if package else str(tmp_path)
        return subprocess.run([polhode, *map(str, arguments)], cwd=tmp_path, text=True,
                              capture_output=True, env=environment)

    return run


def test_a_run_ends_with_how_to_draw_it(draw, tmp_path, free):
    done = draw("run", "body.toml", "--out", "-", "--out", "body.csv")
    assert "to draw it" not in done.stdout  # which has the rows
    done = draw("run", "body.toml", "--out", "body.csv")
    assert done.stdout.splitlines()[-1].split(maxsplit=3)[-1] == "polhode plot body.csv"
    drawn = draw("plot", "body.csv")
    assert drawn.stdout == "body.png: written\n", drawn.stderr
    assert (tmp_path / "body.png").read_bytes().startswith(b"\x89PNG")
    again = draw("plot", "body.csv")
    assert again.returncode == 2
    assert again.stderr == "plot: body.png exists; name it with --out to replace it\n"
    assert draw("plot", "body.csv", "--column", "w1", "--out", "body.pdf").returncode == 0
    assert (tmp_path / "body.pdf").read_bytes().startswith(b"%PDF")
    wrong = draw("plot", "body.csv", "--column", "w4", "--out", "b.png")
    assert wrong.returncode == 2
    assert wrong.stderr.startswith('plot: no column "w4"; there are: ')
    missing = draw("plot", "nothing.csv")
    assert missing.returncode == 2
    assert missing.stderr == "plot: nothing.csv: No such file or directory\n"


@pytest.mark.parametrize("keep", ["statistics", "final", "rows"])
def test_an_ensemble_is_drawn(draw, free, keep):
    free.write_text(free.read_text() + f'\n[ensemble]\nsize = 8\nkeep = "{keep}"\n' + VARY)
    done = draw("ensemble", "body.toml", "--out", "e.csv")
    assert "to draw it" in done.stdout, done.stderr
    assert draw("plot", "e.csv").stdout == "e.png: written\n"


def test_what_is_missing_is_said(draw, tmp_path):
    (tmp_path / "matplotlib.py").write_text("raise ModuleNotFoundError('no', name='matplotlib')")
    (tmp_path / "a.csv").write_text("t,x\n0,1\n")
    for python in (sys.executable, "no-such-python"):
        done = draw("plot", "a.csv", package=False, python=python)
        assert done.returncode == 2 and done.stderr.startswith("plot: ")
        assert "pip install 'polhode[figures]'" in done.stderr
