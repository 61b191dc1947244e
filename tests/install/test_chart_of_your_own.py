# SPDX-License-Identifier: MIT
"""The worked example of docs/extending/chart.md, built from a directory that holds nothing but its
files, against an installed polhode."""

import re
import shutil
import subprocess

import budgets
import pytest


def sh(*arguments, cwd=None):
    done = subprocess.run(list(map(str, arguments)), cwd=cwd, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, f"{arguments}\n{done.stdout}"
    return done.stdout


@pytest.fixture(scope="module")
def program(build, root, tmp_path_factory):
    path = tmp_path_factory.mktemp("chart")
    sh("cmake", "--install", build, "--prefix", path / "prefix")
    shutil.copytree(root / "examples/extending/chart", path / "chart")
    sh("cmake", "-S", path / "chart", "-B", path / "build", "-G", "Ninja",
       f"-DCMAKE_PREFIX_PATH={path / 'prefix'}")
    sh("cmake", "--build", path / "build")
    return path / "build/spherical"


def test_it_is_converted_and_its_bad_row_is_found(program, root):
    def converted(text, *charts):
        return subprocess.run([program, *charts], input=text, text=True, capture_output=True)

    given = (root / "examples/extending/chart/states.csv").read_text()
    there = converted(given, "spherical", "serret")
    assert there.returncode == 2
    assert there.stderr.startswith("stdin:3: andoyer_state: H = ")
    back = converted(there.stdout, "serret", "spherical")
    assert back.returncode == 0, back.stderr
    first, last = given.splitlines(), back.stdout.splitlines()
    assert last[0] == first[0] and len(last) == 2
    assert [float(x) for x in last[1].split(",")] == pytest.approx(
        [float(x) for x in first[1].split(",")], abs=budgets.cli_carried)


def test_its_columns_are_those_of_the_page(program, root):
    page = (root / "docs/extending/chart.md").read_text()
    assert f"```\n{sh(program)}```" in page


def test_the_page_shows_the_files(root):
    page = (root / "docs/extending/chart.md").read_text()
    blocks = re.findall(r"<!-- file: (.*?) -->\n(?:<!-- .*? -->\n)?```\w*\n(.*?)```", page,
                        re.DOTALL)
    folder = root / "examples/extending/chart"
    assert {name for name, _ in blocks} == {path.name for path in folder.iterdir()}
    for name, text in blocks:
        lines = (folder / name).read_text().splitlines(keepends=True)
        assert text == "".join(line for line in lines if "SPDX" not in line), name
