#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes docs/accuracy/peers.md and its figure from what `make bench-peers` left in build/bench.

    .venv/bin/python benchmarks/peers/page.py [FOLDER]
"""

import json
import pathlib
import re
import sys
import textwrap

from goals import table as goals_table
from records import matched

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/accuracy/peers.md"
FIGURE = ROOT / "docs/figures/peers_work_precision.png"
# What stands in a section of its own, in this order: title, what is measured, goals.
SECTIONS = (
    ("One body, many times", """\
States (quaternion and angular velocity) at 1024 random times up to 10 000 turns, or on an
even grid, in cache; a call for each time (G4); and a million even times into memory, beside stores
that compute nothing. polhode's even grid gives the momentum in place of the angular velocity.
Bodies, phases and times are drawn by the seed; k is the modulus, 1 on the separatrix, and a line
goes from k = 0.05 to 1 - 1e-9. The error is the largest component of the quaternion between the
attitude and that of the textbook form at 50 digits, over 64 times.""", ("G1", "G2", "G4")),
    ("A new body", """\
Preparation (G5), a state of a new body each with random moments and momenta (G12), and
Sadov's variables of the state of a new body, and of many states of one (G6; error of the action,
over G). A textbook form prepares its complete integrals; polhode's propagate takes bodies, states
and times and prepares nothing that can be kept. The authors' own code of van Zon and Schofield
prepared a body in 175 to 255 ns and a first state in 281 ns on such a machine; the restatement is
not tuned for that.""", ("G5", "G12", "G6")),
    ("Elliptic functions", """\
sn, cn and dn (G7, largest error of the three), K, Pi and Heuman's lambda (G8, relative error)
of a modulus whose complement is given, from 1 - m = 0.75 to 2e-9: each library gets it in the form
that it takes, so that those that take k or m lose the digits of 1 - m.""", ("G7", "G8")),
    ("Perturbed rotation", """\
W1: a body of moments 0.9, 1, 1.1 tumbles under the gravity gradient on an orbit of e = 0.1
for 1000 turns of the orbit, 62 000 rad. The error is the last attitude's angle from that of
an 80-bit Taylor integration (heyoka at a tolerance of 1e-19; polhode in double-double agrees
to 1e-13 rad). Times are those of the integration: compilation is apart. polhode takes its
list of terms and any orbit; the others get eleven equations. Variants start at rates that
differ by up to 1e-3. Batches have eight times the same start. Three other bodies go through 300
orbits: one with moments of mass of degree 3 and e = 0.3, one with a magnetic moment in the field of
a tilted dipole, and one in sunlight that a planet eclipses: heyoka has an integrator each for
light, penumbra and umbra, and is told when which begins, which polhode finds in the run.""",
     ("G9", "G10")),
    ("Ensembles", """\
64 variants of W1, each to its end, as users run them: `polhode ensemble` of a table of starts
(`keep = "final"`), with the start of the program and its files, heyoka's
`ensemble_propagate_until` and its batch, and a loop over SciPy. Time is that of a member, on one
thread; the error is the median over eight of them.""", ("ensemble",)),
    ("Envisat, a year", """\
[The example](../examples/envisat.md), gravity gradient and eddy currents on an orbit that
precesses, 1.4 million rad, beside heyoka with the same equations written by hand; the error is the
angle from its end in 80 bits. More methods are on [a page of their own](envisat.md).""",
     ("G14",)),
    ("Steps of a simulator", """\
The free rotation of one body over 100 turns by MuJoCo, at steps of its own (a power of two each),
beside the closed form and polhode's integrator. The error is the largest component of the
quaternion between the last attitude and that of the textbook form at 50 digits.""", ("steps",)),
    ("The spin axis over ages", """\
The axis of an Earth-like planet over 100 Myr on an orbit that is given as a series, averaged
over rotation and orbit; time for a body and a million years. The error is the distance of the
last axis from that of an 80-bit integration. snvec, which needs a file of orbits, took 19 ms on
another machine.""", ("G11",)),
    ("Output", """\
