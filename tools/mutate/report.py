# SPDX-License-Identifier: MIT
"""What came out, in Markdown: by layer, by operator, and every survivor as a difference."""

from . import equivalent, operators, sites

MARKS = ("<!-- begin: tools/mutate -->", "<!-- end: tools/mutate -->")
COLUMNS = ("drawn", "caught", "of it hung", "equivalent", "survived", "no test")


def outcome(m, result, reasons):
    """The column of one mutant. What a test catches is not equivalent, whatever is said of it."""
    if result["status"] == "caught":
        return "caught"
    if equivalent.reason(reasons, m):
        return "equivalent"
    return "no test" if result["status"] == "unreached" else "survived"


def table(title, groups, rows):
    """rows: (group, outcome, how) of every mutant."""
    lines = [f"| {title} | " + " | ".join(COLUMNS) + " | caught of those not equivalent |",
             "|---|" + "---:|" * (len(COLUMNS) + 1)]
    for group in [*groups, "all"]:
        mine = [r for r in rows if group in (r[0], "all")]
        if not mine:
            continue
        count = {c: sum(r[1] == c for r in mine) for c in COLUMNS}
        count["drawn"] = len(mine)
        count["of it hung"] = sum(r[2] == "timeout" for r in mine)
        of = len(mine) - count["equivalent"]
        share = f"{100.0 * count['caught'] / of:.1f} %" if of else ""
        cells = [str(count[c]) for c in COLUMNS]
        lines.append(f"| {group} | " + " | ".join(cells) + f" | {share} |")
    return lines


def difference(m):
    return [f"`{m.file}:{m.line}` ({m.operator}, {m.key})", "", "```diff", f"  {m.context}",
            f"- {m.original}", f"+ {m.mutated}", "```", ""]


def judged_of(mutants, results, reasons):
    """(mutant, result, outcome) of all that have run."""
    return [(m, results[m.key], outcome(m, results[m.key], reasons))
            for m in mutants if m.key in results]


def summary(mutants, dropped, results, reasons, seed):
    """What was drawn, and the two tables."""
    judged = judged_of(mutants, results, reasons)
    missing = len(mutants) - len(judged)
    lines = [f"Seed {seed}: {len(mutants) + len(dropped)} mutants drawn, {len(dropped)} of them do "
             f"not compile, {len(judged)} ran" + (f", {missing} not yet." if missing else "."), ""]
    lines += table("layer", sites.LAYERS, [(m.layer, what, r.get("how")) for m, r, what in judged])
    lines += [""]
    lines += table("operator", operators.NAMES,
                   [(m.operator, what, r.get("how")) for m, r, what in judged])
    return lines


def text(mutants, dropped, results, reasons, seed):
    judged = judged_of(mutants, results, reasons)
    lines = ["# Mutants", "", *summary(mutants, dropped, results, reasons, seed)]
    false = [m for m, r, what in judged if what == "caught" and equivalent.reason(reasons, m)]
    for title, chosen in (
            ("Survivors", [m for m, _, what in judged if what == "survived"]),
            ("Reached by no test", [m for m, _, what in judged if what == "no test"]),
            ("Named equivalent, but caught", false)):
        if chosen:
            lines += ["", f"## {title}", ""]
            for m in sorted(chosen, key=lambda m: (m.file, m.line)):
                lines += difference(m)
    named = [m for m, _, what in judged if what == "equivalent"]
    if named:
        lines += ["", "## Equivalent", ""]
        for m in sorted(named, key=lambda m: (m.file, m.line)):
            lines += difference(m) + [equivalent.reason(reasons, m), ""]
    return "\n".join(lines).rstrip() + "\n"


def put_into(page, lines):
    """`lines` between the two marks of a page of the documentation."""
    head, tail = page.split(MARKS[0])[0], page.split(MARKS[1])[1]
    return head + "\n".join([MARKS[0], "", *lines, "", MARKS[1]]) + tail
