# SPDX-License-Identifier: MIT
"""Perturbations, orbits, experiments, observations and columns of your own in scenario files.

A kind is described once: its name, its keys and a function that makes a term, an orbit, an
experiment or an observation from their values; or the names and dimensions of columns and a
function of a row. After `register`, files may name it: `load`, `Scenario.run`, maps, ensembles,
fits, error messages and the JSON Schema know it.
"""

from __future__ import annotations

import functools
import inspect
import keyword
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy

from polhode import _core, _signatures, _toml
from polhode._core import Dimension, KindTable, known_units
from polhode._mistakes import sentence

__all__ = [
    "ColumnKind",
    "Dimension",
    "ExperimentKind",
    "Key",
    "KindTable",
    "ObservationKind",
    "OrbitKind",
    "PerturbationKind",
    "known_units",
    "register",
    "registered",
    "schema",
    "template",
]

_NUMERIC = ("number", "numbers", "matrix")
_FORMS = (*_NUMERIC, "integer", "flag", "text", "file", "name", "word")
_RANGES = ("any", "positive", "not_negative")


def _require(condition: bool, message: str) -> None:
    if not condition:
        raise ValueError(message)


def _require_text(where: str, what: str, value: Any, expected: str) -> None:
    if not isinstance(value, str):
        raise TypeError(f"{where}: {what}: got {value!r}; expected a str")
    _require(bool(value), f"{where}: got no {what}; expected {expected}")


def _dimension(where: str, value: Any) -> Any:
    names = ", ".join(one.name for one in Dimension)
    _require(value is not None, f"{where}: got no dimension; expected one of {names}")
    if isinstance(value, str):
        _require(hasattr(Dimension, value),
                 f"{where}: dimension: got {value!r}; expected one of {names}")
        return getattr(Dimension, value)
    if not isinstance(value, Dimension):
        raise TypeError(f"{where}: dimension: got {value!r}; expected a Dimension or its name")
    return value


def _citations(where: str, given: Sequence[tuple[str, str, str]]) -> tuple[Any, ...]:
    citations = tuple(tuple(one) for one in given)
    for citation in citations:
        _require(len(citation) == 3 and all(isinstance(text, str) for text in citation),
                 f"{where}: citations: got {citation!r}; expected (key, text, reason)")
    return citations


def _toml_of(value: Any, where: str) -> str:
    return "" if value is None else _toml.value_text(value, where)


@dataclass(frozen=True)
class Key:
    """One key of the table of a kind.

    Parameters
    ----------
    name : letters, digits, _ and -.
    help : one sentence that ends with a full stop.
    dimension : of numbers, a Dimension or its name: "torque", "length", ...; "number" for a pure
        number. Required for the forms number, numbers and matrix.
    form : "number", "numbers", "matrix" (3, 3), "integer", "flag", "text", "file" (a path from the
        folder of the scenario), "name" (of an orbit) or "word" (one of `words`).
    length : of numbers; 0 is any length.
    words : the words that are allowed.
    default : the value in a file if the key is missing; None for no default.
    required : whether the table must have the key.
    range : "any", "positive" or "not_negative".
    example : the value that `template` writes; None for the default.

    ValueError for a numeric key without a dimension, an unknown form, and a default or an example
    that the key does not take (when the kind is registered).
    """

    name: str
    help: str
    dimension: Any = None
    form: str = "number"
    length: int = 0
    words: Sequence[str] = ()
    default: Any = None
    required: bool = False
    range: str = "any"
    example: Any = None

    def __post_init__(self) -> None:
        _require_text("Key", "name", self.name, "letters, digits, _ and -")
        where = f'Key "{self.name}"'
        _require_text(where, "help", self.help, "a sentence that says what it is")
        _require(self.help.endswith("."),
                 f"{where}: help: got {self.help!r}; expected a sentence with a full stop")
        _require(self.form in _FORMS,
                 f"{where}: form: got {self.form!r}; expected one of {', '.join(_FORMS)}")
        if self.form in _NUMERIC:
            object.__setattr__(self, "dimension", _dimension(where, self.dimension))
        else:
            _require(self.dimension is None,
                     f"{where}: dimension: got {self.dimension!r}; expected none for a {self.form}")
            _require(self.range == "any",
                     f"{where}: range: got {self.range!r}; expected \"any\" for a {self.form}")
            object.__setattr__(self, "dimension", Dimension.number)
        _require(isinstance(self.length, int) and self.length >= 0
                 and (self.length == 0 or self.form == "numbers"),
                 f"{where}: length: got {self.length!r}; expected a whole number for the form "
                 '"numbers", 0 for any length')
        _require(not isinstance(self.words, str),
                 f"{where}: words: got {self.words!r}; expected a sequence of str")
        _require(self.range in _RANGES,
                 f"{where}: range: got {self.range!r}; expected one of {', '.join(_RANGES)}")
        object.__setattr__(self, "words", tuple(self.words))
        _require((self.form == "word") == bool(self.words),
                 f"{where}: words: got {self.words!r}; expected them for the form \"word\" alone")
        _require(not (self.required and self.default is not None),
                 f"{where}: default: got {self.default!r}; expected none for a required key")

    @property
    def _allowed(self) -> str:
        return "|".join(self.words)

    @property
    def _default_toml(self) -> str:
        return _toml_of(self.default, self.name)

    @property
    def _example_toml(self) -> str:
        return _toml_of(self.default if self.example is None else self.example, self.name)


