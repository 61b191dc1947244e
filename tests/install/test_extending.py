# SPDX-License-Identifier: MIT
"""The worked examples of docs/extending, each built from a directory that holds nothing but its
files, against an installed polhode, and run as its page says."""

import math
import shutil
import signal
import subprocess
import time

import budgets
import pytest
from shell import sh


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


@pytest.fixture(scope="module")
def braked(built):
    return built("torque")


def test_a_torque_of_your_own_is_a_kind_like_ours(braked, tmp_path):
    path, program = braked, braked / "build/spin-brake"
    out = tmp_path / "brake.csv"
    assert "completed" in sh(program, "run", path / "spin-brake.toml", "--out", out)
    rows = [line.split(",") for line in out.read_text().splitlines() if not line.startswith("#")]
    w3 = [float(row[rows[0].index("w3")]) for row in rows[1:]]
    assert w3[0] == pytest.approx(30, rel=budgets.cli_rounding) and abs(w3[-1]) < 1  # braked
    assert "spin brake" in sh(program, "info", path / "spin-brake.toml")
    assert "[brake2026]" in sh(program, "cite", path / "spin-brake.toml")
    assert '"const": "spin-brake"' in sh(program, "schema")
    template = tmp_path / "template.toml"
    text = sh(program, "init", "spin-brake")
    assert text.startswith("# A scenario for spin-brake. Every key: spin-brake schema keys\n")
    template.write_text(text)
    sh(program, "run", template, "--out", tmp_path / "template.csv")
    wrong = tmp_path / "wrong.toml"
    wrong.write_text((path / "spin-brake.toml").read_text().replace('"0.02 N m s"', '"0.02 N m"'))
    assert ':15:11: perturbation[0].damping: got "0.02 N m"; expected a damping coefficient' in sh(
        program, "info", wrong, status=2)


def test_a_torque_of_your_own_follows_an_orbit(braked, tmp_path):
    program, scenario, out = braked / "build/spin-brake", braked / "comet.toml", tmp_path / "c.csv"
    assert "jet, orbit comet" in sh(program, "run", scenario, "--out", out)
    names, rows = rows_of(out)
    gm, q, e = 132712440041.93 * 3600**2, 1.243 * 149597870.7, 0.641  # km and h
    momentum, motion = math.sqrt(gm * q * (1 + e)), math.sqrt(gm * ((1 - e) / q)**3)
    # over a turn of the body the jet gives 3/8 of its torque, over the orbit as the anomaly grows
    for row in rows[20::20]:
        mean = angle = motion * row[0]
        for _ in range(50):
            angle -= (angle - e * math.sin(angle) - mean) / (1 - e * math.cos(angle))
        true = 2 * math.atan2(math.sqrt(1 + e) * math.sin(angle / 2),
                              math.sqrt(1 - e) * math.cos(angle / 2))
        gain = 1e6 * 3600**2 * 3 / 8 * q**2 * (true % (2 * math.pi)) / momentum / 1.9e19
        assert row[names.index("w3")] - 29 == pytest.approx(math.degrees(gain), rel=budgets.own_jet)
    assert "jet, orbit comet" in runs_from_its_template(program, "comet-jet", tmp_path)
    wrong, text = tmp_path / "wrong.toml", scenario.read_text()
    wrong.write_text(text.replace('orbit = "comet"', 'orbit = "conet"'))
    assert 'perturbation[0].orbit: got "conet"' in sh(program, "info", wrong, status=2)
    begin, end = text.index("gm ="), text.index("[[perturbation]]")
    wrong.write_text(text[:begin] + "kind = 'table'\ntimes = [0, 2e4, 4e4, 6e4]\n"
                     "x = [1, 2, 3, 4]\ny = [1, 2, 4, 8]\nz = [1, 3, 5, 7]\n" + text[end:])
    assert 'orbit: got "comet"; expected an orbit with elements' in sh(program, "info", wrong,
                                                                       status=2)


