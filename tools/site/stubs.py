# SPDX-License-Identifier: MIT
"""The package as its stubs declare it, for autodoc: of a compiled function Python knows no
annotation, no place in the source and, of several signatures, none."""

import __future__

import ast
import collections
import importlib.util
import inspect
import pathlib
import re
import types
import typing
from importlib.machinery import SourceFileLoader

from sphinx.pycode import ModuleAnalyzer

# What was decorated with @overload: module.name -> the functions in their order.
overloads: dict[str, list] = collections.defaultdict(list)


def overload(function):
    overloads[f"{function.__module__}.{function.__qualname__}"].append(function)
    return function


def text_of(path: pathlib.Path) -> str:
    """The stubs; `RotorState` is what anybody calls RotorState[_Value]."""
    return re.sub(r"(?<!Generic)\[_Value\]", "", path.read_text(encoding="utf-8"))


def executed(path: pathlib.Path, name: str) -> types.ModuleType:
    """The stubs as a module of this name. Types of other modules stay words, as they are written:
    ArrayLike, not the union that it is."""
    spec = importlib.util.spec_from_loader(name, SourceFileLoader(name, str(path)))
    module = importlib.util.module_from_spec(spec)
    flags = __future__.annotations.compiler_flag
    code = compile(text_of(path), str(path), "exec", flags, dont_inherit=True)
    original, typing.overload = typing.overload, overload
    try:
        exec(code, vars(module))
    finally:
        typing.overload = original
    for key, thing in list(vars(module).items()):
        if inspect.ismodule(thing):
            delattr(module, key)
        elif inspect.isclass(thing) and thing.__module__ == name:
            for special in {"__eq__", "__hash__", "__repr__"} & set(vars(thing)):
                delattr(thing, special)  # a default is an instance: it must be shown
    return module


def declare(package: str, compiled: str) -> None:
    """Puts what the stubs declare in the place of what the compiled module brought, in the package
    and in its modules."""
    root = importlib.import_module(package)
    path = pathlib.Path(root.__file__).with_name(f"{compiled}.pyi")
    parts = [getattr(root, name) for name in dir(root)]
    for module in [root, *filter(inspect.ismodule, parts)]:
        declared = executed(path, module.__name__)
        for name in module.__all__:
            if name in vars(declared):
                setattr(module, name, getattr(declared, name))
        source = ast.parse(pathlib.Path(module.__file__).read_text(encoding="utf-8"))
        # one with classes of its own is documented by its source
        if not any(isinstance(node, ast.ClassDef) for node in source.body):
            analyzer = ModuleAnalyzer.for_string(text_of(path), module.__name__, str(path))
            ModuleAnalyzer.cache["module", module.__name__] = analyzer