@dataclass(frozen=True)
class _Kind:
    name: str
    help: str
    keys: Sequence[Key]
    made: Callable[[_core.KindTable], Any]
    sets: str = ""
    citations: Sequence[tuple[str, str, str]] = ()
    on_surface: bool = False

    def __post_init__(self) -> None:
        own = type(self).__name__
        _require_text(own, "name", self.name, "letters, digits and -")
        where = f'{own} "{self.name}"'
        _require_text(where, "help", self.help, "one sentence that says what it is")
        object.__setattr__(self, "keys", tuple(self.keys))
        for key in self.keys:
            if not isinstance(key, Key):
                raise TypeError(f"{where}: keys: got {key!r}; expected Key objects")
        in_sets = re.split("[|+]", self.sets)
        for key in self.keys:
            _require(not (key.required and key.name in in_sets),
                     f'{where}: key "{key.name}": got required=True; expected False for a key of '
                     "sets")
        if not callable(self.made):
            raise TypeError(f"{where}: made: got {self.made!r}; expected a function of a KindTable")
        object.__setattr__(self, "citations", _citations(where, self.citations))


class PerturbationKind(_Kind):
    """A kind of [[perturbation]].

    Parameters
    ----------
    name : the word for `kind` in files, of letters, digits and -.
    help : one sentence: what acts.
    keys : Key objects.
    made : f(table) -> a term of polhode, such as a TorqueTerm or a HamiltonianTerm, or a list of
        them. `table` is a KindTable: table["limit"] is the value of a key in core units, table.body
        the body. A ValueError that it raises becomes an error of the file; table.refuse names the
        key.
    sets : sets of keys of which a table has exactly one, "times+torques|file"; empty: none.
    citations : references, (key, text, reason).
    on_surface : whether it acts on the facets of [[surface]], so that `template` writes one.
    """


class OrbitKind(_Kind):
    """A kind of [orbit.NAME].

    Parameters
    ----------
    name, help, keys, sets, citations : as those of a PerturbationKind.
    made : f(table) -> KeplerOrbit, PrecessingKeplerOrbit, TurnedKeplerOrbit or TableOrbit along the
        inertial axes of the state, or (orbit, gm) with the gravitational parameter of the
        attracting body. table.span is the time that a TableOrbit must cover.
    """


