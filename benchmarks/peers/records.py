# SPDX-License-Identifier: MIT
"""The records of build/bench/peers.json: polhode beside one peer on one workload."""

import json
import math
import statistics

FIELDS = {"goal": str, "case": str, "peer": str, "method": str, "ours": float, "theirs": float,
          "unit": str, "ratio": float, "our_error": (float, type(None)),
          "their_error": (float, type(None)), "repetitions": dict, "command": str, "revision": str}


def _number(x):
    return None if x is None else float(x)


def matched(ours, their_error):
    """The place of the fastest whose error is at most three times theirs, or that errs least.

    `ours`: pairs of time and error.
    """
    places = range(len(ours))
    if their_error is None or any(error is None for _, error in ours):
        return sorted(places, key=lambda k: ours[k][0])[0]
    close = [k for k in places if ours[k][1] <= 3 * their_error]
    return sorted(close, key=lambda k: ours[k][0])[0] if close else sorted(
        places, key=lambda k: ours[k][1])[0]


def record(goal, case, ours, theirs, unit, *, command, revision):
    """A record of two measurements, each {who, repetitions, error}; ratio: theirs / ours."""
    mine, other = (float(statistics.median(side["repetitions"])) for side in (ours, theirs))
    return {"goal": goal, "case": case, "peer": theirs["who"], "method": ours["who"],
            "ours": mine, "theirs": other, "unit": unit, "ratio": other / mine,
            "our_error": _number(ours["error"]), "their_error": _number(theirs["error"]),
            "repetitions": {"ours": list(ours["repetitions"]),
                            "theirs": list(theirs["repetitions"])},
            "command": command, "revision": revision}


def faults(entries):
    """What is wrong with the list of a peers.json, a sentence each."""
    if not isinstance(entries, list):
        return ["peers.json holds no list"]
    found = []
    for k, entry in enumerate(entries):
        wrong = [f"record {k}: no {field}" for field in FIELDS if field not in entry]
        wrong += [f"record {k}: {field} is {entry[field]!r}" for field, kind in FIELDS.items()
                  if field in entry and not isinstance(entry[field], kind)]
        found += wrong
        if wrong:
            continue
        if not all(math.isfinite(entry[f]) and entry[f] > 0 for f in ("ours", "theirs")):
            found.append(f"record {k}: times are positive numbers")
        elif not math.isclose(entry["ratio"], entry["theirs"] / entry["ours"], rel_tol=1e-9):
            found.append(f"record {k}: ratio is not theirs / ours")
        for side in ("ours", "theirs"):
            raw = entry["repetitions"].get(side)
            if not raw or not math.isclose(statistics.median(raw), entry[side], rel_tol=1e-9):
                found.append(f"record {k}: {side} is not the median of its repetitions")
    return found


def write(path, content):
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n")