def stopped(program, scenario, out, by):
    """What a run says that is stopped after its first checkpoint, long before its end."""
    command = [program, "run", scenario, "--out", out, "--checkpoint", "0"]
    started = subprocess.Popen(command, text=True, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)
    while not out.with_name(out.name + ".checkpoint").exists() and started.poll() is None:
        time.sleep(0.001)
    started.send_signal(by)
    said = started.communicate()[1]
    assert started.returncode == {signal.SIGKILL: -signal.SIGKILL,
                                  signal.SIGINT: 128 + signal.SIGINT}[by]
    return said


def test_a_run_with_a_torque_of_your_own_is_stopped_and_continued(braked, tmp_path):
    program = braked / "build/spin-brake"
    scenario = tmp_path / "long.toml"
    text = (braked / "spin-brake.toml").read_text()
    assert "stop = 3000\n" in text
    scenario.write_text(text.replace("stop = 3000\n", "stop = 600000\n"))
    out, cut = tmp_path / "whole.csv", tmp_path / "cut.csv"
    sh(program, "run", scenario, "--out", out)
    stopped(program, scenario, cut, signal.SIGKILL)
    sh(program, "run", scenario, "--out", cut, "--resume")
    assert cut.read_bytes() == out.read_bytes()


def test_messages_of_a_program_of_your_own_have_its_name(braked, tmp_path):
    program, scenario = braked / "build/spin-brake", tmp_path / "long.toml"
    text = (braked / "spin-brake.toml").read_text()
    scenario.write_text(text.replace("stop = 3000\n", "stop = 600000\n"))
    out = tmp_path / "cut.csv"
    said = stopped(program, scenario, out, signal.SIGINT)
    assert said.endswith(f"; continue with: {program} run {scenario} --out {out} --resume\n")
    assert sh(program, "rum", status=2).startswith('spin-brake: got command "rum"; expected one of')
    assert sh(program, "run", status=2).startswith("spin-brake run: FILE is required")
    assert sh(program, "init", "brake", status=2).startswith('spin-brake init: got "brake"; ')
    for command in ("cite", "convert", "ensemble", "golden", "info", "init", "map", "run", "schema",
                    "shape"):
        assert f"\n  spin-brake {command} " in sh(program, command, "--help")


def runs_from_its_template(program, kind, folder):
    """What `init` prints of a kind is a scenario that runs as it is."""
    template = folder / "template.toml"
    template.write_text(sh(program, "init", kind))
    return sh(program, "run", template, "--out", folder / "template.csv")


@pytest.fixture(scope="module")
def midpoint(built):
    return built("method")


def rows_of(path):
    rows = [line.split(",") for line in path.read_text().splitlines() if not line.startswith("#")]
    return rows[0], [[float(x) for x in row] for row in rows[1:]]


def test_a_method_of_your_own_is_a_kind_like_ours(midpoint, tmp_path):
    path, program = midpoint, midpoint / "build/lie-midpoint"
    scenario, text = path / "satellite.toml", (path / "satellite.toml").read_text()
    assert "completed" in sh(program, "run", scenario, "--out", tmp_path / "own.csv")
    ours = tmp_path / "ours.toml"
    ours.write_text(text.replace('kind = "lie-midpoint"\nstep = 0.01', 'kind = "adaptive"'))
    sh(program, "run", ours, "--out", tmp_path / "ours.csv")
    own, exact = rows_of(tmp_path / "own.csv"), rows_of(tmp_path / "ours.csv")
    assert own[0] == exact[0] and len(own[1]) == len(exact[1]) == 61
    for a, b in zip(own[1], exact[1], strict=True):
        assert a == pytest.approx(b, abs=budgets.own_midpoint)
    assert own[1][-1] != exact[1][-1]
    assert "lie-midpoint, step 0.01 s" in sh(program, "info", scenario)
    assert "[author2026]" in sh(program, "cite", scenario)
    assert '"const": "lie-midpoint"' in sh(program, "schema")
    wrong = tmp_path / "wrong.toml"
    assert "lie-midpoint, step 0.01 h" in runs_from_its_template(program, "lie-midpoint", tmp_path)
    wrong.write_text(text.replace("step = 0.01", "step = -1"))
    assert "19:8: method.step: got -1; expected a positive time" in sh(
        program, "info", wrong, status=2)


