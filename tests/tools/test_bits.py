# SPDX-License-Identifier: MIT
"""tools/bits: one bit that differs is found, named and measured, whatever the file."""

import math
import runpy
import subprocess
import sys

import h5py
import numpy
import pytest


@pytest.fixture(scope="module")
def compare(root):
    sys.path.insert(0, str(root / "tools"))
    from bitwise import compare
    return compare


@pytest.fixture(scope="module")
def outputs(compare):
    from bitwise import outputs
    return outputs


@pytest.fixture(scope="module")
def failed(compare):
    from bitwise.revision import Failed
    return Failed


@pytest.fixture
def folders(tmp_path):
    """Two folders for the outputs of two sides."""
    pair = tmp_path / "old", tmp_path / "new"
    for folder in pair:
        (folder / "within").mkdir(parents=True)
    return pair


def with_last_bit_flipped(x):
    return numpy.float64(x).view(numpy.int64).__xor__(1).view(numpy.float64)


@pytest.mark.parametrize("old, new, ulps", [
    ("0x1p+0", "0x1.0000000000001p+0", 1), ("0x1p+0", "0x1.fffffffffffffp-1", 1),
    ("0x0p+0", "-0x0p+0", 1), ("-0x0.0000000000001p-1022", "0x0.0000000000001p-1022", 3),
    ("1", "1.0000000000000004", 2), ("0x1p+0", "nan", None), ("inf", "0x1.fffffffffffffp+1023", 1),
    ("short_axis", "long_axis", None), ("0x1p+0", "-0x1p+0", 2 * 0x3FF0000000000000 + 1)])
def test_differences_are_counted_in_units_of_the_last_place(compare, old, new, ulps):
    assert compare.ulps_between(old, new) == ulps == compare.ulps_between(new, old)


def probe_text(values):
    return "".join(f"case/{k}\tat.q.w\t{value.hex()}\n" for k, value in enumerate(values))


def test_a_bit_of_a_probe(compare, folders):
    values = numpy.linspace(-3.0, 5.0, 1000).tolist()
    old, new = folders
    (old / "free.tsv").write_text(probe_text(values))
    (new / "free.tsv").write_text(probe_text(values))
    same = compare.compare_folders(old, new)
    assert (same.values, same.differences, same.worst()) == (1000, [], None)
    changed = float(with_last_bit_flipped(values[617]))
    (new / "free.tsv").write_text(probe_text([*values[:617], changed, *values[618:]]))
    found = compare.compare_folders(old, new)
    assert found.values == 1000 and found.worst() == 1
    assert found.differences == [compare.Difference(
        "case/617", "at.q.w", values[617].hex(), changed.hex(), 1)]


def test_what_only_one_side_says(compare, folders):
    old, new = folders
    (old / "charts.tsv").write_text("a\tx\t0x1p+0\na\ty\t0x1p+0\nb\tx\t0x1p+0\n")
    (new / "charts.tsv").write_text("a\tx\t0x1p+0\na\ty.refused\ttoo small\nb\tx\t0x1p+0\n")
    found = compare.compare_folders(old, new)
    assert [(d.field, d.old, d.new) for d in found.differences] == [
        ("y", "0x1p+0", "-"), ("y.refused", "-", "too small")]
    assert found.worst() == math.inf
    (old / "only.csv").write_text("t\n1\n")
    assert len(compare.compare_folders(old, new).differences) == 3


def test_rows_comments_and_lines_of_a_csv_file(compare, folders):
    old, new = folders
    text = "# polhode\n# second\nt,qw\n0,1\n0.5,0.1\n"
    (old / "within/out.csv").write_text(text)
    (new / "within/out.csv").write_text(text)
    assert compare.compare_folders(old, new).values == 7  # two comments, the names, four numbers
    (new / "within/out.csv").write_text(text.replace("0.1", "0.10000000000000002"))
    (found,) = compare.compare_folders(old, new).differences
    assert (found.case, found.field, found.ulps) == ("within/out.csv", "row 1 qw", 1)
    (new / "within/out.csv").write_text(text.replace("second", "other"))
    (found,) = compare.compare_folders(old, new).differences
    assert (found.field, found.ulps) == ("comment 1", None)
    (new / "within/out.csv").write_text(text.replace("\n", "\r\n"))
    assert compare.compare_folders(old, new).differences
    (new / "within/out.csv").write_text(text + "1,0.2\n")
    assert [d.old for d in compare.compare_folders(old, new).differences] == ["-", "-"]


def test_numbers_of_a_json_file(compare, folders):
    old, new = folders
    (old / "golden.json").write_text('{"cases": [{"t": 0.1, "bound": 1e-16}]}')
    (new / "golden.json").write_text('{"cases": [{"t": 0.1, "bound": 1.0000000000000001e-16}]}')
    (found,) = compare.compare_folders(old, new).differences
    assert (found.field, found.ulps) == (".cases[0].bound", 1)


def test_a_bit_of_an_hdf5_file(compare, folders):
    values = numpy.linspace(0.0, 1.0, 50)
    for folder, factor in zip(folders, (1.0, 1.0), strict=True):
        with h5py.File(folder / "out.h5", "w") as file:
            file.create_dataset("q", data=values * factor, track_times=False)
    assert compare.compare_folders(*folders).differences == []
    with h5py.File(folders[1] / "out.h5", "r+") as file:
        file["q"][7] = with_last_bit_flipped(values[7])
    (found,) = compare.compare_folders(*folders).differences
    assert "/q" in found.field and found.new == "1 differences found"
    with h5py.File(folders[1] / "out.h5", "r+") as file:
        file["q"][7] = values[7]
        file["q"][0] = -0.0  # equal to 0, with another bit
    assert len(compare.compare_folders(*folders).differences) == 1


