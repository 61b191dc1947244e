# SPDX-License-Identifier: MIT
"""What inspect.signature says of the classes and functions of the extension.

nanobind keeps the text of each signature (__nb_signature__), but its functions take no attributes,
and inspect does not know them. So a class gets a __signature__, a method one of ours that calls it,
and a function a wrapper of Python: 50 ns a call."""

from __future__ import annotations

import ast
import functools
import inspect
import re
import sys
import types
from collections.abc import Callable, Iterable
from typing import Any, NoReturn

from polhode import _core
from polhode._mistakes import sentence, shown

_KINDS = inspect.Parameter


class _Shown:
    """A default that is no literal: shown as it is written."""

    def __init__(self, text: str) -> None:
        self._text = text

    def __repr__(self) -> str:
        return self._text


def _default(node: ast.expr, given: dict[str, Any], names: dict[str, Any]) -> Any:
    text = ast.unparse(node)
    if text in given:
        return given[text]
    try:
        return eval(text, {"__builtins__": {"float": float}}, names)  # of our own texts
    except (NameError, AttributeError, SyntaxError):
        return _Shown(text)


def _parsed(text: str, defaults: Any, names: dict[str, Any]) -> inspect.Signature:
    """Of "def f(x: float, *, t: float = \\0) -> float", where \\0 stands for the first default,
    \\=0 for its text."""
    given = {f"_default_{i}": value for i, value in enumerate(defaults or ())}
    for i in re.findall(r"\\=(\d+)", text):  # a default with a text of its own
        given[f"_default_{i}"] = _Shown(given[f"_default_{i}"])
    text = re.sub(r"\\=?(\d+)", r"_default_\1", text)
    text = re.sub(r"\bpolhode\.(?:[a-z_]+\.)?(?=[A-Z])", "", text)
    (function,) = ast.parse(text + ": ...").body
    assert isinstance(function, ast.FunctionDef)
    arguments = function.args
    positional = [(a, _KINDS.POSITIONAL_ONLY) for a in arguments.posonlyargs]
    positional += [(a, _KINDS.POSITIONAL_OR_KEYWORD) for a in arguments.args]
    missing = [None] * (len(positional) - len(arguments.defaults))
    rows = [(a, kind, d) for (a, kind), d in zip(positional, missing + arguments.defaults)]
    if arguments.vararg:
        rows.append((arguments.vararg, _KINDS.VAR_POSITIONAL, None))
    keywords = zip(arguments.kwonlyargs, arguments.kw_defaults)
    rows += [(a, _KINDS.KEYWORD_ONLY, d) for a, d in keywords]
    if arguments.kwarg:
        rows.append((arguments.kwarg, _KINDS.VAR_KEYWORD, None))
    return inspect.Signature(
        [
            _KINDS(
                a.arg,
                kind,
                default=_KINDS.empty if d is None else _default(d, given, names),
                annotation=ast.unparse(a.annotation) if a.annotation else _KINDS.empty,
            )
            for a, kind, d in rows
        ],
        return_annotation=ast.unparse(function.returns) if function.returns else _KINDS.empty,
    )


# Of the overload that explains mistakes: nobody is to see it.
_LAST_RESORT = "_last_resort"


def _overloads(callable_: Any, names: dict[str, Any]) -> list[inspect.Signature]:
    return [
        _parsed(text, defaults, names)
        for text, _, defaults in callable_.__nb_signature__
        if _LAST_RESORT not in text
    ]


def _signature(callable_: Any, names: dict[str, Any]) -> inspect.Signature:
    """Of its only overload; of several their union, which every valid call fits: "= ..." marks what
    not all of them require. Its text lists all overloads."""
    overloads = _overloads(callable_, names)
    merged: list[inspect.Parameter] = []
    for name in _in_one_order(overloads):
        those = [made.parameters[name] for made in overloads if name in made.parameters]
        default = next((p.default for p in those if p.default is not _KINDS.empty), _KINDS.empty)
        is_late = bool(merged) and merged[-1].default is not _KINDS.empty
        if default is _KINDS.empty and (
            len(those) < len(overloads) or is_late and those[0].kind is not _KINDS.KEYWORD_ONLY
        ):
            default = _Shown("...")
        merged.append(
            those[0].replace(default=default, annotation=_union(p.annotation for p in those))
        )
    returned = _union(made.return_annotation for made in overloads)
    return inspect.Signature(merged, return_annotation=returned)


