# SPDX-License-Identifier: MIT
"""The goals of polhode's speed, and what the medians of one run (measured.json) say of each."""

import dataclasses
from collections.abc import Callable

GRID, LANES = "polhode FreeRotation, even grid", "polhode FreeRotation, many times at once"
ONE, BODIES = "polhode FreeRotation", "polhode propagate, many bodies at once"
DEFAULT, TIGHTEST = "polhode Collocation, default", "heyoka, 2.2e-16"
SADOV = "polhode to_sadov, many states at once"
BOOST, GEOGRAPHIC = "Boost.Math, textbook form", "GeographicLib, textbook form"
VAN_ZON = "van Zon and Schofield, restated"
MILLION, AGES = "a million, within 100 turns", "a million within 1e9 turns"


class Medians:
    def __init__(self, entries):
        self.entries = entries

    def of(self, goal, who, case=""):
        """Those of a contender, whose name is whole or ends in an ellipsis."""
        def is_it(name):
            return name.startswith(who[:-3]) if who.endswith("...") else name == who
        return [e for e in self.entries
                if e["goal"] == goal and is_it(e["who"]) and e["case"].startswith(case)]


def ratios(goal, ours, theirs, case=""):
    """How many times as fast as a peer, in each case that both have."""
    def found(medians):
        mine = {e["case"]: e["value"] for e in medians.of(goal, ours, case)}
        return [e["value"] / mine[e["case"]] for e in medians.of(goal, theirs, case)
                if e["case"] in mine]
    return found


def between(goal, ours, case, theirs, other):
    """The same of two cases."""
    def found(medians):
        return [b["value"] / a["value"] for a in medians.of(goal, ours, case)
                for b in medians.of(goal, theirs, other)]
    return found


def numbers(field, goal, who, case="", times=1.0):
    def found(medians):
        return [e[field] * times for e in medians.of(goal, who, case) if e[field] is not None]
    return found


def quickest(goal, who, largest, times=1.0):
    """The least time of the settings that err so little."""
    def found(medians):
        return sorted(e["value"] * times for e in medians.of(goal, who)
                      if e["error"] is not None and e["error"] <= largest)[:1]
    return found


@dataclasses.dataclass(frozen=True)
class Goal:
    name: str
    asked: str
    found: Callable
    least: float = 0.0
    most: float = float("inf")
    unit: str = ""

    def line(self, medians):
        """What was found, in words, and whether it is enough."""
        values = sorted(self.found(medians))
        if not values:
            return "not measured", ""
        low, high = (f"{v:.1e}" if v < 1e-3 else f"{v:.2g}" if v < 100 else f"{v:.0f}"
                     for v in (values[0], values[-1]))
        text = low if low == high else f"{low} to {high}"
        met = self.least <= values[0] and values[-1] <= self.most
        return f"{text} {self.unit}".strip(), "yes" if met else "no"


def beside_heyoka(case):
    """By the default where it errs no more than three times as much, or else by what does."""
    def found(medians):
        for theirs in medians.of("G9", TIGHTEST, case):
            close = [e for e in medians.of("G9", "polhode...", theirs["case"])
                     if e["error"] <= 3 * theirs["error"] and "integrate_many" not in e["who"]]
            default = [e for e in close if e["who"] == DEFAULT]
            for ours in default or sorted(close, key=lambda e: e["value"])[:1]:
                yield theirs["value"] / ours["value"]
    return found


def beside_at_equal_error(goal, theirs):
    """By the quickest setting that errs no more than three times as much."""
    def found(medians):
        for peer in medians.of(goal, theirs):
            close = [e["value"] for e in medians.of(goal, "polhode...", peer["case"])
                     if e["error"] <= 3 * peer["error"]]
            yield from (peer["value"] / t for t in sorted(close)[:1])
    return found


