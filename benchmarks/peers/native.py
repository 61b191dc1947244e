# SPDX-License-Identifier: MIT
"""The programs in C++: their lines, one measurement each, paired into records."""

import json
import subprocess

from records import record


def lines_of(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], check=True, text=True,
                          stdout=subprocess.PIPE)
    return [json.loads(line) for line in done.stdout.splitlines()]


def paired(lines, command, revision, missing):
    """Each measurement of a peer, beside each of polhode's for the same goal and case."""
    groups = {}
    for line in lines:
        if "missing" in line:
            missing(line["missing"])
        else:
            groups.setdefault((line["goal"], line["case"]), []).append(line)
    found = []
    for (goal, case), members in groups.items():
        ours = [m for m in members if m["who"].startswith("polhode")]
        for mine in ours:
            found += [record(goal, case, mine, other, mine["unit"], command=command,
                             revision=revision)
                      for other in members if other not in ours]
    return found
