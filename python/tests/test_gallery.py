# SPDX-License-Identifier: MIT
"""The gallery: every script runs and draws what numbers from elsewhere say, the page is what the
scripts say, and so is the table of the comparison with MuJoCo."""

import math
import os
import pathlib
import re
import sys

import budgets
import gallery_values
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pytest
from closeness import largest, smallest
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/figures"))
import gallery  # noqa: E402

NAMES = [name for names in gallery.SECTIONS.values() for name in names]
FULL = bool(os.environ.get("POLHODE_TEST_FULL"))
NUMBER = re.compile(r"[-+]?\d\.\de[-+]\d\d")
ROUNDED = 20.0
"""Errors of RK4 are rounding, grown or not: between machines they differ by less than this."""


THINNED = {
    "chaos_map": {"3.0, 30)": "3.0, 5)", "/ 2, 25)": "/ 2, 4)"},
    "chaotic_zones": {"count = 19": "count = 3", "count = 25": "count = 3", "-20000": "-2000"},
    "mean_rotation": {"0.8, 7)": "0.8, 2)"},
    "obliquity_spectrum": {"-20001": "-4001"},
    "posterior_corner": {"draws=500, warm_up=200": "draws=100, warm_up=50"},
}
"""Scripts of 10 s and more: how make test shortens them. They run as they are in make test-full."""


@pytest.mark.filterwarnings("ignore:posterior. the draws have not converged")
@pytest.mark.parametrize("name", NAMES)
def test_a_script_draws_its_picture(name, tmp_path, monkeypatch):
    if name == "mujoco_drift":
        pytest.importorskip("mujoco")
    before, made = dict(matplotlib.rcParams), {}

    def run(path):
        text = pathlib.Path(path).read_text(encoding="utf-8")
        for written, read in () if FULL else THINNED.get(name, {}).items():
            assert text.count(written) == 1
            text = text.replace(written, read)
        exec(compile(text, path, "exec"), made)

    monkeypatch.setattr(gallery.runpy, "run_path", run)
    printed = gallery.draw(name, tmp_path)
    assert dict(matplotlib.rcParams) == before
    drawn = tmp_path / gallery.picture(name).name
    assert list(tmp_path.iterdir()) == [drawn]
    with Image.open(drawn) as image, Image.open(gallery.picture(name)) as committed:
        assert image.size == committed.size
        assert getattr(image, "n_frames", 1) == getattr(committed, "n_frames", 1)
    if name in gallery_values.CHECKS:
        drawn_into = [ax for number in plt.get_fignums() for ax in plt.figure(number).axes]
        gallery_values.CHECKS[name](drawn_into, made)
    assert bool(printed) == bool(gallery.places(name))
    for page in gallery.places(name):
        compare(printed, between_marks(page, name))


def between_marks(page, name):
    _, _, rest = page.read_text(encoding="utf-8").partition(gallery.MARK.format(name=name))
    return rest[: rest.index(gallery.END)]


def compare(printed, shown):
    """The same rows; numbers to a unit of their last digit, however small, but for RK4's, which are
    rounding: these are not ROUNDED times larger."""
    rows = [
        [line for line in text.splitlines() if line.startswith("|")] for text in (printed, shown)
    ]
    assert len(rows[0]) == len(rows[1]) > 2
    for now, then in zip(*rows):
        assert NUMBER.sub("#", now) == NUMBER.sub("#", then)
        for a, b in zip(map(float, NUMBER.findall(now)), map(float, NUMBER.findall(then))):
            unit = 10.0 ** (math.floor(math.log10(abs(b))) - 1)
            if "| RK4 |" in then:
                assert abs(a) <= ROUNDED * abs(b), now
            else:
                assert abs(a - b) <= unit * (1 + budgets.numpy_formula), now


def test_a_wrong_number_of_a_table_is_seen():
    table = "| case | by | energy |\n|---|---|---|\n| sam | {} | {} |\n"
    for size in ("-03", "-09"):
        right = table.format("Euler", "+1.3e" + size)
        compare(table.format("Euler", "+1.2e" + size), right)
        for wrong in ("+1.5e" + size, "+1.1e" + size, "-1.3e" + size, "+1.3e-02", "+nane" + size):
            with pytest.raises(AssertionError):
                compare(table.format("Euler", wrong), right)
    compare(table.format("RK4", "+1.0e-13"), table.format("RK4", "-7.0e-15"))
    with pytest.raises(AssertionError):
        compare(table.format("RK4", "+1.0e-12"), table.format("RK4", "-7.0e-15"))