class ExperimentKind(_Kind):
    """A kind of file, with a table of its name, whose columns are functions of time.

    Parameters
    ----------
    name, help, keys, citations : as those of a PerturbationKind. It has no sets.
    made : f(table) -> {"columns": [(name, dimension), ...], "formula": f(t) -> numbers}: the
        columns after t, and their values in core units at a time.
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        _require(not self.sets,
                 f'ExperimentKind "{self.name}": sets: got {self.sets!r}; expected none')


class ObservationKind(_Kind):
    """A kind of [[observation]] of fits and simulations: numbers that depend on the motion.

    Parameters
    ----------
    name, help, keys, sets, citations : as those of a PerturbationKind. Each table also has the keys
        of all kinds: name, file and those of the times.
    made : f(table) -> {"columns": [(name, dimension), ...], "sigma": numbers, "function": f}: the
        columns of its files after t, the standard error of each in core units, and a function of
        the motion that returns one number for each. Its parameters are among `t`, `q` (4,), the
        attitude from body axes of the file to inertial ones, and `omega` (3,), the angular velocity
        along body axes. Angles are compared modulo a turn.
    """


@dataclass(frozen=True)
class ColumnKind:
    """A group of output columns of rotations.

    Parameters
    ----------
    name : the word for `output.columns` in files, of letters, digits, - and _.
    help : one sentence: what the numbers are.
    columns : (name, dimension) of each column, 1 to 16 of them. Names are of letters, digits and _,
        and differ from those of all other groups and columns.
    function : f(...) -> one number for each column, in core units; a float for a single one. Its
        parameters are named after what they are given: `t`, a group or a column of numbers such as
        `omega`, `axis3`, `theta` or `E` (one of yours, too, if it was registered before), `state`
        (a RotorState along principal axes) or `system`. Parameters with a default are left alone.
    citations : references, (key, text, reason).

    Examples
    --------
    >>> register(ColumnKind("spin", "Rate of rotation.", [("spin_rate", "rate")],
    ...                     lambda omega: numpy.linalg.norm(omega)))
    """

    name: str
    help: str
    columns: Sequence[tuple[str, Any]]
    function: Callable[..., Any]
    citations: Sequence[tuple[str, str, str]] = ()

    def __post_init__(self) -> None:
        _require_text("ColumnKind", "name", self.name, "letters, digits, - and _")
        where = f'ColumnKind "{self.name}"'
        _require_text(where, "help", self.help, "one sentence that says what the numbers are")
        columns = []
        for column in self.columns:
            if isinstance(column, str) or not isinstance(column, Sequence) or len(column) != 2:
                raise TypeError(f"{where}: columns: got {column!r}; expected (name, dimension)")
            name, dimension = column
            _require_text(where, "name of a column", name, "letters, digits and _")
            columns.append((name, _dimension(f'{where}, column "{name}"', dimension)))
        object.__setattr__(self, "columns", tuple(columns))
        object.__setattr__(self, "citations", _citations(where, self.citations))
        inputs = _parameters(f"{where}: function", self.function,
                             "t, state, system, groups or columns")
        object.__setattr__(self, "_inputs", inputs)


def _parameters(where: str, function: Any, given: str = "t, q or omega") -> tuple[str, ...]:
    """The names of the parameters without defaults."""
    expected = ("expected a function whose parameters are named after what they are given: "
                f"{given}")
    if not callable(function):
        raise TypeError(f"{where}: got {function!r}; {expected}")
    try:
        parameters = inspect.signature(function).parameters.values()
    except ValueError:
        raise TypeError(f"{where}: got {function!r}, which tells no parameters; "
                        f"{expected}") from None
    named = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    needed = [one for one in parameters if one.default is inspect.Parameter.empty]
    for one in needed:
        if one.kind not in named:
            raise TypeError(f"{where}: got the parameter {one}; {expected}")
    return tuple(one.name for one in needed)


_FAMILIES = {
    PerturbationKind: "with_perturbation", OrbitKind: "with_orbit",
    ExperimentKind: "with_experiment", ObservationKind: "with_observation",
    ColumnKind: "with_columns",
}
_registered: dict[tuple[type, str], _Kind | ColumnKind] = {}


def register(
    kind: PerturbationKind | OrbitKind | ExperimentKind | ObservationKind | ColumnKind, *,
    replace: bool = False,
) -> type[_core.AnyPerturbation] | None:
    """Registers a kind for all scenarios that are read from now on.

    A scenario keeps the kinds that it was read with. Another process, such as a worker of a pool,
    knows the kinds that it has registered itself: register on import of a module of your own.

    Parameters
    ----------
    kind : a PerturbationKind, an OrbitKind, an ExperimentKind, an ObservationKind or a ColumnKind.
        The function of a ColumnKind is called once, for a free rotation.
    replace : whether it may take the place of one that was registered under this name, as when a
        cell of a notebook runs again. Kinds of the library are not replaced.

    Returns
    -------
    type or None
        The class of the terms of a PerturbationKind, like those of the library: its keys are the
        arguments. `on_surface` adds a `surface`, and a `body` is for functions that ask for it.
        table.principal returns its argument, since arguments are along the principal axes.
        None for other kinds, and if a key cannot be an argument in Python, such as "max-torque".

    Raises
    ------
    ValueError
        For a name that exists, a key that is there twice, a default or an example that its key
        does not take, and a function of columns that returns another number of numbers or has a
        parameter that names nothing.

    Examples
    --------
    >>> Push = register(PerturbationKind(
    ...     "push", "A constant push.", [Key("torque", "Along axis 3.", "torque", required=True)],
    ...     lambda t: ConstantTorque([0, 0, t["torque"]])))
    >>> scenario = Scenario.build(System(body, terms=[Push(torque=1e-6)]), state, (0, 10, 1))
    """
    if type(kind) not in _FAMILIES:
        raise TypeError(f"register: got {kind!r}; expected a PerturbationKind, an OrbitKind, an "
                        "ExperimentKind, an ObservationKind or a ColumnKind")
    own = (type(kind), kind.name)
    _require(replace or own not in _registered,
             f'register: "{kind.name}" was registered before; expected another name or '
             "replace=True")
    kinds = {**_registered, own: kind}
    known = _core._default_kinds()
    for (family, _), one in kinds.items():
        known = getattr(known, _FAMILIES[family])(one)
    if isinstance(kind, ColumnKind):
        known.try_columns(kind.name)
    _core._allow_alive_at_exit()
    _toml.set_known_kinds(known)
    _registered.update(kinds)
    if isinstance(kind, PerturbationKind) and all(_is_argument(key.name) for key in kind.keys):
        return _term_class(known, kind.name)
    return None


def _is_argument(name: str) -> bool:
    return (name.isidentifier() and not keyword.iskeyword(name)
            and name not in ("self", "body", "surface")
            and not hasattr(_core.AnyPerturbation, name))


_classes: dict[str, type[_core.AnyPerturbation]] = {}


def _made_term(kind: str, arguments: tuple[Any, ...]) -> Any:
    """A pickled term."""
    _require(kind in _classes, f'"{kind}" is not registered; expected register of its kind first')
    return _classes[kind](*arguments)


def _argument_of(name: str, term: Any) -> Any:
    value = term.arguments[name]
    return numpy.array(value) if isinstance(value, tuple) else value


def _term_class(known: Any, kind: str) -> type[_core.AnyPerturbation]:
    number, name, text, doc, arguments = known.term_class(kind)
    names = vars(_core)
    whole = _signatures.signature_of(text, names)

    class Term(_core._RegisteredTerm):
        __doc__ = doc
        __match_args__ = arguments
        __signature__ = _signatures.without_self(whole)

        def __init__(self, *args: Any, **named: Any) -> None:
            try:
                super().__init__(number, *args, **named)
            except TypeError as error:
                if not _signatures.is_of_no_overload(error, "__init__"):
                    raise
                raise TypeError(sentence(name, [whole], args, named, names)) from None

        def __reduce__(self) -> Any:
            return _made_term, (kind, tuple(self.arguments.values()))

    for argument in arguments:
        setattr(Term, argument, property(functools.partial(_argument_of, argument)))
    Term.__name__ = Term.__qualname__ = name
    _core._set_term_type(number, Term)
    _classes[kind] = Term
    return Term


def registered() -> list[str]:
    """The names of the kinds that were registered, in their order."""
    return [name for _, name in _registered]


def schema() -> str:
    """The JSON Schema of scenario files, with the kinds that were registered."""
    text: str = _toml.known_kinds().schema()
    return text


def template(word: str) -> str:
    """A commented scenario to start from.

    Parameters
    ----------
    word : the name of a kind; `polhode init --help` lists those of the library.

    Returns
    -------
    str
        TOML.

    Raises
    ------
    ValueError
        For a name that nothing has.
    """
    _require_text("template", "word", word, "the name of a kind")
    text: str = _toml.known_kinds().template(word)
    return text


_signatures.publish(globals())