def test_a_run_by_a_method_of_your_own_is_stopped_and_continued(midpoint, tmp_path):
    program, scenario = midpoint / "build/lie-midpoint", tmp_path / "long.toml"
    text = (midpoint / "satellite.toml").read_text()
    scenario.write_text(text.replace("stop = 600\n", "stop = 60000\n"))
    out, cut = tmp_path / "whole.csv", tmp_path / "cut.csv"
    sh(program, "run", scenario, "--out", out)
    stopped(program, scenario, cut, signal.SIGKILL)
    sh(program, "run", scenario, "--out", cut, "--resume")
    assert cut.read_bytes() == out.read_bytes()


@pytest.fixture(scope="module")
def sun_synchronous(built):
    return built("orbit")


def test_an_orbit_of_your_own_is_a_kind_like_ours(sun_synchronous, tmp_path):
    path = sun_synchronous
    program, scenario, text = (path / "build/sun-synchronous", path / "satellite.toml",
                               (path / "satellite.toml").read_text())
    assert "completed" in sh(program, "run", scenario, "--out", tmp_path / "own.csv")
    assert "orbit satellite: period" in sh(program, "info", scenario)
    assert "[author2026]" in sh(program, "cite", scenario)
    assert '"const": "sun-synchronous"' in sh(program, "schema")
    assert "orbit earth: period" in runs_from_its_template(program, "sun-synchronous", tmp_path)
    said = sh(program, "init", "sun-synchronus", status=2)
    assert said.startswith('sun-synchronous init: got "sun-synchronus"; expected a chart (')
    assert ", shipped, sun-synchronous, spiral), a frame (" in said
    assert said.endswith("; did you mean sun-synchronous?\n")
    wrong = tmp_path / "wrong.toml"
    assert "plane of orbit satellite" in sh(program, "info", scenario)
    wrong.write_text(text.replace('"700 km"', '"9000 km"'))
    assert ('18:12: orbit.satellite.altitude: got "9000 km"; expected a lower orbit, whose node '
            "turns fast enough") in sh(program, "info", wrong, status=2)


def test_an_orbit_of_your_own_from_positions(sun_synchronous, tmp_path):
    path, program = sun_synchronous, sun_synchronous / "build/sun-synchronous"
    text = (path / "descent.toml").read_text()

    def last_row(scenario_text):
        scenario, out = tmp_path / "a.toml", tmp_path / "a.csv"
        scenario.write_text(scenario_text)
        sh(program, "run", scenario, "--out", out)
        return rows_of(out)[1][-1]

    # one that hardly shrinks is the circle
    circle = text.replace('"spiral"', '"kepler"').replace("start =", "semi_major_axis =")
    slow = text.replace("value = 20.0", "value = 1e-8")
    as_circle = last_row("".join(x for x in circle.splitlines(True) if "descent =" not in x))
    assert last_row(slow) == pytest.approx(as_circle, abs=budgets.own_spiral)
    assert last_row(text) != pytest.approx(as_circle, abs=1e3 * budgets.own_spiral)
    assert "gravity gradient, orbit earth" in runs_from_its_template(program, "spiral", tmp_path)
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(text[:text.index("[time]")])
    assert '16:9: orbit.low.start: got "6600 km"; expected a table [time]' in sh(
        program, "info", wrong, status=2)


