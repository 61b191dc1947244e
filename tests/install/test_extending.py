# SPDX-License-Identifier: MIT
"""The worked examples of docs/extending, each built from a directory that holds nothing but its
files, against an installed polhode, and run as its page says."""

import re
import shutil
import subprocess

import budgets
import pytest


def sh(*arguments, cwd=None, status=0):
    done = subprocess.run(list(map(str, arguments)), cwd=cwd, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == status, f"{arguments}\n{done.stdout}"
    return done.stdout


@pytest.fixture(scope="module")
def prefix(build, tmp_path_factory):
    path = tmp_path_factory.mktemp("prefix")
    sh("cmake", "--install", build, "--prefix", path)
    return path


@pytest.fixture(scope="module")
def built(root, prefix, tmp_path_factory):
    """The directory of an example, built in place."""

    def build(name):
        path = tmp_path_factory.mktemp(name) / name
        shutil.copytree(root / "examples/extending" / name, path)
        sh("cmake", "-S", path, "-B", path / "build", "-G", "Ninja",
           f"-DCMAKE_PREFIX_PATH={prefix}")
        sh("cmake", "--build", path / "build")
        return path

    return build


def test_a_torque_of_your_own_is_a_kind_like_ours(built, tmp_path):
    path = built("torque")
    program = path / "build/spin-brake"
    out = tmp_path / "brake.csv"
    assert "completed" in sh(program, "run", path / "spin-brake.toml", "--out", out)
    rows = [line.split(",") for line in out.read_text().splitlines() if not line.startswith("#")]
    w3 = [float(row[rows[0].index("w3")]) for row in rows[1:]]
    assert w3[0] == pytest.approx(30, rel=budgets.cli_rounding) and abs(w3[-1]) < 1  # braked
    # the checkpoint of a run that was stopped, and the run that never was
    cut = tmp_path / "cut.csv"
    started = subprocess.Popen([program, "run", path / "spin-brake.toml", "--out", cut,
                                "--checkpoint", "0"], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    while not cut.with_name("cut.csv.checkpoint").exists() and started.poll() is None:
        pass
    started.kill()
    started.wait()
    sh(program, "run", path / "spin-brake.toml", "--out", cut, "--resume")
    assert cut.read_bytes() == out.read_bytes()
    assert "spin brake" in sh(program, "info", path / "spin-brake.toml")
    assert "[brake2026]" in sh(program, "cite", path / "spin-brake.toml")
    assert '"const": "spin-brake"' in sh(program, "schema")
    template = tmp_path / "template.toml"
    template.write_text(sh(program, "init", "spin-brake"))
    sh(program, "run", template, "--out", tmp_path / "template.csv")
    wrong = tmp_path / "wrong.toml"
    wrong.write_text((path / "spin-brake.toml").read_text().replace('"0.02 N m s"', '"0.02 N m"'))
    assert ':15:11: perturbation[0].damping: got "0.02 N m"; expected a damping coefficient' in sh(
        program, "info", wrong, status=2)


def test_pages_show_the_files_of_their_examples(root):
    for page in sorted((root / "docs/extending").glob("*.md")):
        blocks = re.findall(r"<!-- file: (.*?) -->\n(?:<!-- .*? -->\n)?```\w*\n(.*?)```",
                            page.read_text(), re.DOTALL)
        folder = root / "examples/extending" / page.stem
        shown = {name for name, _ in blocks}
        assert shown == {path.name for path in folder.iterdir()}
        for name, text in blocks:
            lines = (folder / name).read_text().splitlines(keepends=True)
            assert text == "".join(line for line in lines if "SPDX" not in line), name
