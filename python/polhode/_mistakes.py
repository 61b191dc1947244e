# SPDX-License-Identifier: MIT
"""What is said of arguments that a class or function of the extension does not take: one sentence
with the argument, its value and what was expected, in place of nanobind's list of signatures."""

from __future__ import annotations

import inspect
import itertools
import operator
import re
from collections.abc import Iterable
from typing import Any

_LONGEST = 60
_WORDS = {
    "float": "a number",
    "int": "an int",
    "str": "a text",
    "bool": "a bool",
    "None": "None",
    "datetime.datetime": "a datetime",
    "numpy.datetime64": "a datetime64",
    "numpy.typing.ArrayLike": "numbers",
    "numpy.typing.NDArray[numpy.float64]": "numbers",
}
# What REBOUND and others call orbital elements.
_OTHER_NAMES = {
    "a": "semi_major_axis", "e": "eccentricity", "ecc": "eccentricity", "inc": "inclination",
    "i": "inclination", "Omega": "node", "raan": "node", "omega": "argument",
    "pomega": "argument", "Pomega": "argument", "varpi": "argument", "argp": "argument",
    "M": "mean_anomaly",
}
_PLURALS = {"float": "numbers", "int": "ints", "str": "texts"}
_RANGE = 2**31


def _article(word: str) -> str:
    return f"{'an' if word[0] in 'AEIOUaeiou' or word == 'ndarray' else 'a'} {word}"


def shown(value: Any) -> str:
    """"'x', a str"; of what tells its class by itself, that alone."""
    kind = type(value).__name__
    try:
        text = " ".join(repr(value).split())
    except Exception:  # a class of the user's that cannot show itself
        return _article(kind)
    if len(text) > _LONGEST:
        text = text[: _LONGEST - 3] + "..."
    if value is None or re.match(rf"<?(\w+\.)*{re.escape(kind)}\b", text):
        return text
    return f"{text}, {_article(kind)}"


def _alternatives(annotation: str) -> list[str]:
    """Of "A | B[C | D]": A, B[C | D]."""
    parts, depth = [""], 0
    for character in annotation:
        depth += (character in "[(") - (character in "])")
        if character == "|" and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts]


def _inner(annotation: str) -> str:
    return annotation[annotation.index("[") + 1 : -1].partition(", ...")[0]


def _is_sequence(annotation: str) -> bool:
    return bool(re.match(r"(collections\.abc\.)?(Sequence|Iterable)\[|tuple\[|list\[", annotation))


def _is_number(value: Any, kind: str) -> bool:
    try:
        if kind == "int":
            return -_RANGE <= operator.index(value) < _RANGE
        float(value)
    except (TypeError, ValueError, OverflowError):
        return False
    return not isinstance(value, (str, bytes))


def _is_one(value: Any, kind: str, names: dict[str, Any]) -> bool:
    """Whether it may be of one alternative of an annotation; of an unknown one, always."""
    if kind == "None":
        return value is None
    if value is None:
        return False
    if kind in ("float", "int"):
        return _is_number(value, kind)
    if kind == "str":
        return isinstance(value, str)
    if kind.startswith("collections.abc.Callable"):
        return callable(value)
    if _is_sequence(kind):
        if isinstance(value, str) or not isinstance(value, Iterable):
            return False
        return not isinstance(value, (list, tuple)) or all(
            fits(item, _inner(kind), names) for item in value
        )
    owner = names.get(kind)
    if not isinstance(owner, type):
        return True
    return isinstance(value, owner)


def fits(value: Any, annotation: Any, names: dict[str, Any]) -> bool:
    if annotation is inspect.Parameter.empty:
        return True
    return any(_is_one(value, kind, names) for kind in _alternatives(annotation))


def _word(kind: str, names: dict[str, Any]) -> str:
    if kind in _WORDS:
        return _WORDS[kind]
    if kind.startswith("collections.abc.Callable"):
        return "a function"
    if _is_sequence(kind):
        inner = _alternatives(_inner(kind))
        return "a sequence of " + " or ".join(_PLURALS.get(item, item) for item in inner)
    return _article(kind) if kind in names else kind


def _expected(annotations: Iterable[str], names: dict[str, Any]) -> str:
    words: list[str] = []
    for annotation in annotations:
        for kind in _alternatives(annotation):
            # a DualState only reaches functions that polhode calls
            if kind in ("typing.Any", "DualState"):
                continue
            if (word := _word(kind, names)) not in words:
                words.append(word)
    if "None" in words and len(words) > 1:
        words.remove("None")
        words.append("None")
    words = words or ["another value"]
    return ", ".join(words[:-1]) + (" or " if len(words) > 1 else "") + words[-1]