def test_a_frame_of_your_own_is_a_kind_like_ours(built, tmp_path):
    path, out = built("frame"), tmp_path / "own.csv"
    program, scenario, text = (path / "build/swaying-plane", path / "moon.toml",
                               (path / "moon.toml").read_text())
    assert "seen from the moving frame" in sh(program, "run", scenario, "--out", out)
    lines = [line for line in out.read_text().splitlines() if not line.startswith("#")]
    rows = [map(float, line.split(",")) for line in lines[1:]]
    columns = dict(zip(lines[0].split(","), zip(*rows)))
    # the momentum stays in inertial axes: its angle to the plane's normal is that of the plane
    for k, t in enumerate(columns["t"]):
        tilt, node = (math.radians(columns[name][k]) for name in ("I_m", "h_m"))
        sway = math.radians(5.145 + 0.15 * math.cos(2 * math.pi * t / 173.31))
        turn = math.radians(-19.35 / 365.25 * t)
        cosine = (math.cos(tilt) * math.cos(sway)
                  + math.sin(tilt) * math.sin(sway) * math.cos(node - turn))
        assert columns["I_m_rel"][k] == pytest.approx(
            math.degrees(math.acos(cosine)), rel=budgets.cli_rounding)
    assert "a plane that sways" in out.read_text()
    assert '"swaying-plane"' in sh(program, "schema")
    assert "seen from the moving frame" in runs_from_its_template(program, "swaying-plane",
                                                                  tmp_path)
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(text.replace("sway = 0.15", "sway = 6"))
    assert ("15:8: frame.swaying-plane.sway: got 6; expected less than the inclination"
            in sh(program, "info", wrong, status=2))


@pytest.fixture(scope="module")
def colombo(built):
    return built("experiment")


def test_an_experiment_of_your_own_is_a_kind_like_ours(colombo, tmp_path):
    path, program, out = colombo, colombo / "build/colombos-top", tmp_path / "planet.csv"
    scenario, text = path / "planet.toml", (path / "planet.toml").read_text()
    said = sh(program, "run", scenario, "--out", out, "--out", tmp_path / "planet.h5")
    assert "completed" in said and "evaluations of the model" in said
    names, rows = rows_of(out)
    assert names == ["t", "obliquity", "x", "y", "z", "K"] and len(rows) == 1001
    assert "# units: t [kyr], obliquity [deg], x [1], y [1], z [1], K [deg/kyr]" in out.read_text()
    assert rows[0][1] == pytest.approx(25, rel=budgets.cli_rounding)
    for row in rows:
        assert row[5] == pytest.approx(rows[0][5], rel=budgets.own_model)
        assert row[2]**2 + row[3]**2 + row[4]**2 == pytest.approx(1, rel=budgets.own_model)
    assert any(row[1] > 37 for row in rows)  # it is not the state of Cassini
    split, out = tmp_path / "split.toml", tmp_path / "split.csv"
    split.write_text(text.replace("[time]", "[method]\nkind = 'splitting'\nstep = 5\n"
                                  "scheme = 'order8'\n[time]"))
    assert "splitting order 8, step 5" in sh(program, "run", split, "--out", out)
    for row, other in zip(rows, rows_of(out)[1], strict=True):
        assert other == pytest.approx(row, rel=budgets.own_model, abs=budgets.own_model)
    info = sh(program, "info", scenario)
    assert "period of precession at this obliquity  71.4" in info and "colombos-top" in info
    cited = sh(program, "cite", scenario)
    assert "[colombo1966]" in cited and "[jacobi1850]" not in cited
    kinds = '"enum": ["rotation", "fit", "obliquity", "nutation", "colombos-top"]'
    assert kinds in sh(program, "schema")
    template = tmp_path / "template.toml"
    template.write_text(sh(program, "init", "colombos-top"))
    sh(program, "run", template, "--out", tmp_path / "template.csv")
    head = template.read_text()[:template.read_text().index("[colombos-top]")]
    assert 'title = "The spin axis of a planet whose orbit precesses at a constant rate"' in head
    assert '\ntime = "yr"\n' in head
    assert "colombos-top]" not in sh(program, "init", "andoyer")
    for wrong, message in {
        text.replace("obliquity = 25", 'obliquity = "25 m"'): '10:13: colombos-top.obliquity: got',
        text.replace("[time]", "[body]\nmoments = [1, 2, 2]\n[time]"): "12:2: body: a key of kind",
        text.replace("[time]", "[map]\nkind = 'chaos'\n[[map.axis]]\n"
                     "key = 'colombos-top.obliquity'\nfrom = 1\nto = 2\ncount = 2\n[time]"):
            '12:1: map: kind: got "colombos-top"; expected "rotation"',
        text.replace("[time]", "[method]\nkind = 'variation-of-constants'\n[time]"):
            '13:8: method.kind: got "variation-of-constants"; expected "adaptive", "collocation" '
            'or "splitting", since kind "colombos-top"',
        text[:text.index("[time]")]: "expected a table [time] as well",
    }.items():
        (tmp_path / "wrong.toml").write_text(wrong)
        said = sh(program, "run", tmp_path / "wrong.toml", "--out", tmp_path / "no.csv", status=2)
        assert message in said, said