GOALS = (
    Goal("G1", "many times at once, 1300 times as fast as Boost.Math",
         ratios("G1", LANES, BOOST), 1300),
    Goal("G1", "100 times as GeographicLib", ratios("G1", LANES, GEOGRAPHIC), 100),
    Goal("G1", "35 times as van Zon and Schofield", ratios("G1", LANES, VAN_ZON), 35),
    Goal("G1", "AVX2 within 2.5 times the time of all lanes",
         ratios("G1", LANES, LANES + ", AVX2"), most=2.5),
    Goal("G2", "an even grid into memory, at 0.8 of the speed of streaming stores",
         ratios("G2", GRID, "streaming stores of 56 bytes"), 0.8),
    Goal("G3", "quaternions within 5e-16 after 1e4 turns", numbers("error", "G1", LANES),
         most=5e-16),
    Goal("G3", "within 1e-15 after 1e9", numbers("error", "G3", LANES), most=1e-15),
    Goal("G4", "one state, 10 times as fast as GeographicLib", ratios("G4", ONE, GEOGRAPHIC), 10),
    Goal("G5", "a new body of many, prepared: 22 ns (and asked once)",
         numbers("value", "G12", BODIES, "any mode"), most=22, unit="ns"),
    Goal("G5", "one new body: 300 ns", numbers("value", "G5", ONE, "k ="), most=300, unit="ns"),
    Goal("G6", "Sadov's variables of many states: 30 ns", numbers("value", "G6", SADOV), most=30,
         unit="ns"),
    Goal("G6", "20 times as fast as GeographicLib", ratios("G6", SADOV, GEOGRAPHIC), 20),
    Goal("G6", "of one state: 200 ns", numbers("value", "G6", "polhode to_sadov"), most=200,
         unit="ns"),
    Goal("G7", "sn, cn, dn, 20 times as fast as GeographicLib",
         ratios("G7", "polhode jacobi, many at once", "GeographicLib"), 20),
    Goal("G8", "K, Pi and Heuman's lambda within 1e-15, to 1 - m = 2e-9",
         numbers("error", "G8", "polhode"), most=1e-15),
    Goal("G9", "W1, 8 times as fast as heyoka, at an error up to three times its own",
         beside_heyoka("W1"), 8),
    Goal("G9", "e = 0.3, gravity to degree 3", beside_heyoka("e = 0.3"), 8),
    Goal("G9", "a tilted dipole", beside_heyoka("tilted"), 8),
    Goal("G9", "sunlight with a cone of shadow", beside_heyoka("sunlight"), 8),
    Goal("G10", "variants of W1, median error 3e-11", numbers("error", "G10", DEFAULT), most=3e-11,
         unit="rad"),
    Goal("G10", "the largest 1.5e-10", numbers("largest", "G10", DEFAULT), most=1.5e-10,
         unit="rad"),
    Goal("G10", "a body of eight, 2.5 times as fast as heyoka's batch",
         ratios("G9", "polhode integrate_many of 8, default", "heyoka, batch of 8, 2.2e-16"), 2.5),
    Goal("ensemble", "64 variants of W1, 8 times as fast as heyoka's ensemble of its integrator, "
         "at an error up to three times its own",
         beside_at_equal_error("ensemble", "heyoka ensemble_propagate_until, 2.2e-16"), 8),
    Goal("ensemble", "2.5 times as fast as its ensemble of the batch",
         beside_at_equal_error("ensemble", "heyoka ensemble_propagate_until_batch, 2.2e-16"), 2.5),
    Goal("G11", "the axis of one body of many for a Myr, to 1e-7 rad after 100: 0.024 ms",
         quickest("G11", "polhode spin_histories...", 1e-7, 1e3), most=0.024, unit="ms"),
    Goal("G12", "a new body of a million, within 100 turns: 30 ns",
         numbers("value", "G12", BODIES, MILLION), most=30, unit="ns"),
    Goal("G12", "within 1e-14", numbers("error", "G12", BODIES, MILLION), most=1e-14),
    Goal("G12", "two threads 1.9 times as fast",
         between("G12", BODIES + ", two threads", "waited for, " + MILLION, BODIES,
                 "waited for, " + MILLION), 1.9),
    Goal("G12", "from Python within 1.2 times that",
         ratios("G12", BODIES, "polhode propagate, from Python"), most=1.2),
    Goal("G12", "to 1e9 turns, a tenth next to the separatrix: 80 ns",
         numbers("value", "G12", BODIES, AGES), most=80, unit="ns"),
    Goal("G13", "HDF5 within 1.2 times the time of write(2)",
         ratios("G13", "raw write(2)", "polhode HDF5 as runs write it"), most=1.2),
    Goal("G13", "CSV 1.8 times as fast as std::to_chars",
         ratios("G13", "polhode CSV", "std::to_chars"), 1.8),
    Goal("G14", "a year of Envisat within 1e-7 rad: 1.5 s",
         quickest("G14", "polhode Collocation...", 1e-7), most=1.5, unit="s"),
    Goal("G14", "two methods agree to 1e-8: Collocation, and heyoka in 80 bits",
         numbers("error", "G14", DEFAULT), most=1e-8, unit="rad"),
    Goal("G15", "Mars unaveraged for a Myr, its axis within 2e-8 rad in 1000 years: 60 s",
         quickest("G15", "polhode...", 2e-8), most=60, unit="s"),
    Goal("G15", "at the error of steps of 0.37 d, a quarter of their time",
         lambda medians: [t / e["value"]
                          for e in medians.of("G15", "polhode Splitting order2, 0.37 d")
                          for t in quickest("G15", "polhode...", e["error"])(medians)],
         most=0.25),
    Goal("energy", "a million turns by fixed steps, next to 2.5e-13 of ABA1064",
         numbers("error", "energy", "polhode..."), most=2.5e-13),
)


def table(entries):
    medians = Medians(entries)
    yield "| goal | asked | found | met |"
    yield "|---|---|---|---|"
    for goal in GOALS:
        found, met = goal.line(medians)
        yield f"| {goal.name} | {goal.asked} | {found} | {met} |"