def test_the_table_says_what_the_page_concludes():
    """First order for Euler and implicit, signs of their energy, RK4 near rounding."""
    text = between_marks(gallery.SCRIPTS / "mujoco.md", "mujoco_drift")
    rows = [
        line.strip("| ").split(" | ") for line in text.splitlines() if "e-" in line and "|" in line
    ]
    error = {(r[0], r[1], float(r[2])): [float(x) for x in r[3:]] for r in rows}
    assert len(error) == 18
    for case in ("sam", "near-b2"):
        for integrator, sign in (("Euler", 1.0), ("implicit", -1.0)):
            fine, finer = (error[case, integrator, step] for step in (0.002, 0.001))
            assert all(1.8 < a / b < 2.2 for a, b in zip(fine, finer))
            assert all(error[case, integrator, step][2] * sign > 0 for step in (0.01, 0.002, 0.001))
    assert error["sam", "Euler", 0.01][1] > 1.0
    assert largest(abs(x) for x in error["sam", "RK4", 0.01]) < budgets.documents_rounding
    unstable = [error["near-b2", "RK4", step][1] for step in (0.01, 0.002, 0.001)]
    assert smallest(unstable) > budgets.documents_rounding
    assert largest(unstable) < 10.0 * smallest(unstable)


def test_the_page_fits_the_scripts():
    assert gallery.errors() == []


def test_what_does_not_fit_is_said(tmp_path, monkeypatch, capsys):
    scripts, figures = tmp_path / "gallery", tmp_path / "figures"
    scripts.mkdir()
    figures.mkdir()
    monkeypatch.setattr(gallery, "ROOT", tmp_path)
    monkeypatch.setattr(gallery, "SCRIPTS", scripts)
    monkeypatch.setattr(gallery, "FIGURES", figures)
    monkeypatch.setattr(gallery, "PAGE", scripts / "index.md")
    monkeypatch.setattr(gallery, "SECTIONS", {"One": ["dot"]})
    monkeypatch.setattr(gallery, "OTHERS", {})
    assert gallery.errors() == ["docs/gallery/dot.py is missing"]
    script = (
        '"""A dot\n\nIn the middle."""\n\nprint("| 1 |")\nopen("dot.png", "wb").write(bytes(24))\n'
    )
    (scripts / "dot.py").write_text(script, encoding="utf-8")
    (scripts / "stray.py").write_text(script, encoding="utf-8")
    assert gallery.errors() == ["docs/gallery/stray.py: in no section of tools/figures/gallery.py"]
    (scripts / "stray.py").unlink()
    assert [text.split(" ")[1:3] for text in gallery.errors()] == [
        ["is", "missing:"],
        ["does", "not"],
    ]
    place = f"a\n{gallery.MARK.format(name='dot')}\nold\n{gallery.END}\nb\n"
    (scripts / "other.md").write_text(place, encoding="utf-8")
    monkeypatch.setattr(sys, "argv", ["gallery.py", "dot"])
    assert gallery.main() == 0 and gallery.errors() == []
    page = (scripts / "index.md").read_text(encoding="utf-8")
    assert "[![A dot](../figures/dot.png)](dot.py)" in page and "\ndot\n" in page
    assert "\n| 1 |\n" in (scripts / "other.md").read_text(encoding="utf-8")
    assert (scripts / "other.md").read_text(encoding="utf-8").endswith(f"{gallery.END}\nb\n")
    (scripts / "dot.py").write_text(script.replace("A dot", "A spot"), encoding="utf-8")
    monkeypatch.setattr(sys, "argv", ["gallery.py", "--check"])
    capsys.readouterr()
    assert gallery.main() == 1 and "does not fit the scripts" in capsys.readouterr().out


def test_a_script_without_a_caption_or_picture_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(gallery, "SCRIPTS", tmp_path)
    monkeypatch.setattr(gallery, "ROOT", tmp_path)
    (tmp_path / "bare.py").write_text("x = 1\n", encoding="utf-8")
    with pytest.raises(SystemExit, match="no docstring: it is the caption"):
        gallery.described("bare")
    (tmp_path / "bare.py").write_text('"""Title."""\nx = 1\n', encoding="utf-8")
    with pytest.raises(SystemExit, match=r'expected to save "bare\.png" or \.gif'):
        gallery.picture("bare")