def test_a_run_of_an_experiment_of_your_own_is_stopped_and_continued(colombo, tmp_path):
    program, scenario = colombo / "build/colombos-top", tmp_path / "long.toml"
    text = (colombo / "planet.toml").read_text()
    scenario.write_text(text.replace("stop = 5000\n", "stop = 100000\n"))
    for extension in ("csv", "h5"):
        out, cut = tmp_path / f"whole.{extension}", tmp_path / f"cut.{extension}"
        sh(program, "run", scenario, "--out", out)
        stopped(program, scenario, cut, signal.SIGKILL)
        sh(program, "run", scenario, "--out", cut, "--resume")
        assert cut.read_bytes() == out.read_bytes()


def test_an_output_format_of_your_own_writes_resumes_and_refuses(built, root):
    source = built("output-format")
    command = ["build/fixed-width", "scenario.toml", "rows.txt"]
    assert sh(*command, cwd=source) == "3 rows in rows.txt\n"
    written = (source / "rows.txt").read_text()
    assert "! | [output.fixed]\n" in written
    shown = "".join(line for line in written.splitlines(keepends=True) if line[0] != "!")
    page = (root / "docs/extending/output-format.md").read_text()
    assert shown in page
    assert sh(*command, cwd=source) == "3 rows in rows.txt\n"  # complete: nothing to do
    assert (source / "rows.txt").read_text() == written
    text = (source / "scenario.toml").read_text().replace("digits = 6", "digits = 7")
    (source / "scenario.toml").write_text(text)
    refused = subprocess.run(command, cwd=source, text=True, capture_output=True)
    assert refused.returncode == 2
    assert "19:10: output.fixed.digits: got 7; expected 6, 9 or 17" in refused.stderr


@pytest.fixture(scope="module")
def spherical(built):
    return built("chart") / "build/spherical"


def test_a_chart_of_your_own_is_converted_and_its_bad_row_is_found(spherical, root):
    def converted(text, old, new):
        command = [spherical, "convert", "--from", old, "--to", new, "--moments", "1,2,2.5"]
        return subprocess.run(command, input=text, text=True, capture_output=True)

    given = (root / "examples/extending/chart/states.csv").read_text()
    there = converted(given, "spherical", "serret")
    assert there.returncode == 2
    assert there.stderr.startswith("<stdin>:3: andoyer_state: H = ")
    back = converted(there.stdout, "serret", "spherical")
    assert back.returncode == 0, back.stderr
    first, last = given.splitlines(), back.stdout.splitlines()
    assert last[0] == first[0] and len(last) == 2
    assert [float(x) for x in last[1].split(",")] == pytest.approx(
        [float(x) for x in first[1].split(",")], abs=budgets.cli_carried)
    assert "\n  spherical: l,g,h,log_G,cos_J,cos_I\n" in sh(spherical, "convert", "--help")


def test_a_chart_of_your_own_is_a_state_and_columns_of_a_run(spherical, root, tmp_path):
    scenario = root / "examples/extending/chart/spherical.toml"
    out, events = tmp_path / "rows.csv", tmp_path / "events.csv"
    sh(spherical, "run", scenario, "--out", out, "--events", events)
    written = out.read_text()
    shown = "".join(line for line in written.splitlines(keepends=True)
                    if line.startswith(("# units", "t,")))
    assert f"```\n{shown}```" in (root / "docs/extending/chart.md").read_text()
    rows = [line.split(",") for line in written.splitlines() if not line.startswith("#")]
    assert [float(x) for x in rows[1]] == pytest.approx([0, 70, 20, 40, 0.5, 0.9, -0.5],
                                                        rel=budgets.cli_carried)
    found = [line.split(",") for line in events.read_text().splitlines() if line[0] != "#"]
    assert float(found[1][found[0].index("cos_J")]) == pytest.approx(0.8, rel=budgets.cli_carried)
    assert "cos_J = 0.8" in sh(spherical, "info", scenario)
    assert '"log_G"' in sh(spherical, "schema")
    template = tmp_path / "template.toml"
    template.write_text(sh(spherical, "init", "spherical"))
    sh(spherical, "run", template, "--out", tmp_path / "template.csv")
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(scenario.read_text().replace("cos_J = 0.9", "cos_J = 1.9"))
    assert ":9:1: state.spherical: andoyer_state: L = " in sh(spherical, "info", wrong, status=2)


