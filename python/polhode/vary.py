# SPDX-License-Identifier: MIT
"""What numbers of an ensemble are drawn from: the kinds of `[[ensemble.vary]]`, a function each.

`scenario.ensemble(vary={"body.moments[0]": vary.uniform(0.60, 0.63)})`. Names, arguments and
what is said of them are those of the scenario file; a word with a hyphen has an underscore here."""

from __future__ import annotations

import inspect
import keyword
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Callable

from polhode import _core, _toml

if TYPE_CHECKING:

    def __getattr__(name: str) -> Callable[..., Distribution]: ...  # made below


_Key = tuple[str, str, bool, str, bool]  # of the schema: name, help, required, fallback, several
_NAMES = ("key", "keys")  # of what is drawn: tables say it


class Distribution:
    """What one number of a scenario, or several together, are drawn from. Immutable.

    Made by the functions of polhode.vary; `kind` and `values` are what a table `[[ensemble.vary]]`
    has besides its keys.
    """

    __slots__ = ("kind", "values")
    kind: str
    values: Mapping[str, Any]

    def __init__(self, kind: str, values: Mapping[str, Any]) -> None:
        if kind not in _KINDS:
            raise ValueError(f"vary: got kind {kind!r}; expected one of {', '.join(_KINDS)}")
        object.__setattr__(self, "kind", kind)
        object.__setattr__(self, "values", {n: _plain(kind, n, x) for n, x in values.items()})

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{name}: a distribution does not change; make another one")

    def table(self, keys: str | tuple[str, ...]) -> dict[str, Any]:
        """The table `[[ensemble.vary]]` that draws the numbers at these keys from it."""
        names = [keys] if isinstance(keys, str) else list(keys) if isinstance(keys, tuple) else []
        if not names or not all(isinstance(name, str) for name in names):
            raise TypeError(f"vary: got the key {keys!r}; expected a text, or several in a tuple")
        if _of_several(self.kind):
            return {"kind": self.kind, "keys": names, **self.values}
        if len(names) > 1:
            of_several = ", ".join(_name(kind) for kind in _KINDS if _of_several(kind))
            raise ValueError(
                f"vary: {_name(self.kind)}: got {len(names)} keys, {', '.join(names)}; expected "
                f"one; several are drawn together by {of_several}"
            )
        return {"kind": self.kind, "key": names[0], **self.values}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Distribution):
            return NotImplemented
        return self.kind == other.kind and self.values == other.values

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        values = ", ".join(f"{_argument(name)}={value!r}" for name, value in self.values.items())
        return f"vary.{_name(self.kind)}({values})"

    def __reduce__(self) -> tuple[object, ...]:
        return Distribution, (self.kind, dict(self.values))


def tables_of(vary: Any) -> list[dict[str, Any]]:
    """The tables `[[ensemble.vary]]` of a dict: of keys, or of tuples of keys, to distributions."""
    if not isinstance(vary, Mapping) or not vary:
        raise TypeError(
            f"ensemble: vary: got {vary!r}; expected a dict of distributions by key, such as "
            "{\"body.moments[0]\": vary.uniform(0.60, 0.63)}"
        )
    tables = []
    for keys, distribution in vary.items():
        if not isinstance(distribution, Distribution):
            raise TypeError(
                f"ensemble: vary: {keys!r}: got {distribution!r}; expected one of "
                + ", ".join(f"vary.{_name(kind)}" for kind in _KINDS)
            )
        tables.append(distribution.table(keys))
    return tables


_KINDS: dict[str, tuple[str, list[_Key]]] = {
    kind: (text, keys) for kind, text, keys in _core._kinds_of_table("ensemble.vary[]")
}


def _name(kind: str) -> str:
    return kind.replace("-", "_")


def _argument(key: str) -> str:
    return f"{key}_" if keyword.iskeyword(key) else key


def _of_several(kind: str) -> bool:
    return any(several for *_, several in _KINDS[kind][1])


def _plain(kind: str, name: str, value: Any) -> Any:
    """As a file has it: no arrays. TypeError for what no file has, such as a quantity."""
    _toml.value_text(value, f"vary.{_name(kind)}: {name}")
    listed = value.tolist() if hasattr(value, "tolist") else value
    return [_plain(kind, name, x) for x in listed] if isinstance(listed, (list, tuple)) else listed


def _made(kind: str) -> Callable[..., Distribution]:
    """The function of a kind: what must be given comes first."""
    text, all_keys = _KINDS[kind]
    keys = sorted((k for k in all_keys if k[0] not in _NAMES), key=lambda k: not k[2])
    names = {_argument(key): key for key, *_ in keys}
    required = {_argument(key) for key, _, needed, *_ in keys if needed}
    signature = inspect.Signature(
        [
            inspect.Parameter(
                name, inspect.Parameter.POSITIONAL_OR_KEYWORD,
                default=inspect.Parameter.empty if name in required else None,
            )
            for name in names
        ],
        return_annotation=Distribution,
    )

    def distribution(*arguments: Any, **keywords: Any) -> Distribution:
        try:
            given = signature.bind(*arguments, **keywords).arguments
        except TypeError as error:
            raise TypeError(f"vary.{_name(kind)}{signature}: {error}") from None
        values = {names[name]: value for name, value in given.items() if value is not None}
        return Distribution(kind, values)

    said = [f"{_argument(key)} : {help}" for key, help, *_ in keys]
    parameters = ["", "Parameters", "----------", *said] if said else []
    distribution.__doc__ = "\n".join([text, *parameters])
    distribution.__name__ = distribution.__qualname__ = _name(kind)
    distribution.__signature__ = signature  # type: ignore[attr-defined]
    distribution.__annotations__ = {}
    return distribution


for _kind in _KINDS:
    globals()[_name(_kind)] = _made(_kind)

__all__ = ["Distribution", *map(_name, _KINDS)]
