# SPDX-License-Identifier: MIT
"""The rules of tools/layers.py: who may include whom, circles, details, fullness of folders."""

import sys

import pytest

sys.dont_write_bytecode = True


@pytest.fixture
def messages(root, tmp_path, monkeypatch, capsys):
    """What layers.py says of a tree of files."""
    monkeypatch.syspath_prepend(str(root / "tools"))
    import layers

    monkeypatch.setattr(layers, "ROOT", tmp_path)

    def run(files):
        for name, text in files.items():
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        failed = layers.main()
        lines = capsys.readouterr().out.splitlines()
        assert failed == bool(lines)
        return lines

    return run


ALLOWED = [
    ("src/run/x.cpp", '#include "polhode/scenario/scenario.hpp"'),
    ("src/tables/x.cpp", '#include "text/words.hpp"'),
    ("src/tables/x.cpp", '#include "tables/detail/x.hpp"'),
    ("include/polhode/orbit/x.hpp", '#include "polhode/orbit/detail/x.hpp"'),
    ("src/run/x.cpp", '#include "polhode/detail/orbit/x.hpp"'),
    ("include/polhode/detail/orbit/x.hpp", '#include "polhode/math/vector.hpp"'),
    ("include/polhode/orbit/x.hpp", "namespace detail {\n\nclass X;\n\n}  // namespace detail"),
    ("include/polhode/orbit/detail/x.hpp",
     "namespace detail {\n\nint x();\n\n}  // namespace detail"),
    ("include/polhode/math/detail/registers.hpp", "#include <immintrin.h>"),
    ("include/polhode/math/detail/registers.hpp", "#include <arm_neon.h>"),
]
REFUSED = [
    ("src/free/x.cpp", "#include <immintrin.h>", "is not for this file"),
    ("src/text/x.cpp", '#include "tables/x.hpp"', "text may not include tables"),
    ("include/polhode/output/x.hpp", '#include "polhode/scenario/scenario.hpp"',
     "output may not include scenario"),
    ("src/run/x.cpp", '#include "tables/detail/x.hpp"', "is for tables alone"),
    ("src/run/x.cpp", '#include "polhode/orbit/detail/x.hpp"', "is for orbit alone"),
    ("src/dynamics/x.cpp", '#include "free/detail/x.hpp"', "is for free alone"),
    ("cli/x.cpp", '#include "polhode/orbit/detail/x.hpp"', "is for orbit alone"),
    ("cli/x.cpp", '#include "polhode/detail/orbit/x.hpp"', "is private to the library"),
    ("include/polhode/detail/output/x.hpp", '#include "polhode/scenario/scenario.hpp"',
     "output may not include scenario"),
    ("src/orbit/x.cpp", '#include "polhode/detail/free/x.hpp"', "orbit may not include free"),
    ("include/polhode/orbit/x.hpp", '#include "orbit/x.hpp"', "write it from the root"),
    ("src/tables/x.cpp", "#include <hdf5.h>", "is not for this file"),
    ("src/perturb/x.cpp", "#include <fstream>", "is not for this layer"),
    ("include/polhode/orbit/x.hpp", "namespace detail {\n\nint x();\n\n}  // namespace detail",
     "belongs into include/polhode/orbit/detail/"),
    ("include/polhode/elliptic/x.hpp", "namespace detail {\n\nint x();\n\n}  // namespace detail",
     "belongs into include/polhode/elliptic/detail/"),
    ("src/rooms/x.cpp", "", "unknown layer rooms"),
]


@pytest.mark.parametrize(("name", "text"), ALLOWED)
def test_is_allowed(messages, name, text):
    assert messages({name: text + "\n"}) == []


@pytest.mark.parametrize(("name", "text", "why"), REFUSED)
def test_is_refused(messages, name, text, why):
    (line,) = messages({name: text + "\n"})
    assert line.startswith(name) and why in line


# Modules of the Python package by name.
ONE_WAY = [
    {"__init__": "from polhode.one import f\nfrom polhode._core import *", "one":
     "from polhode import _core", "two": "from polhode import f"},
    {"__init__": "", "one": "import numpy", "inner/__init__": "from polhode.inner import deep",
     "inner/deep": "from ..one import f"},
]
CIRCLES = [
    {"one": "import polhode.two", "two": "from polhode import one"},
    {"one": "from polhode.two import f", "two": "def f():\n    from polhode.one import g"},
    {"one": "from polhode.two import f", "two": "if TYPE_CHECKING:\n    import polhode.one"},
    {"one": "from . import two", "two": "from .three import f", "three": "from .one import *"},
    {"__init__": "from polhode.one import f", "one": "from polhode import f"},
    {"inner/__init__": "from . import deep", "inner/deep": "from polhode.inner import f"},
]


def package(modules):
    return {f"python/polhode/{name}.py": text + "\n" for name, text in modules.items()}


@pytest.mark.parametrize("modules", ONE_WAY)
def test_python_modules_may_import_one_another(messages, modules):
    assert messages(package(modules)) == []


@pytest.mark.parametrize("modules", CIRCLES)
def test_python_modules_in_a_circle_are_refused(messages, modules):
    (line,) = messages(package(modules))
    names = {".".join(["polhode", *name.split("/")]).removesuffix(".__init__") for name in modules}
    first, *rest = line.removeprefix("cycle: ").split(" -> ")
    assert line.startswith("cycle: ") and first == rest[-1] and set(rest) == names


def test_a_cycle_of_headers_is_refused(messages):
    files = {f"src/text/{a}.hpp": f'#include "text/{b}.hpp"\n' for a, b in ("ab", "bc", "ca")}
    (line,) = messages(files)
    assert "src/text/a.hpp -> src/text/b.hpp -> src/text/c.hpp" in " -> ".join([line[7:]] * 2)
