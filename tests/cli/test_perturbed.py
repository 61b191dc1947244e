# SPDX-License-Identifier: MIT
"""Runs with perturbations, frames, methods and events, against what physics says of them."""

import json
import math
import re

import budgets
import h5py
import numpy
import pytest
from closeness import assert_allclose
from pybtex.database import parse_file, parse_string
from scenario_parts import BODY, STATE

SPHERE = "schema = 1\n[body]\nmoments = [2, 2, 2]\n"
ORBIT = "[orbit.moon]\ngm = 1\nsemi_major_axis = 1\neccentricity = 0.1\n"
GRAVITY = "[[perturbation]]\nkind = \"gravity-gradient\"\norbit = \"moon\"\n"
# A point mass that passes almost through the body at t = 1: no step is short enough.
COLLISION = ("[orbit.moon]\ngm = 1\npericentre = 1e-13\neccentricity = 1.0000000000000002\n"
             "epoch = 1\n" + GRAVITY)


@pytest.fixture
def write(tmp_path):
    def path_of(text, name="run.toml"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return path_of


@pytest.fixture
def columns(run, table):
    def read(path, *extra):
        result = run.ok("run", path, *extra)
        names, rows = table(result.stdout)
        return dict(zip(names, numpy.array(rows).T, strict=True))

    return read


def rows_of(path, table):
    names, rows = [], []
    lines = [x for x in path.read_text(encoding="utf-8").splitlines() if not x.startswith("#")]
    names = lines[0].split(",")
    for line in lines[1:]:
        rows.append(dict(zip(names, line.split(","), strict=True)))
    return rows


METHODS = {
    "chosen": "",
    "adaptive": "[method]\nkind = \"adaptive\"\ntolerance = 1e-14\n",
    "double-double": "[method]\nkind = \"adaptive\"\nprecision = \"double-double\"\n"
                     "tolerance = 1e-18\n",
    "variation": "[method]\nkind = \"variation-of-constants\"\ntolerance = 1e-13\n",
    "order8": "[method]\nkind = \"splitting\"\nscheme = \"order8\"\nstep = 0.02\n",
    "ABA1064": "[method]\nkind = \"splitting\"\nscheme = \"ABA1064\"\nstep = 0.01\n",
}


def test_every_method_goes_the_same_way(write, columns):
    time = "[time]\nstop = 20\nstep = 0.5\n[output]\ncolumns = [\"q\", \"omega\"]\n"
    runs = {name: columns(write(BODY + STATE + ORBIT + GRAVITY + method + time))
            for name, method in METHODS.items()}
    for name, c in runs.items():
        for column in ("qw", "qx", "qy", "qz", "w1", "w2", "w3"):
            assert_allclose(c[column], runs["double-double"][column],
                            atol=budgets.cli_methods, err_msg=name)


def test_damping_is_exponential(write, columns):
    text = SPHERE + STATE + (
        "[[perturbation]]\nkind = \"damping\"\ncoefficients = [0.5, 0.5, 0.5]\n"
        "[time]\nstop = 10\nstep = 1\n[output]\ncolumns = [\"omega_inertial\"]\n")
    c = columns(write(text))
    for name, start in (("W1", 0.1), ("W2", 0.2), ("W3", 1.0)):
        assert_allclose(c[name], start * numpy.exp(-0.25 * c["t"]), rtol=budgets.cli_carried)


@pytest.mark.parametrize("axes", ["body", "inertial"])
def test_a_constant_torque_spins_up(write, columns, axes):
    text = BODY + ("[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [0, 0, 1]\n"
                   "[[perturbation]]\nkind = \"constant-torque\"\ntorque = [0, 0, 0.5]\n"
                   f"axes = \"{axes}\"\n[time]\nstop = 10\nstep = 1\n")
    c = columns(write(text))
    assert_allclose(c["w3"], 1 + 0.2 * c["t"], rtol=budgets.cli_rounding)
    cosine = numpy.cos((c["t"] + 0.1 * c["t"]**2) / 2)
    assert_allclose(c["qw"] * numpy.sign(c["qw"][0]), cosine, atol=budgets.cli_carried)


SPIN_UP = BODY + ("[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [0, 0, -1]\n"
                  "[[perturbation]]\nkind = \"constant-torque\"\ntorque = [0, 0, 0.5]\n"
                  "[time]\nstop = 20\nstep = 3\n[output]\ncolumns = [\"omega\"]\n")


def test_events_are_found_and_written(run, write, table, tmp_path):
    text = SPIN_UP + ("[[event]]\nname = \"turns\"\ncolumn = \"w3\"\n"
                      "[[event]]\ncolumn = \"w3\"\nvalue = 2\ncrossing = \"falling\"\n")
    out = tmp_path / "events.csv"
    result = run.ok("run", write(text), "--events", out)
    assert "turns, rising, at t" in result.stdout and "completed" in result.stdout
    found = rows_of(out, table)
    assert [event["name"] for event in found] == ["turns"]  # the other one rises
    assert float(found[0]["t"]) == pytest.approx(5, rel=budgets.cli_rounding)
    assert found[0]["direction"] == "1"
    assert abs(float(found[0]["w3"])) < budgets.cli_rounding
    assert not list(tmp_path.glob("*.part"))
    assert out.read_text(encoding="utf-8").startswith("# polhode ")


def test_a_summary_of_many_events_says_where_all_are(run, write, tmp_path):
    text = SPIN_UP.replace("stop = 20", "stop = 1000") + (
        "[[event]]\ncolumn = \"phi\"\nvalue = 1\ncrossing = \"both\"\n")
    out = tmp_path / "events.csv"
    printed = [run("run", write(text), *options).stdout.splitlines() for options in (
        ["--events", out], ["--out", tmp_path / "a.csv"])]
    more = [next(line for line in lines if "events more" in line) for lines in printed]
    lines = out.read_text(encoding="utf-8").splitlines()
    count = sum(not line.startswith(("#", "name")) for line in lines)
    assert count > 20
    assert more[0].split() == ["and", f"{count - 20}", "events", "more:", "all", "in", str(out)]
    assert more[1].endswith(f"{count - 20} events more: --events PATH.csv")


def test_an_event_may_stop_the_run(run, write, columns):
    text = SPIN_UP + "[[event]]\ncolumn = \"w3\"\nvalue = 1\nstops = true\n"
    c = columns(write(text))
    assert list(c["t"][:4]) == [0, 3, 6, 9] and len(c["t"]) == 5
    assert c["t"][-1] == pytest.approx(10, rel=budgets.cli_rounding)
    assert c["w3"][-1] == pytest.approx(1, rel=budgets.cli_rounding)


def test_the_jump_of_an_angle_is_no_event(run, write, table, tmp_path):
    """A body that spins with 1 rad/s about inertial axis 3: psi rises through 0 once per turn, and
    jumps from pi to -pi once per turn."""
    state = ("[state.attitude-rate]\neuler = { phi = 0, theta = 1, psi = 1 }\n"
             "omega_inertial = [0, 0, 1]\n")
    for crossing, value, times in (("both", 0.5, 3), ("rising", 0.5, 3), ("falling", 0.5, 0),
                                   ("both", 0.5 - 4 * math.pi, 3)):
        text = SPHERE + state + (f"[[event]]\ncolumn = \"phi\"\nvalue = {value}\n"
                                 f"crossing = \"{crossing}\"\n[time]\nstop = 20\nstep = 1\n")
        out = tmp_path / "events.csv"
        run.ok("run", write(text), "--events", out)
        found = [float(event["t"]) for event in rows_of(out, table)]
        assert len(found) == (4 if times else 0)
        for k, t in enumerate(found):
            assert t == pytest.approx(0.5 + 2 * math.pi * k, abs=budgets.cli_carried)


def test_events_need_a_table_and_a_csv(run, write, tmp_path):
    path = write(BODY + STATE + "[time]\nstop = 1\nstep = 1\n")
    assert "[[event]]" in run.rejected("run", path, "--events", tmp_path / "e.csv")
    path = write(SPIN_UP + "[[event]]\ncolumn = \"w3\"\n")
    for name, message in (("e.h5", "expected PATH.csv"), ("none/e.csv", "folder does not exist")):
        result = run("run", path, "--events", tmp_path / name)
        assert result.returncode == 2 and message in result.stderr
        assert len(result.stderr.splitlines()) == 1
    same = tmp_path / "same.csv"
    result = run("run", path, "--events", same, "--out", same)
    assert result.returncode == 2 and "twice" in result.stderr and not same.exists()


def test_rows_may_begin_anywhere_and_run_backwards(write, columns):
    rest = "[output]\ncolumns = [\"q\", \"omega\"]\n"
    head = BODY + STATE + ORBIT + GRAVITY
    whole = columns(write(head + "[time]\nstop = 10\nstep = 1\n" + rest))
    for time, rows in (("start = 4\nstop = 10\nstep = 1\n", range(4, 11)),
                       ("start = 10\nstop = 0\nstep = -1\n", range(10, -1, -1)),
                       ("at = [7, 7, 8]\n", [7, 7, 8])):
        part = columns(write(head + "[time]\n" + time + rest))
        for name, values in part.items():
            assert_allclose(values, whole[name][list(rows)], atol=budgets.cli_carried)
    back = columns(write(head + "[time]\nstart = -3\nstop = 3\nstep = 3\n" + rest))
    assert list(back["t"]) == [-3, 0, 3]
    rates = [back[name][1] for name in ("w1", "w2", "w3")]
    assert rates == pytest.approx([0.1, 0.2, 1], abs=budgets.cli_carried)


def test_hdf5_holds_what_csv_holds(run, write, table, tmp_path):
    groups = ("q_inertial omega_rel convective andoyer_osc euler_osc axes axes_rel energy sadov "
              "serret").split()
    text = BODY + STATE + ORBIT + GRAVITY + (
        "[frame.precessing]\naxis = [0, 1, 1]\nrate = 0.2\n[time]\nstop = 5\nstep = 0.1\n"
        f"[output]\ncolumns = {json.dumps(groups)}\n")
    run.ok("run", write(text), "--out", tmp_path / "a.csv", "--out", tmp_path / "a.h5")
    names, rows = table((tmp_path / "a.csv").read_text(encoding="utf-8"))
    with h5py.File(tmp_path / "a.h5") as file:
        assert set(file.attrs["groups"]) == {"t", *groups}
        assert any("precessing" in note for note in file.attrs["notes"])
        assert any("method: collocation" in note for note in file.attrs["notes"])
        stack = numpy.column_stack([file[group] for group in ["t", *groups]])
        listed = [name for group in ["t", *groups] for name in file[group].attrs["columns"]]
    assert names == listed and len(set(names)) == len(names)
    assert {"lobe", "sign_g1", "sign_g3"} <= set(names)
    assert numpy.array_equal(stack, numpy.array(rows))
    assert not numpy.isnan(stack).any()


def test_convert_reads_the_branch_of_a_perturbed_run(run, write, table):
    text = BODY + STATE + ORBIT + GRAVITY + (
        "[time]\nstop = 5\nstep = 0.5\n[output]\ncolumns = [\"q\", \"g\", \"sadov\"]\n")
    rows = run("run", write(text)).stdout
    names, before = table(rows)
    hub = ("qw", "qx", "qy", "qz", "g1", "g2", "g3")
    kept = [i for i, name in enumerate(names) if name not in hub]
    sadov = "\n".join([",".join(names[i] for i in kept)] +
                      [",".join(repr(row[i]) for i in kept) for row in before]) + "\n"
    result = run.ok("convert", "--from", "sadov", "--to", "rotor", "--moments", "1,2,2.5",
                    stdin=sadov)
    now, after = table(result.stdout)
    for a, b in zip(before, after, strict=True):
        for name in ("g1", "g2", "g3"):
            expected = a[names.index(name)]
            assert b[now.index(name)] == pytest.approx(expected, abs=budgets.cli_carried)


@pytest.mark.parametrize("extension", ["csv", "h5"])
def test_a_run_that_fails_midway_keeps_its_rows(run, write, table, tmp_path, extension):
    path = write(BODY + STATE + COLLISION + "[time]\nstop = 2\nstep = 0.001\n")
    out = tmp_path / f"a.{extension}"
    result = run("run", path, "--out", out)
    assert result.returncode == 1 and result.stdout == ""
    assert len(result.stderr.splitlines()) == 1
    assert result.stderr.startswith("run.toml: the run failed at t = 0.99999")
    assert "try" in result.stderr and "rows so far: 1000" in result.stderr
    assert not out.exists()
    part = tmp_path / f"a.{extension}.part"
    if extension == "csv":
        _, rows = table(part.read_text(encoding="utf-8"))
        assert len(rows) == 1000 and rows[-1][0] == 0.999
    else:
        with h5py.File(part) as file:
            assert len(file["t"]) == len(file["q"]) == 1000 and file["t"][-1] == 0.999


@pytest.mark.parametrize("method", [
    "kind = \"adaptive\"", "kind = \"splitting\"\nstep = 0.1",
    "kind = \"splitting\"\nstep = 0.1\nscheme = \"order2\"", "kind = \"variation-of-constants\""])
def test_what_cannot_go_on_says_so(run, write, method):
    """A torque beyond all numbers: one line, status 1, no crash."""
    path = write(BODY + STATE + "[[perturbation]]\nkind = \"constant-torque\"\n"
                 f"torque = [1e307, 1e307, 1e307]\n[method]\n{method}\n[time]\nat = [1, 2]\n")
    result = run("run", path)
    assert result.returncode == 1
    assert len(result.stderr.splitlines()) == 1
    assert result.stderr.startswith("run.toml: the run failed at t = ")


def test_an_event_that_is_no_number_ends_the_run(run, write, tmp_path):
    text = SPHERE + ("[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [0, 0, 0]\n"
                     "[[event]]\ncolumn = \"I_r\"\nvalue = 1\n[time]\nstop = 1\nstep = 1\n")
    result = run("run", write(text), "--events", tmp_path / "e.csv")
    assert result.returncode == 1 and "event \"I_r\" is NaN" in result.stderr
    assert not (tmp_path / "e.csv").exists() and (tmp_path / "e.csv.part").exists()


def test_info_and_outputs_say_what_moves_the_body(run, write):
    path = write(BODY + STATE + ORBIT + GRAVITY + "[frame.orbit-plane]\norbit = \"moon\"\n"
                 "[[event]]\ncolumn = \"theta\"\nvalue = 1\n[time]\nstop = 1\nstep = 1\n")
    table = json.loads(run("info", path, "--json").stdout)
    assert table["orbit_moon"]["value"] == pytest.approx(2 * math.pi, rel=budgets.cli_rounding)
    assert table["perturbation_1"] == "gravity gradient, orbit moon"
    assert table["frame"] == "plane of orbit moon"
    assert table["event_1"] == "theta = 1 rad"
    chosen = "collocation, tolerance 1e-12 (chosen: the file names no method)"
    assert table["method"] == chosen
    assert f"# method: {chosen}" in run("run", path).stdout.splitlines()
    cited = run("cite", path).stdout
    assert "butcher1964" in cited and "markley1995" in cited and "efroimsky2007" in cited
    free = write(BODY + STATE + "[frame.precessing]\naxis = [0, 0, 1]\nrate = 1\n")
    assert json.loads(run("info", free, "--json").stdout)["method"] == \
        "exact free rotation, seen from the moving frame"


def keys_cited(run, path):
    lines = run("cite", path).stdout.splitlines()
    return {line[1:].split("]")[0] for line in lines if line.startswith("[")}


def plain(text):
    """LaTeX as the sources write it: Sim{\\'o} as Simo, f{\\"u}r as fuer."""
    for letter in "uoa":
        text = text.replace('{\\"' + letter + "}", letter + "e")
    text = re.sub(r"\\[^\w\s]", "", text.replace("{", "").replace("}", ""))
    return text.replace("--", "-").replace("\\c ", "").replace("\\i", "i")


def papers_of_everything(run, write, root):
    """What every example and every method cites: as people read it, and for BibTeX."""
    scenarios = [write(BODY + STATE + ORBIT + GRAVITY + method) for method in METHODS.values()]
    scenarios += (root / "examples").glob("*.toml")
    printed = "".join(run("cite", path).stdout for path in scenarios)
    entries = "".join(run("cite", path, "--bibtex").stdout for path in scenarios)
    return dict(re.findall(r"^\[(\w+)\] (.*)$", printed, re.M)), entries


def test_papers_are_in_the_bibliography(run, write, root):
    """A program that knows BibTeX reads the entries: they are those of the documentation, and say
    the same as the text: authors, year, volume, first page."""
    cited, printed = papers_of_everything(run, write, root)
    assert {"mignard1979", "moisson2001", "cincotta2000", "praly2012"} - {*cited} == {"mignard1979"}
    once = {}
    for entry in re.findall(r"^@\w+\{\w+,\n(?:.*\n)*?\}\n", printed, re.M):
        once[entry] = None
    read = parse_string("".join(once), "bibtex").entries
    known = parse_file(root / "docs/references.bib").entries
    assert {*read} == {*cited}
    for key, text in cited.items():
        entry = read[key]
        fields = {name: value for name, value in known[key].fields.items() if name != "nodoi"}
        assert (entry.type, dict(entry.fields)) == (known[key].type, fields), key
        assert entry.persons == known[key].persons, key
        names = [plain(" ".join(p.last_names)) for p in entry.persons.get("author", [])]
        said = [name for name in names[:1] if not name.startswith("ERFA")]
        numbers = [entry.fields.get(name, "") for name in ("year", "volume", "pages")]
        for word in (*said, *(number.partition("--")[0] for number in numbers)):
            assert word in text, (key, word)


def test_papers_follow_where_positions_come_from(run, write, root):
    head = (BODY.replace("[body]", "[units]\nlength = \"km\"\n[body]") + "[state]\n"
            "epoch = \"2013-01-05 UTC\"\naxes = \"equator-J2000\"\n" + STATE
            + "[time]\nstop = 864000\ncount = 3\n[orbit.it]\nkind = \"ephemeris\"\n")
    theories = {"erfa", "moisson2001", "meeus1998", "simon1994", "park2021"}

    def of(target, centre, more=""):
        path = write(head + f"target = \"{target}\"\ncentre = \"{centre}\"\n" + more)
        return keys_cited(run, path) & (theories | {"markley1995"})

    assert of("sun", "earth") == {"erfa", "moisson2001", "park2021"}
    assert of("moon", "earth") == theories - {"moisson2001"}  # wherever the Earth is
    assert of("moon", "sun") == theories
    assert of("mars", "sun", "gm = 42828.4\n") == {"erfa", "simon1994"}
    assert "markley1995" in keys_cited(run, write(BODY + STATE + ORBIT))


def test_papers_of_attitude_files_and_of_chaos(run, write, root):
    assert "ccsds504" in keys_cited(run, write(BODY + STATE + "[output.aem]\n"))
    assert "ccsds504" not in keys_cited(run, write(BODY + STATE))
    chaos = {"benettin1976", "cincotta2000"}
    assert chaos <= keys_cited(run, root / "examples/hyperion-map.toml")
    assert not chaos & keys_cited(run, root / "examples/hyperion.toml")


def test_an_exact_run_in_a_moving_frame_is_the_integrated_one(write, columns):
    text = BODY + STATE + ("[frame.precessing]\naxis = [1, 0, 2]\nrate = 0.7\nepoch = 2\n"
                           "[time]\nstop = 20\nstep = 1\n[output]\n"
                           "columns = [\"q\", \"q_inertial\", \"omega\", \"omega_rel\", "
                           "\"serret\"]\n")
    exact = columns(write(text))
    integrated = columns(write(text + "[method]\nkind = \"adaptive\"\ntolerance = 1e-14\n"))
    for name, values in exact.items():
        if name != "t0":  # counts periods on its own
            assert_allclose(integrated[name], values, atol=budgets.cli_carried, err_msg=name)