class _Attempt:
    """The arguments of a call against one overload: how many fit, and the first that does not."""

    def __init__(
        self, made: inspect.Signature, args: tuple, kwargs: dict, names: dict[str, Any]
    ) -> None:
        self.taken = [p for p in made.parameters.values() if p.name != "self"]
        self.wrong = self.annotation = self.complaint = ""
        self.value: Any = None
        positional = [p for p in self.taken if p.kind is p.POSITIONAL_OR_KEYWORD]
        given = {p.name: value for p, value in zip(positional, args)}
        known = {p.name: p.annotation for p in self.taken}
        named = {name: value for name, value in kwargs.items() if name in known}
        self.fitting = 0
        for name, value in {**given, **named}.items():
            if not fits(value, known[name], names):
                self.wrong, self.value, self.annotation = name, value, known[name]
                break
            self.fitting += 1
        if self.wrong:
            return
        if unknown := [name for name in kwargs if name not in known]:
            import difflib  # only here, where it is needed: it takes 5 ms to import

            near = [_OTHER_NAMES[unknown[0]]] if _OTHER_NAMES.get(unknown[0]) in known else (
                difflib.get_close_matches(unknown[0], known, 1))
            hint = near[0] if near else " or ".join(known) or "no arguments"
            self.complaint = f"got {unknown[0]}={shown(kwargs[unknown[0]])}; expected {hint}"
        elif twice := [name for name in kwargs if name in given]:
            self.complaint = f"got {twice[0]} twice, by place and by name; expected it once"
        elif len(args) > len(positional):
            listed = ", ".join(p.name for p in positional) or "none"
            self.complaint = f"got {len(args)} arguments without a name; expected {listed}"
        else:
            missing = [
                f"{p.name} ({_expected([p.annotation], names)})"
                for p in self.taken
                if p.default is p.empty and p.name not in {**given, **named}
            ]
            if missing:
                self.complaint = f"got no {missing[0].partition(' ')[0]}; expected " + ", ".join(
                    missing
                )

    @property
    def rank(self) -> tuple[int, bool]:
        return self.fitting, not self.wrong


def _order(
    signatures: list[inspect.Signature], args: tuple, kwargs: dict, names: dict[str, Any]
) -> str:
    """The order of the arguments, if these fit in another one."""
    if kwargs or not 2 <= len(args) <= 6:
        return ""
    for made in signatures:
        taken = [p for p in made.parameters.values()
                 if p.name != "self" and p.kind is p.POSITIONAL_OR_KEYWORD]
        if len(args) > len(taken) or any(p.default is p.empty for p in taken[len(args):]):
            continue
        places = [[fits(x, p.annotation, names) for x in args] for p in taken[: len(args)]]
        orders = itertools.permutations(range(len(args)))
        if any(all(map(operator.getitem, places, order)) for order in orders):
            return f" (the order is {', '.join(p.name for p in taken[:len(args)])})"
    return ""


def sentence(
    subject: str, signatures: list[inspect.Signature], args: tuple, kwargs: dict,
    names: dict[str, Any],
) -> str:
    attempts = [_Attempt(made, args, kwargs, names) for made in signatures]
    best = max(attempt.rank for attempt in attempts)
    left = [attempt for attempt in attempts if attempt.rank == best]
    first = left[0]
    if not first.wrong:
        said = first.complaint
        for other in left[1:]:
            if other.complaint and other.complaint != said:
                said += " or " + other.complaint.partition("; expected ")[2]
        if said:
            return f"{subject}: {said}"
        values = [shown(value) for value in (*args, *kwargs.values())]
        return f"{subject}: got {'; '.join(values)}; expected other values: {signatures[0]}"
    if "Date" in _alternatives(first.annotation) and not isinstance(first.value, (int, float)):
        names["Date"](first.value)  # says what is wrong with a text or a datetime
    left = [attempt for attempt in left if attempt.wrong]
    wrong = " or ".join(dict.fromkeys(attempt.wrong for attempt in left))
    expected = _expected([attempt.annotation for attempt in left], names)
    if "int" in first.annotation and isinstance(first.value, int):
        expected += " of 32 bits"
    hint = ""
    for parameter in first.taken:
        if parameter.name != first.wrong and parameter.annotation != first.annotation:
            if fits(first.value, parameter.annotation, names) and not isinstance(
                first.value, (str, int, float, list, tuple)
            ) and parameter.annotation in names:
                hint = f" ({parameter.name} is {_article(parameter.annotation)})"
                break
    hint = hint or _order(signatures, args, kwargs, names)
    return f"{subject}: {wrong}: got {shown(first.value)}; expected {expected}{hint}"