def test_what_was_skipped_is_compared_on_neither_side(compare, folders):
    (folders[0] / "within/out.csv").write_text("t\n1\n")
    (folders[1] / "golden.json").write_text("{}")
    assert len(compare.compare_folders(*folders).differences) == 2
    (found,) = compare.compare_folders(*folders, without=["within"]).differences
    assert found.case == "golden.json"


@pytest.mark.parametrize("script, message", [
    (None, "h5diff is not there: it is in the package hdf5-tools"),
    ("exit 2", "status 2, without a word")])
def test_h5diff_that_says_nothing(compare, failed, folders, tmp_path, monkeypatch, script, message):
    for folder in folders:
        (folder / "out.h5").write_text(folder.name)
    if script is not None:
        (tmp_path / "h5diff").write_text(f"#!/bin/sh\n{script}\n")
        (tmp_path / "h5diff").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(failed, match=message):
        compare.compare_folders(*folders)


def test_no_time_and_no_memory_are_told_apart(outputs, failed, tmp_path, monkeypatch):
    monkeypatch.setattr(outputs, "SECONDS", 1)
    with pytest.raises(outputs.TooLong, match="takes more than 1 s of processor time"):
        outputs.printed(["sh", "-c", "while :; do :; done"], tmp_path / "out.txt")
    with pytest.raises(failed, match="was killed; did the memory end") as killed:
        outputs.printed(["sh", "-c", "kill -KILL $$"], tmp_path / "out.txt")
    assert killed.type is failed
    outputs.printed(["sh", "-c", "echo no >&2; exit 3"], tmp_path / "out.txt")
    assert (tmp_path / "out.failed.txt").read_text() == "status 3\nno\n"


def test_a_scenario_that_takes_too_long_is_skipped_and_a_probe_is_not(
        outputs, failed, tmp_path, monkeypatch):
    monkeypatch.setattr(outputs, "SECONDS", 1)
    endless = tmp_path / "endless"
    endless.write_text("#!/bin/sh\nwhile :; do :; done\n")
    endless.chmod(0o755)

    class Side:
        name, polhode = "this side", endless

        @staticmethod
        def compile(source, program):
            program.symlink_to(endless)

    scenario = tmp_path / "slow.toml"
    scenario.write_text("")
    folder = tmp_path / "outputs"
    folder.mkdir()
    assert outputs.run_scenario(Side, "map", scenario, folder) == ["slow"]
    assert not list(folder.iterdir())
    with pytest.raises(failed, match="takes more than 1 s"):
        outputs.run_probe(Side, "free", folder)


def test_outputs_are_kept_only_while_what_makes_them_is_the_same(outputs, tmp_path, monkeypatch):
    for name in ("outputs.py", "revision.py", "free.cpp", "cases.hpp", "record.hpp"):
        (tmp_path / name).write_text(name)
    monkeypatch.setattr(outputs, "PROBES", tmp_path)
    digests = {outputs.digest("free")}
    for k, path in enumerate(sorted(tmp_path.iterdir()), 2):
        path.write_text("changed")
        digests.add(outputs.digest("free"))
        assert len(digests) == k, path.name


# A probe is compiled by tools/bits alone: a header that changes would break it unseen.
@pytest.mark.parametrize("probe", ["charts", "free", "w1"])
def test_a_probe_compiles_against_the_headers_of_the_tree(root, outputs, probe):
    from bitwise import revision
    done = subprocess.run(["g++", *revision.FLAGS, "-O0", "-fsyntax-only", f"-I{root}/include",
                           root / f"tools/bitwise/{probe}.cpp"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("status, differ, skipped", [
    (0, False, []), (1, True, []), (2, False, ["slow"]), (1, True, ["slow"])])
def test_exit_status(root, outputs, tmp_path, monkeypatch, capsys, status, differ, skipped):
    bits = runpy.run_path(str(root / "tools/bits"))
    for side in ("old", "new"):
        (tmp_path / side).mkdir()
        (tmp_path / side / "free.tsv").write_text(f"a\tx\t{side if differ else 1}\n")
    (tmp_path / "new/slow").mkdir()
    (tmp_path / "new/slow/out.csv").write_text("t\n1\n")
    if not skipped:
        (tmp_path / "new/slow/out.csv").unlink()
    monkeypatch.setattr(outputs, "outputs", lambda side, group: (
        tmp_path / side, skipped if side == "old" else []))
    assert bits["compare_group"]("free", "old", "new", 10) == status
    printed = capsys.readouterr().out
    assert ("skipped, not compared: slow" in printed) == bool(skipped)
    assert printed.count("differ") == 1 and ("a  x  old  new" in printed) == differ


@pytest.mark.parametrize("arguments, message", [
    (["no-such-revision"], "bits: no-such-revision is no revision of this repository\n"),
    (["HEAD", "--only", "fre"], "--only: 'fre' is none of free, charts, w1, ")])
def test_what_cannot_be_compared(root, arguments, message):
    done = subprocess.run([root / "tools/bits", *arguments], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "") and message in done.stderr