def _in_one_order(overloads: list[inspect.Signature]) -> list[str]:
    """The names of all parameters, each after those that stand before it in an overload; what is
    given by name alone comes last."""
    longest_first = sorted(overloads, key=lambda made: -len(made.parameters))
    left = [
        [name for name, p in made.parameters.items() if p.kind is not _KINDS.KEYWORD_ONLY]
        for made in longest_first
    ]
    order: list[str] = []
    while left := [names for names in left if names]:
        name = next(
            first for first, *_ in left if all(first not in names[1:] for names in left)
        )  # fmt: skip
        order.append(name)
        left = [[other for other in names if other != name] for names in left]
    by_name = [name for made in longest_first for name in made.parameters if name not in order]
    return order + list(dict.fromkeys(by_name))


def _union(annotations: Iterable[Any]) -> Any:
    """ "Body | System" of texts, each once."""
    found = dict.fromkeys(
        part.strip() for one in annotations if one is not _KINDS.empty
        for part in _alternatives(one)
    )  # fmt: skip
    return " | ".join(found) if found else _KINDS.empty


def _alternatives(text: str) -> list[str]:
    """The parts of a union, whose own brackets stay closed."""
    parts, depth = [""], 0
    for character in text:
        depth += (character in "[(") - (character in "])")
        if character == "|" and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return parts


class _LateSignature(inspect.Signature):
    """Read from its text when somebody looks at it: all of them would take 12 ms of each import."""

    __slots__ = ("_make",)

    def __init__(self, make: Callable[[], inspect.Signature]) -> None:
        self._make = make

    def __getattr__(self, name: str) -> Any:  # of what the base class has not found yet
        if name not in ("_parameters", "_return_annotation"):
            raise AttributeError(name)
        made = self._make()
        self._parameters = made._parameters
        self._return_annotation = made._return_annotation
        return getattr(self, name)

    def replace(self, **changes: Any) -> inspect.Signature:
        return self._make().replace(**changes)

    __replace__ = replace

    def __reduce__(self) -> Any:
        return self._make().__reduce__()

    def __repr__(self) -> str:
        return repr(self._make())


class ClassSignature:
    """The __signature__ of a class, made when asked for. A subclass may have its own."""

    def __init__(self, owner: type, names: dict[str, Any]) -> None:
        self._owner = owner
        self._names = names

    def __get__(self, instance: Any, asked: type | None = None) -> inspect.Signature:
        if instance is not None or asked is None or asked.__init__ is not self._owner.__init__:
            raise AttributeError("__signature__")
        if issubclass(asked, BaseException):
            return inspect.Signature([_KINDS("args", _KINDS.VAR_POSITIONAL)])
        if not hasattr(asked.__init__, "__nb_signature__"):  # nobody but polhode makes one
            return inspect.Signature()
        if not _overloads(asked.__init__, self._names):
            return inspect.Signature()
        return without_self(_signature(asked.__init__, self._names))


def signature_of(text: str, names: dict[str, Any]) -> inspect.Signature:
    """Of "def __init__(self, gm: float) -> None"."""
    return _parsed(text, None, names)


def without_self(made: inspect.Signature) -> inspect.Signature:
    """That of the class of a constructor."""
    rest = [p for p in made.parameters.values() if p.name != "self"]
    return made.replace(parameters=rest, return_annotation=inspect.Signature.empty)


def is_of_no_overload(error: TypeError, name: str) -> bool:
    return str(error).startswith(f"{name}(): incompatible function arguments.")


def _refuse(
    subject: str, callable_: Any, names: dict[str, Any], args: tuple, kwargs: dict[str, Any]
) -> NoReturn:
    raise TypeError(sentence(subject, _overloads(callable_, names), args, kwargs, names))