def test_columns_of_your_own_are_those_of_rows_and_events(built, root, tmp_path):
    source = built("column")
    program, scenario = source / "build/wobble", source / "wobble.toml"
    out, events = tmp_path / "rows.csv", tmp_path / "events.csv"
    sh(program, "run", scenario, "--out", out, "--events", events)
    written = out.read_text()
    shown = "".join(line for line in written.splitlines(keepends=True)
                    if line.startswith(("# units", "t,")))
    assert f"```\n{shown}```" in (root / "docs/extending/column.md").read_text()
    w, moments = (1, 30, 2), (1, 2, 2.5)
    g = [a * b for a, b in zip(w, moments, strict=True)]
    cosine = sum(a * b for a, b in zip(w, g, strict=True)) / math.hypot(*w) / math.hypot(*g)
    names, rows = rows_of(out)
    assert rows[0] == pytest.approx([0, math.hypot(*w), math.degrees(math.acos(cosine))],
                                    rel=budgets.cli_carried)
    found = [line.split(",") for line in events.read_text().splitlines() if line[0] != "#"]
    at = found[0].index("wobble_angle")
    assert len(found) > 1
    for line in found[1:]:
        assert float(line[at]) == pytest.approx(20, rel=budgets.cli_carried)
    assert '"wobble"' in sh(program, "schema")
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(scenario.read_text().replace('["wobble"]', '["wobbles"]'))
    assert 'did you mean "wobble"?' in sh(program, "info", wrong, status=2)


def test_an_observation_of_your_own_is_simulated_and_fitted(built, root, tmp_path):
    source = built("observation")
    program = source / "build/sun-angle"
    sh(program, "simulate", source / "night.toml", "--into", source)
    lines = [x for x in (source / "front.csv").read_text().splitlines() if x[0] != "#"]
    assert f"```\n{lines[0]}\n```" in (root / "docs/extending/observation.md").read_text()
    assert len(lines) == 62
    out = tmp_path / "residuals.csv"
    said = sh(program, "fit", source / "night.toml", "--residuals", out, cwd=source)
    assert "61 directions, 61 rows of sun-angle, 61 rows of sun-angle (244 numbers)" in said
    names, rows = rows_of(out)
    r = [row[names.index("r1")] for row in rows if row[names.index("table")] < 3]
    assert len(r) == 122 and 0.7 < math.sqrt(sum(x * x for x in r) / len(r)) < 1.3
    assert '"sun-angle"' in sh(program, "schema")
    assert "kind = \"sun-angle\"" in sh(program, "init", "sun-angle")
    wrong = tmp_path / "wrong.toml"
    wrong.write_text((source / "night.toml").read_text().replace("sun = [1, 0, 0]",
                                                                "sun = [0, 0, 0]"))
    assert "observation[0].sun: got [0, 0, 0]; expected a vector that is not 0" in sh(
        program, "info", wrong, status=2)


def test_pages_show_the_files_of_their_examples(root):
    # what is added from Python is a page alone, which tests/docs runs
    pages = {path.stem: path.read_text() for path in (root / "docs/extending").glob("*.md")
             if path.stem != "python"}
    assert set(pages) == {path.name for path in (root / "examples/extending").iterdir()}
    for name, page in pages.items():
        for path in (root / "examples/extending" / name).iterdir():
            lines = path.read_text().splitlines(keepends=True)
            text = "".join(line for line in lines if "SPDX" not in line)
            assert text.strip() in page, f"{path} is not what docs/extending/{name}.md shows"
