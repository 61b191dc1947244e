# SPDX-License-Identifier: MIT
"""What one mutation does to the text of an expression: names of the operators and their rules."""

import re

SWAPPED = {
    "+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["+"],
    "<": ["<=", ">"], "<=": ["<", ">="], ">": [">=", "<"], ">=": [">", "<="],
    "==": ["!="], "!=": ["=="], "&&": ["||"], "||": ["&&"],
    "+=": ["-="], "-=": ["+="], "*=": ["/="], "/=": ["*="],
}
SUMS = ("+", "-")
PRODUCTS = ("*", "/")

# Functions that stand for each other, and those that are dropped: f(x) -> x.
EXCHANGED = {
    "sin": "cos", "cos": "sin", "sinh": "cosh", "cosh": "sinh", "asin": "acos", "acos": "asin",
    "min": "max", "max": "min", "floor": "ceil", "ceil": "floor", "rint": "floor",
    "round": "floor",
}
DROPPED = ("sqrt", "cbrt", "abs", "fabs", "conj", "normalized", "transpose")

# Fields that stand for each other.
FIELDS = {"x": "y", "y": "z", "z": "x", "w": "x", "re": "im", "im": "re", "sin": "cos",
          "cos": "sin", "sn": "cn", "cn": "dn", "dn": "sn", "hi": "lo", "lo": "hi"}

# Operator of the tables and what it stands for, in the order of the report.
NAMES = {
    "arithmetic": "`a + b` to `a - b`, `a * b` to `a / b`, `a += b` to `a -= b`, and back",
    "comparison": "`a < b` to `a <= b` and `a > b`, `a == b` to `a != b`, `&&` to `||`, and back",
    "condition": "`if (c)` and `c ? a : b` to `!c`",
    "literal": "0 to 1, 1 to 2, 0.5 to 0.25, n to n - 1, half the exponent, one wrong digit",
    "index": "`v.x` to `v.y`, `a[0]` to `a[1]`, `c.re` to `c.im`",
    "term": "`a + b` to `a` and to `b`, `a += b` to `a`",
    "factor": "`a * b` to `a` and to `b`, `a / b` to `a`",
    "sign": "`-a` to `a`, `x = a` to `x = -a`",
    "function": "`sin` to `cos`, `min` to `max`, `atan2(a, b)` to `atan2(b, a)`, `sqrt(a)` to `a`",
}

_FLOAT = re.compile(r"(?P<digits>\d*\.?\d*)(?:[eE](?P<exponent>[+-]?\d+))?")


def plain(text):
    """Source text on one line, without comments: what stands for it in a mutated arm."""
    text = re.sub(r"//[^\n]*", " ", text)
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    return " ".join(text.split())


def mutated_integer(text, as_index=False):
    """0 -> 1, and n -> n - 1: an index stays inside its array."""
    match = re.fullmatch(r"(\d+)([uUlL]*)", text)
    if not match:
        return []
    value, suffix = int(match.group(1)), match.group(2)
    if as_index or value > 2:
        values = [1] if value == 0 else [value - 1]
    else:
        values = {0: [1], 1: [2, 0], 2: [1, 3]}[value]
    return [f"{v}{suffix}" for v in values]


def mutated_float(text):
    """A number that a slip of the pen would make of this one."""
    if text.lower().startswith("0x"):
        mantissa, _, exponent = text.lower().partition("p")
        if not exponent or abs(int(exponent)) < 4:
            return []
        return [f"{mantissa}p{int(exponent) // 2}"]
    match = _FLOAT.fullmatch(text)
    if not match:
        return []
    digits, exponent = match.group("digits"), match.group("exponent")
    if exponent and abs(int(exponent)) >= 4:  # a threshold
        return [f"{digits}e{int(exponent) // 2}"]
    value = float(text)
    known = {0.0: [1.0], 1.0: [2.0, 0.0], 0.5: [0.25], 2.0: [1.0, 3.0]}
    if value in known:
        return [repr(v) for v in known[value]]
    significant = [i for i, c in enumerate(digits) if c.isdigit()]
    while significant and digits[significant[0]] == "0":
        significant.pop(0)
    if len(significant) >= 5:  # a published coefficient: one digit in the middle
        at = significant[len(significant) // 2]
        digit = "1" if digits[at] == "9" else str(int(digits[at]) + 1)
        wrong = digits[:at] + digit + digits[at + 1:]
        return [wrong + (f"e{exponent}" if exponent else "")]
    return [repr(value + 1.0)]