def _makers(owner: type, names: dict[str, Any]) -> list[str]:
    """What returns one of a class that has no constructor: its static methods, or functions."""
    own = [f"{owner.__name__}.{name}" for name, value in vars(owner).items()
           if isinstance(value, staticmethod) and not name.startswith("_")]
    return own or [
        name for name, value in names.items()
        if type(value).__name__ == "nb_func" and not name.startswith("_") and any(
            owner.__name__ in re.findall(r"\w+", str(made.return_annotation))
            for made in _overloads(value, names)
        )
    ]


def explain_constructor(owner: Any, names: dict[str, Any]) -> None:
    """A call of the class that no constructor takes says what is wrong with it."""
    has_constructor = hasattr(owner.__init__, "__nb_signature__")

    def refuse(args: tuple, kwargs: dict[str, Any]) -> NoReturn:
        if has_constructor:
            _refuse(owner.__name__, owner.__init__, names, args, kwargs)
        makers = _makers(owner, names)
        how = " or ".join(makers[:4]) if makers else "what other functions of polhode return"
        raise TypeError(f"{owner.__name__}: its class cannot be called; expected {how}")

    owner._refuse = staticmethod(refuse)
    _core._explain_constructor(owner)


def with_signature(function: Any, names: dict[str, Any], owner: str = "") -> Callable[..., Any]:
    """The function, or static method of a class, as one of Python's."""

    def call(*args: Any, **kwargs: Any) -> Any:
        try:
            return function(*args, **kwargs)
        except TypeError as error:
            if not is_of_no_overload(error, function.__name__):
                raise
        _refuse(owner + function.__name__, function, names, args, kwargs)

    wrapper: Any = functools.update_wrapper(call, function, updated=())
    wrapper.__signature__ = _LateSignature(functools.partial(_signature, function, names))
    return call


def _explainer(owner: type, method: Any, names: dict[str, Any]) -> Callable[..., NoReturn]:
    def explain(self: Any, args: tuple, kwargs: dict[str, Any]) -> NoReturn:
        subject = f"{owner.__name__}.{method.__name__}"
        if not isinstance(self, owner):
            raise TypeError(f"{subject}: self: got {shown(self)}; expected a {owner.__name__}")
        _refuse(subject, method, names, tuple(args), kwargs)

    return explain


def sign_methods(owner: type, names: dict[str, Any]) -> None:
    """Methods of a class of the extension, all but those of Python's own protocols."""
    for name, method in list(vars(owner).items()):
        if name.startswith("__"):
            continue
        if type(method).__name__ == "nb_method":
            make = functools.partial(_signature, method, names)
            explain = _explainer(owner, method, names)
            setattr(owner, name, _core._signed_method(method, make, explain))
        elif type(method).__name__ == "nb_func":
            setattr(owner, name, staticmethod(with_signature(method, names, f"{owner.__name__}.")))


def publish(module: dict[str, Any]) -> None:
    """Makes a module the home of the names in its __all__: users, pickles and the reference know
    them by it, and inspect by their signatures."""
    home, names = module["__name__"], vars(_core)
    for name in module["__all__"]:
        thing = module[name]
        if isinstance(thing, type):
            thing.__module__ = home
            is_compiled = type(thing).__name__ == "nb_type"
            if is_compiled or issubclass(thing, Exception):
                thing.__signature__ = ClassSignature(thing, names)
                sign_methods(thing, names)
            if is_compiled:
                explain_constructor(thing, names)
        elif hasattr(thing, "__nb_signature__"):
            module[name] = with_signature(thing, names)
            module[name].__module__ = home
        elif inspect.isfunction(thing):
            thing.__module__ = home


def explain_call(module: str, new: str) -> None:
    """A call of a module that was a function says what to call instead."""

    class Renamed(types.ModuleType):
        def __call__(self, *args: Any, **kwargs: Any) -> NoReturn:
            raise TypeError(f"{module} is a module; call {new}")

    sys.modules[module].__class__ = Renamed
