# SPDX-License-Identifier: MIT
"""The gallery: every script runs and draws, the page is what the scripts say, and so is the table
of the comparison with MuJoCo."""

import pathlib
import re
import sys

import budgets
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
NUMBER = re.compile(r"[-+]?\d\.\de[-+]\d\d")
ROUNDING = 1e-5
"""Errors of the table below this are rounding, grown or not: they differ between machines."""


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


@pytest.mark.parametrize("name", NAMES)
def test_a_script_draws_its_picture(name, tmp_path):
    if name == "mujoco_drift":
        pytest.importorskip("mujoco")
    before = dict(matplotlib.rcParams)
    printed = gallery.draw(name, tmp_path)
    assert dict(matplotlib.rcParams) == before
    drawn = tmp_path / gallery.picture(name).name
    assert list(tmp_path.iterdir()) == [drawn]
    with Image.open(drawn) as image, Image.open(gallery.picture(name)) as committed:
        assert image.size == committed.size
        assert getattr(image, "n_frames", 1) == getattr(committed, "n_frames", 1)
    assert bool(printed) == bool(gallery.places(name))
    for page in gallery.places(name):
        compare(printed, between_marks(page, name))


def between_marks(page, name):
    _, _, rest = page.read_text(encoding="utf-8").partition(gallery.MARK.format(name=name))
    return rest[: rest.index(gallery.END)]


def compare(printed, shown):
    """The same rows; numbers beyond rounding within 10 %."""
    rows = [
        [line for line in text.splitlines() if line.startswith("|")] for text in (printed, shown)
    ]
    assert len(rows[0]) == len(rows[1]) > 2
    for now, then in zip(*rows):
        assert NUMBER.sub("#", now) == NUMBER.sub("#", then)
        for a, b in zip(map(float, NUMBER.findall(now)), map(float, NUMBER.findall(then))):
            assert abs(a - b) <= 0.1 * abs(b) or max(abs(a), abs(b)) < ROUNDING, now


def test_a_wrong_number_of_a_table_is_seen():
    table = "| case | energy |\n|---|---|\n| sam | {} |\n"
    compare(table.format("+1.0e-03"), table.format("+1.1e-03"))
    compare(table.format("+1.0e-13"), table.format("-7.0e-15"))
    for wrong in ("+1.3e-03", "-1.0e-03"):
        with pytest.raises(AssertionError):
            compare(table.format("+1.0e-03"), table.format(wrong))


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
    assert "### A dot\n" in page and "\nIn the middle.\n" in page and '\nprint("| 1 |")\n' in page
    assert "\n| 1 |\n" in (scripts / "other.md").read_text(encoding="utf-8")
    assert (scripts / "other.md").read_text(encoding="utf-8").endswith(f"{gallery.END}\nb\n")
    (scripts / "dot.py").write_text(script.replace("middle", "centre"), encoding="utf-8")
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
