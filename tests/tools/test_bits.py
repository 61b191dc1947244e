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
    assert (found.case, found.field, found.ulps) == ("out.h5", "q [7]", 1)
    with h5py.File(folders[1] / "out.h5", "r+") as file:
        file["q"][7] = values[7]
        file["q"][0] = -0.0  # equal to 0, with another bit
    assert len(compare.compare_folders(*folders).differences) == 1
    with h5py.File(folders[1] / "out.h5", "r+") as file:
        file["q"][0] = 0.0
        file["q"].attrs["unit"] = "h"
    (found,) = compare.compare_folders(*folders).differences
    assert (found.field, found.old, found.new) == ("q@unit", "-", "h")


def test_what_was_skipped_is_compared_on_neither_side(compare, folders):
    (folders[0] / "within/out.csv").write_text("t\n1\n")
    (folders[1] / "golden.json").write_text("{}")
    assert len(compare.compare_folders(*folders).differences) == 2
    (found,) = compare.compare_folders(*folders, without=["within"]).differences
    assert found.case == "golden.json"


@pytest.fixture
def names(compare, tmp_path):
    from bitwise.names import Names
    (tmp_path / "names.tsv").write_text("# OLD, NEW\nrate\tomega\nomega\tspin\n--old-way\t--way\n")
    return Names(tmp_path / "names.tsv")


def test_whole_words_change_their_names_all_at_once(names):
    old, new = "rate = omega, rates, rate-x, x.rate --old-way", (
        "omega = spin, rates, rate-x, x.omega --way")
    assert names.to_new(old) == new and names.to_old(new.encode()).decode() == old
    assert names.to_old(b"\xff omega") == b"\xff omega"  # no text


def test_what_is_called_otherwise_is_equal(compare, folders, names):
    for folder, name in zip(folders, ("rate", "omega"), strict=True):
        (folder / "within/out.csv").write_text(f"# {name}\nt,{name}\n0,1\n")
        with h5py.File(folder / "out.h5", "w") as file:
            file.create_dataset(name, data=[1.0, 2.0], track_times=False)
            file[name].attrs["of"] = f"the {name}"
    assert len(compare.compare_folders(*folders).differences) > 4
    assert not compare.compare_folders(*folders, rename=names.to_new).differences
    (folders[1] / "within/out.csv").write_text("# omega\r\nt,omega\n0,1\n")
    (found,) = compare.compare_folders(*folders, rename=names.to_new).differences
    assert found.field == "bytes"


class Side:
    """One whose program prints its arguments and what its file holds, as an error."""

    def __init__(self, folder, names=None):
        self.names, self.polhode = names, folder / "polhode"
        self.polhode.write_text("#!/bin/sh\necho \"a.toml:1:8: $*\" >&2; cat - a.toml; exit 2\n")
        self.polhode.chmod(0o755)


def test_messages_have_a_place_and_a_status(compare, tmp_path, names):
    from bitwise import messages
    table = {"texts": {"t1": ["a", "rate = 1", "c"]},
             "rows": {"run 1": ["run 'a b'", "in\n", {"name": "a.toml", "of": "t1", "from": 0,
                                                    "to": 1, "put": ["rate = x"]}]}}
    expected = ("run 1\tstatus\t2\nrun 1\tout 0 place\t\nrun 1\tout 0\tin\n"
                "run 1\tout 1 place\t\nrun 1\tout 1\trate = x\n"
                "run 1\tout 2 place\t\nrun 1\tout 2\trate = 1\n"
                "run 1\tout 3 place\t\nrun 1\tout 3\tc\n"
                "run 1\terror 0 place\ta.toml:1:{}\nrun 1\terror 0\trun a b\n")
    for known, column in ((None, 8), (names, 9)):  # the column that it has with the longer name
        messages.run(Side(tmp_path, known), table, tmp_path / "messages.tsv")
        assert (tmp_path / "messages.tsv").read_text() == expected.format(column)


def test_rows_of_messages_name_texts_that_are_there(root, compare):
    from bitwise import messages, revision
    table = revision.table_of(root / "tools/bitwise/messages.toml")
    used = {file["of"] for row in table["rows"].values() for file in row[2:] if "of" in file}
    assert used == set(table["texts"]) and len(table["rows"]) > 400
    for row in table["rows"].values():
        for file in row[2:]:
            messages.written(table["texts"], file).encode("latin-1")


def test_a_side_has_its_own_inputs_and_else_those_of_the_tree(names, tmp_path, monkeypatch):
    from bitwise import revision
    for tree in ("tree", "old"):
        (tmp_path / tree / "tools").mkdir(parents=True)
    (tmp_path / "tree/tools/a.toml").write_text("[g]\nx = 'omega'\nnew = 'omega'\n")
    (tmp_path / "tree/tools/b.txt").write_text("omega")
    (tmp_path / "old/tools/a.toml").write_text("[g]\nx = 'own'\ngone = 'own'\n")
    monkeypatch.setattr(revision, "ROOT", tmp_path / "tree")
    monkeypatch.setattr(revision, "HOME", tmp_path / "home")
    monkeypatch.setattr(revision, "INPUTS", ["tools"])
    side = revision.Side("old", "old", tmp_path, tmp_path / "old", names=names)
    assert side.table("tools/a.toml") == {"g": {"x": "own", "new": "rate"}}
    assert (side.inputs / "tools/b.txt").read_text() == "rate"
    assert side.command("run", "--way") == [tmp_path / "polhode", "run", "--old-way"]


def test_a_script_leaves_files_and_no_times(outputs, tmp_path):
    side = Side(tmp_path)
    outputs.run_script(side, "echo '5 members a second' >&2\nfalse\necho kept\n", tmp_path / "case")
    assert (tmp_path / "case/stdout.txt").read_text() == "status 1\nkept\n"
    assert (tmp_path / "case/stderr.txt").read_text() == ""
    outputs.run_script(side, "killed sh -c 'touch a.checkpoint; sleep 60'\n", tmp_path / "killed")
    assert sorted(path.name for path in (tmp_path / "killed").iterdir()) == [
        "a.checkpoint", "stderr.txt", "stdout.txt"]
    assert (tmp_path / "killed/stdout.txt").read_text() == ""


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

    class Endless:
        name, polhode, inputs = "this side", endless, tmp_path

        @staticmethod
        def command(*words):
            return [endless, *words]

        @staticmethod
        def compile(source, program):
            program.symlink_to(endless)

    scenario = tmp_path / "slow.toml"
    scenario.write_text("")
    folder = tmp_path / "outputs"
    (folder / "in").mkdir(parents=True)
    (folder / "in/slow.toml").write_text("")
    assert outputs.run_scenario(Endless, "map", scenario, folder) == ["slow"]
    assert [path.name for path in folder.iterdir()] == ["in"]
    with pytest.raises(failed, match="takes more than 1 s"):
        outputs.run_probe(Endless, "free", folder)


def test_outputs_are_kept_only_while_what_makes_them_is_the_same(outputs, tmp_path, monkeypatch):
    folder = tmp_path / "tools/bitwise"
    folder.mkdir(parents=True)
    for name in ("outputs.py", "messages.py", "revision.py", "names.tsv", "free.cpp", "cases.hpp",
                 "record.hpp"):
        (folder / name).write_text(name)
    monkeypatch.setattr(outputs, "ROOT", tmp_path)

    class Own:
        inputs = tmp_path

    digests = {outputs.digest(Own, "free")}
    for k, path in enumerate(sorted(folder.iterdir()), 2):
        path.write_text("changed")
        digests.add(outputs.digest(Own, "free"))
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