2^18 states of 8 numbers into a file in the page cache: HDF5 in data sets of 1, 4 and 3 columns,
in chunks of 1024 rows, as runs write them; CSV of the shortest numbers that read back to the
same.""", ("G13",)),
)
# What the cases of a section differ by, and a line of a table is for all of them.
ALIKE = re.compile(r"(, )?(k|1 - m) = [-0-9e. ]+(, (?=from))?")


def number(x, digits=3):
    if x is None:
        return ""
    text = f"{x:.{digits}g}"
    return f"{x:.0f}" if 100 <= abs(x) < 1e6 else text


def duration(value, unit):
    if unit == "s" and value < 0.1:
        return f"{number(1e3 * value)} ms"
    if unit == "ns" and value >= 1e4:
        return f"{number(1e-3 * value)} us"
    return f"{number(value)} {unit}"


def error(x):
    return "" if x is None else "0" if x == 0 else f"{x:.1e}"


def span(values, text):
    """From the smallest to the largest, where they read otherwise."""
    ordered = sorted(values)
    low, high = text(ordered[0]), text(ordered[-1])
    if low == high:
        return low
    number_, unit = low.split(" ") if " " in low else (low, "")
    return f"{number_} to {high}" if unit and high.endswith(" " + unit) else f"{low} to {high}"


def worst(errors):
    known = sorted(e for e in errors if e is not None)
    return error(known[-1]) if known else ""


def table(rows):
    """One line for each peer and kind of case; polhode's own stands beside it."""
    yield "| goal, case | peer | its time | its error | polhode | time | error | times as fast |"
    yield "|---|---|---|---|---|---|---|---|"
    alike = {}
    for r in rows:
        case = ALIKE.sub("", r["case"]).strip(", ")
        alike.setdefault((r["goal"], case, r["peer"], r["method"]), []).append(r)
    for (goal, case, peer, method), some in alike.items():
        def times(side, some=some):
            return span([r[side] for r in some], lambda x: duration(x, some[0]["unit"]))
        ratio = span([r["ratio"] for r in some], lambda x: number(x, 2))
        ratio = ratio if all(r["ratio"] >= 1 for r in some) else f"**{ratio}**"
        yield (f"| {goal}{', ' if case else ''}{case} | {peer} | {times('theirs')} | "
               f"{worst(r['their_error'] for r in some)} | {method.removeprefix('polhode ')} | "
               f"{times('ours')} | {worst(r['our_error'] for r in some)} | {ratio} |")


def fastest(records):
    """One record for a case and a peer, by the rule of `matched`."""
    groups = {}
    for r in records:
        groups.setdefault((r["goal"], r["case"], r["peer"]), []).append(r)
    return [group[matched([(r["ours"], r["our_error"]) for r in group], group[0]["their_error"])]
            for group in groups.values()]


def figure(curves, path):
    import matplotlib
    matplotlib.use("agg")
    from matplotlib import pyplot, ticker
    names = [n for n in curves if curves[n].get("points")]
    if not names:
        return
    rows = (len(names) + 1) // 2
    picture, axes = pyplot.subplots(rows, 2, figsize=(11, 4.4 * rows + 0.8), squeeze=False,
                                    layout="constrained")
    colours, handles = {True: {}, False: {}}, {}
    for spare in axes.flat[len(names):]:
        spare.set_axis_off()
    for ax, name in zip(axes.flat, names, strict=False):
        groups = {}
        for p in curves[name]["points"]:
            groups.setdefault(p["who"], []).append((p["seconds"], p["error"]))
        for who, points in groups.items():
            ours = who.startswith("polhode")
            own, style, palette = colours[ours], *(("o-", "tab10") if ours else ("s--", "Dark2"))
            colour = own.setdefault(who, pyplot.get_cmap(palette)(len(own)))
            handles[who], = ax.loglog(*zip(*sorted(points), strict=True), style, ms=4, lw=1.2,
                                      color=colour, label=who)
        ax.set(title=name, xlabel=curves[name].get("unit", "CPU time (s)"), ylabel="error (rad)")
        # Labels that do not meet, and stand where a panel has less than two decades.
        ax.xaxis.set_minor_locator(ticker.LogLocator(subs=(2.0, 5.0)))
        ax.xaxis.set_minor_formatter(ticker.LogFormatterSciNotation(minor_thresholds=(2, 2)))
        ax.grid(alpha=0.3)
    picture.legend(handles=list(handles.values()), loc="outside lower center", ncols=4)
    path.parent.mkdir(parents=True, exist_ok=True)
    pyplot.savefig(path, dpi=110)


