#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the diagrams of the documentation as SVG, into docs/figures.

    tools/figures/diagrams.py           draws all
    tools/figures/diagrams.py --check   draws nothing; says which differ from what this draws

A diagram is 480 units wide, its letters are 16 high and its ground is white, so that it can be read
on a phone and on a dark page. What it shows of directions is computed: a view of unit vectors."""

import html
import math
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
from layers import IO, LAYERS  # noqa: E402

FIGURES = ROOT / "docs/figures"
WIDTH = 480
# The colours of polhode.figures.
BLACK, GREY, BLUE, VERMILLION, GREEN = "#000000", "#6E6E6E", "#0072B2", "#D55E00", "#009E73"
PALE = {BLUE: "#DCEAF4", VERMILLION: "#FBE9DF", GREEN: "#DBF1EA", GREY: "#EFEFEF"}


class Drawing:
    """An SVG, element by element; y grows downwards."""

    def __init__(self, height, title):
        self.height, self.title, self.parts = height, title, []

    def add(self, tag, text="", **attributes):
        said = "".join(f' {key.replace("_", "-")}="{value}"' for key, value in attributes.items())
        end = f">{html.escape(text, quote=False)}</{tag}>" if text else "/>"
        self.parts.append(f"<{tag}{said}{end}")

    def path(self, points, color=BLACK, width=1.5, dash="", head=False, fill="none", near=True):
        """A line through points; `head` ends it in an arrow, pale what is not near."""
        d = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        more = {"stroke-dasharray": dash} if dash else {}
        more.update({} if near else {"opacity": "0.45"})
        self.add("path", d=d, fill=fill, stroke=color, **{"stroke-width": width}, **more)
        if head:
            self.head(points[-2], points[-1], color)

    def head(self, tail, tip, color):
        x, y = tip
        length = math.dist(tail, tip)
        ux, uy = (x - tail[0]) / length, (y - tail[1]) / length
        corners = [(x - 10 * ux + s * 4.5 * -uy, y - 10 * uy + s * 4.5 * ux) for s in (1, -1)]
        d = "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in [tip, *corners]) + "Z"
        self.add("path", d=d, fill=color)

    def text(self, x, y, text, color=BLACK, size=16, anchor="middle", bold=False, italic=False):
        more = {"font-weight": "bold"} if bold else {}
        more.update({"font-style": "italic"} if italic else {})
        self.add("text", text, x=f"{x:.1f}", y=f"{y:.1f}", fill=color, font_size=size,
                 text_anchor=anchor, **more)  # fmt: skip

    def box(self, x, y, width, height, lines, color=BLUE):
        self.add("rect", x=x, y=y, width=width, height=height, rx=5, fill=PALE[color],
                 stroke=color, **{"stroke-width": 1.2})  # fmt: skip
        for k, line in enumerate(lines):
            level = y + height / 2 + 5.5 + 19 * (k - (len(lines) - 1) / 2)
            self.text(x + width / 2, level, line, size=15, bold=k == 0)

    def svg(self):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self.height}" '
                f'width="{WIDTH}" height="{self.height}" role="img" '
                'font-family="Helvetica, Arial, DejaVu Sans, sans-serif">')  # fmt: skip
        note = "<!-- SPDX-License-Identifier: MIT. Drawn by tools/figures/diagrams.py. -->"
        ground = f'<rect width="{WIDTH}" height="{self.height}" rx="6" fill="#ffffff"/>'
        title = f"<title>{html.escape(self.title)}</title>"
        return "\n".join([head, note, title, ground, *self.parts, "</svg>"]) + "\n"


class View:
    """Unit vectors on paper, seen from an azimuth and a height (degrees)."""

    def __init__(self, centre, size, azimuth, height):
        a, h = math.radians(azimuth), math.radians(height)
        self.centre, self.size = centre, size
        self.right = (-math.sin(a), math.cos(a), 0.0)
        self.up = (-math.sin(h) * math.cos(a), -math.sin(h) * math.sin(a), math.cos(h))

    def paper(self, v, length=1.0):
        x, y = (sum(a * b for a, b in zip(axis, v)) for axis in (self.right, self.up))
        return (self.centre[0] + self.size * length * x, self.centre[1] - self.size * length * y)

    def arc(self, start, end, angle, radius=1.0, steps=48):
        """From one unit vector towards another at right angles to it, by an angle."""
        return [self.paper([radius * (math.cos(t) * a + math.sin(t) * b)
                            for a, b in zip(start, end)])
                for t in (angle * k / steps for k in range(steps + 1))]  # fmt: skip


def axes_of_tumbler(phi, theta, psi):
    """N, its quarter in the plane X Y, z, x, y of the 3-1-3 angles, in X, Y, Z."""
    node = (math.cos(phi), math.sin(phi), 0.0)
    ahead = (-math.sin(phi), math.cos(phi), 0.0)
    z = tuple(math.cos(theta) * k - math.sin(theta) * a for a, k in zip(ahead, (0.0, 0.0, 1.0)))
    up = tuple(math.cos(theta) * a + math.sin(theta) * k for a, k in zip(ahead, (0.0, 0.0, 1.0)))
    x = tuple(math.cos(psi) * n + math.sin(psi) * u for n, u in zip(node, up))
    y = tuple(-math.sin(psi) * n + math.cos(psi) * u for n, u in zip(node, up))
    return node, ahead, z, up, x, y


def tumbler_angles():
    drawing = Drawing(430, "The angles of a tumbler: phi, theta and psi")
    view = View((225, 245), 165, 25, 24)
    phi, theta, psi = math.radians(50), math.radians(42), math.radians(38)
    node, ahead, z, up, x, y = axes_of_tumbler(phi, theta, psi)
    X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    whole = 2 * math.pi
    drawing.path(view.arc(X, Y, whole), GREY, 1.2, fill=PALE[GREY])
    drawing.path(view.arc(node, up, math.pi), BLUE, 1.2, fill=PALE[BLUE])
    drawing.path(view.arc(node, up, -math.pi), BLUE, 1.2, dash="4 4", near=False)
    for axis, color in ((X, GREY), (Y, GREY), (Z, BLACK), (x, BLUE), (y, BLUE), (z, BLUE)):
        drawing.path([view.paper(axis, 0), view.paper(axis, 1.12)], color, 1.8, head=True)
    drawing.path([view.paper(node, 0), view.paper(node, 1.12)], VERMILLION, 1.8, "6 4", head=True)
    sideways = tuple(-a for a in ahead)  # Z turns about N towards z
    arcs = ((X, Y, phi, 0.55), (Z, sideways, theta, 0.55), (node, up, psi, 0.55))
    for start, end, angle, radius in arcs:
        drawing.path(view.arc(start, end, angle, radius), GREEN, 2.0, head=True)
    middle = [view.arc(start, end, angle, 0.7)[24] for start, end, angle, _ in arcs]
    for (a, b), name in zip(middle, ("\u03c6", "\u03b8", "\u03c8")):
        drawing.text(a, b + 5, name, GREEN, 18, italic=True)
    labels = ((Z, "Z, the momentum", BLACK, 0, -8), (z, "z, long axis", BLUE, -20, -8),
              (X, "X, due south", GREY, -6, 18), (Y, "Y", GREY, 12, 6), (x, "x", BLUE, 12, 0),
              (y, "y", BLUE, 8, -6), (node, "node N", VERMILLION, 20, 16))  # fmt: skip
    for axis, name, color, dx, dy in labels:
        a, b = view.paper(axis, 1.14)
        drawing.text(a + dx, b + dy, name, color)
    drawing.text(12, 400, "grey: the plane X, Y", GREY, 14, "start")
    drawing.text(12, 419, "blue: the body's plane x, y", BLUE, 14, "start")
    return drawing


def chain(drawing, top, names, angles, notes, color):
    """Directions in a row, with the angle from one to the next above its arrow."""
    places = [40 + 400 * k / (len(names) - 1) for k in range(len(names))]
    for place, name in zip(places, names):
        drawing.text(place, top + 5, name, color, 17, bold=True)
    for a, b, angle, note in zip(places, places[1:], angles, notes):
        drawing.path([(a + 22, top), (b - 22, top)], GREEN, 1.8, head=True)
        drawing.text((a + b) / 2, top - 9, angle, GREEN, 18, italic=True)
        for k, line in enumerate(note.split("|")):
            drawing.text((a + b) / 2, top + 23 + 17 * k, line, GREY, 14)


def andoyer_chain():
    drawing = Drawing(220, "The angles h, g, l along the planes; I and J between the normals")
    drawing.text(14, 24, "along the planes", size=14, anchor="start")
    planes = [f"in the|{what}" for what in ("reference plane", "invariable plane", "body equator")]
    chain(drawing, 60, ("s1", "i", "j", "b1"), "hgl", planes, BLUE)
    drawing.text(14, 136, "between the normals", size=14, anchor="start")
    chain(drawing, 172, ("s3", "G", "b3"), "IJ", ("about i", "about j"), BLUE)
    return drawing


def tumbler_chain():
    drawing = Drawing(196, "phi and psi along the planes, theta between the normals")
    drawing.text(14, 24, "along the planes", size=14, anchor="start")
    chain(drawing, 60, ("X", "N", "x"), ("\u03c6", "\u03c8"),
          ("in the plane X, Y", "in the plane x, y"), BLUE)  # fmt: skip
    drawing.text(14, 118, "between the normals", size=14, anchor="start")
    chain(drawing, 154, ("Z", "z"), "\u03b8", ("about N",), BLUE)
    return drawing


def andoyer_triangle():
    drawing = Drawing(340, "The spherical triangle of Andoyer's and Euler's angles")
    i, n, j = (110, 265), (330, 265), (352, 138)
    drawing.path([(20, 265), (460, 265)], GREY, 1.8)
    drawing.text(464, 256, "reference plane", GREY, 14, "end")
    # A great circle is drawn as a curve: through i and j it bends upwards.
    bow = [(i[0] + (j[0] - i[0]) * t, i[1] + (j[1] - i[1]) * t - 24 * math.sin(math.pi * t))
           for t in (k / 40 for k in range(-4, 45))]  # fmt: skip
    drawing.path(bow, VERMILLION, 1.8)
    drawing.text(150, 160, "invariable plane", VERMILLION, 14)
    body = [(n[0] + (j[0] - n[0]) * t + 10 * math.sin(math.pi * t),
             n[1] + (j[1] - n[1]) * t) for t in (k / 40 for k in range(-14, 69))]  # fmt: skip
    drawing.path(body, BLUE, 1.8, head=True)
    drawing.text(306, 326, "body equator", BLUE, 14, "end")
    for (x, y), name, dx, dy in ((i, "i", -12, 22), (n, "n", 14, 22), (j, "j", 16, 8)):
        drawing.add("circle", cx=x, cy=y, r=4, fill=BLACK)
        drawing.text(x + dx, y + dy, name, size=17, bold=True)
    drawing.text(26, 255, "s1", GREY, 17, bold=True)
    drawing.text(body[-1][0] + 18, body[-1][1] + 8, "b1", BLUE, 17, bold=True)
    for x, y, name in ((66, 257, "h"), (222, 287, "\u03c6 \u2212 h"), (222, 168, "g"),
                       (386, 206, "\u03c8 \u2212 l"), (386, 90, "l")):  # fmt: skip
        drawing.text(x, y, name, GREEN, 18, italic=True)
    for x, y, name in ((156, 253, "I"), (294, 253, "\u03c0 \u2212 \u03b8"), (336, 176, "J")):
        drawing.text(x, y, name, BLACK, 17, italic=True)
    drawing.text(14, 24, "green: sides; black: angles at the corners", GREY, 14, "start")
    return drawing


def data_flow():
    drawing = Drawing(560, "How a scenario becomes results")

    def down(x, a, b, said=""):
        drawing.path([(x, a), (x, b)], BLACK, 1.5, head=True)
        drawing.text(x + 10, (a + b) / 2 + 4, said, GREY, 14, "start") if said else None

    drawing.box(120, 15, 240, 34, ["scenario.toml"], GREY)
    down(240, 49, 80, "read: units, keys, mistakes")
    drawing.box(120, 80, 240, 34, ["Document"], GREY)
    down(240, 114, 145, "build")
    drawing.box(40, 145, 400, 54, ["Experiment", "rotation, map, obliquity, nutation, yours"])
    down(130, 199, 240)
    down(350, 199, 240)
    drawing.box(20, 240, 210, 73, ["FreeRotation", "no terms, inertial axes:", "exact at any t"],
                GREEN)  # fmt: skip
    drawing.box(250, 240, 210, 73, ["integrate()", "any System: body, frame,", "terms; any state"],
                GREEN)  # fmt: skip
    down(130, 313, 354, "rows")
    down(350, 313, 354, "blocks of rows")
    drawing.box(40, 354, 400, 34, ["Sink"])
    down(130, 388, 429)
    down(350, 388, 429)
    drawing.box(20, 429, 210, 54, ["Trajectory", "in memory; at(t)"], VERMILLION)
    drawing.box(250, 429, 210, 54, [".csv  .h5  .aem", "on disk"], VERMILLION)
    down(130, 483, 510)
    down(350, 483, 510)
    drawing.box(20, 510, 440, 34, ["polhode.figures"], GREY)
    return drawing


TARGETS = (
    ("polhode::polhode", BLUE, "no library but the standard one"),
    ("polhode::ephemeris", GREEN, "ERFA"),
    ("polhode::ensemble", GREEN, "oneTBB"),
    ("polhode::fit", GREEN, "Eigen (headers)"),
    ("polhode::mpi", GREEN, "MPI"),
    ("polhode::io", VERMILLION, "HDF5, UDUNITS-2, toml++, fmt"),
    ("polhode::cli", GREY, "CLI11"),
)


def target_of(layer):
    if layer in ("ephemeris", "ensemble", "fit", "mpi", "cli"):
        return f"polhode::{layer}"
    return "polhode::io" if layer in IO else "polhode::polhode"


def depths():
    """Layer -> how many layers it stands above math."""
    found = {}
    for layer, below in LAYERS.items():
        names = [name for name in found if below == "*" or name in below.split()]
        found[layer] = 1 + max((found[name] for name in names), default=-1)
    return found


def layers():
    """The table of tools/layers.py: each layer above those that it includes."""
    rows = {}
    for layer, depth in depths().items():
        rows.setdefault(depth, []).append(layer)
    colors = {name: color for name, color, _ in TARGETS}
    top = 14 + 42 * len(rows)
    drawing = Drawing(top + 20 * len(TARGETS) + 30, "The layers of polhode")
    for depth, names in rows.items():
        width = min(104, (WIDTH - 20) / len(names) - 8)
        left = (WIDTH - len(names) * (width + 8) + 8) / 2
        for k, name in enumerate(names):
            drawing.box(round(left + k * (width + 8), 1), top - 42 * (depth + 1), round(width, 1),
                        32, [name], colors[target_of(name)])  # fmt: skip
    for k, (name, color, needs) in enumerate(TARGETS):
        y = top + 18 + 20 * k
        drawing.add("rect", x=20, y=y - 11, width=14, height=14, fill=PALE[color], stroke=color)
        drawing.text(42, y + 1, f"{name}: {needs}", size=14, anchor="start")
    return drawing


DIAGRAMS = {
    "tumbler_angles": tumbler_angles, "tumbler_chain": tumbler_chain,
    "andoyer_chain": andoyer_chain, "andoyer_triangle": andoyer_triangle, "data_flow": data_flow,
    "layers": layers,
}  # fmt: skip


def stale():
    """The diagrams of docs/figures that this would draw otherwise."""
    drawn = {FIGURES / f"{name}.svg": draw().svg() for name, draw in DIAGRAMS.items()}
    return {path: svg for path, svg in drawn.items()
            if not path.exists() or path.read_text(encoding="utf-8") != svg}  # fmt: skip


def main():
    check = sys.argv[1:] == ["--check"]
    for path, svg in stale().items():
        if check:
            print(f"{path.relative_to(ROOT)} is stale: tools/figures/diagrams.py")
        else:
            path.write_text(svg, encoding="utf-8")
    return 1 if check and stale() else 0


if __name__ == "__main__":
    sys.exit(main())