def slower(records):
    """Where polhode loses by more than 5 %, goal by goal, in words."""
    lost = {}
    for r in fastest(records):
        if r["ratio"] < 0.95:
            lost.setdefault(r["goal"], {}).setdefault(r["peer"], []).append(1 / r["ratio"])
    for goal, peers in lost.items():
        said = []
        for peer, times in peers.items():
            low, high = number(sorted(times)[0], 2), number(sorted(times)[-1], 2)
            said.append(f"{peer} ({low if low == high else f'{low} to {high}'} times)")
        yield from textwrap.wrap(f"- {goal}: {', '.join(said)}.", 100, subsequent_indent="  ")


def largest_errors(variants):
    """Over the variants of W1, of each contender."""
    if variants:
        said = [f"{same[0]['who']} {error(sorted(p['error'] for p in same)[-1])}"
                for same in zip(*variants, strict=True)]
        yield ""
        yield from textwrap.wrap(f"Largest errors over the {len(variants)} variants (rad): "
                                 f"{', '.join(said)}.", 100)


def page(records, machine, curves, measured=()):
    versions = ", ".join(f"{n} {v}" for n, v in machine["versions"].items() if v)
    yield "# Beside other programs"
    yield ""
    yield from textwrap.wrap(
        "`benchmarks/peers/page.py` wrote this page from one run of `make bench-peers`: the same "
        "work by polhode and by others, each repetition in turn, CPU time of one thread, medians. "
        "A peer stands beside the fastest of polhode's methods whose error is at most three times "
        "as large, or else the most accurate. Bold ratio: polhode is the slower one.", 100)
    yield ""
    cpu = machine["cpu"]
    yield from textwrap.wrap(
        f"Revision {machine['revision']}, `{machine['command']}`; {cpu['model']} with "
        f"{', '.join(cpu['sets'])}, {machine['cores']} cores; {machine['system']}, "
        f"{machine['compiler']}; {versions}. The machine was shared: the load was "
        f"{machine['load']:.1f}. Peers were compiled with -O3 -march=native, polhode as it is "
        "shipped.", 100)
    if machine["missing"]:
        yield ""
        yield from textwrap.wrap("Not measured: " + "; ".join(machine["missing"]) + ".", 100)
    if measured:
        yield ""
        yield "## The goals"
        yield ""
        yield from textwrap.wrap(
            "As they were set, whichever are met; where a goal has several cases, from the lowest "
            "to the highest. Times are those of this machine in this run.", 100)
        yield ""
        yield from goals_table(measured)
        yield ""
        yield ("What stands in the way of the others: "
               "[design note 0042](../design/0042-goals-not-met.md).")
    lost = list(slower(records))
    if lost:
        yield ""
        yield "## Where polhode is slower"
        yield ""
        yield ("By how many times; the cases and the errors are in the tables.")
        yield ""
        yield from lost
    for title, text, goals in SECTIONS:
        rows = [r for r in fastest(records) if r["goal"] in goals]
        if not rows:
            continue
        yield ""
        yield f"## {title}"
        yield ""
        yield from textwrap.wrap(" ".join(text.split()), 100)
        yield ""
        if title == "Perturbed rotation":
            yield "![Error beside CPU time of every method](../figures/" + FIGURE.name + ")"
            yield ""
            yield from textwrap.wrap(
                "heyoka compiles its equations once for each integrator, in seconds, and keeps "
                "them on the disk; that is not in its times.", 100)
            yield ""
        yield from table(rows)
        if title == "Perturbed rotation":
            yield from largest_errors(curves.get("W1", {}).get("variants"))


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/bench"
    records, machine, curves, measured = (
        json.loads((folder / f"{name}.json").read_text())
        for name in ("peers", "machine", "curves", "measured"))
    figure(curves, FIGURE)
    PAGE.write_text("\n".join(page(records, machine, curves, measured)) + "\n")


if __name__ == "__main__":
    main()
