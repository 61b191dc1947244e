# SPDX-License-Identifier: MIT
"""The rules of tools/layers.py: who may include whom, details, and how full a folder may be."""

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
    ("src/tables/x.cpp", '#include "text/printable.hpp"'),
    ("src/tables/x.cpp", '#include "tables/detail/x.hpp"'),
    ("include/polhode/orbit/x.hpp", '#include "polhode/orbit/detail/x.hpp"'),
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


def test_a_folder_has_25_sources_at_most(messages):
    full = {f"src/tables/x{k}.cpp": "" for k in range(24)} | {"src/tables/x.hpp": ""}
    assert messages(full) == []
    assert messages(full | {"src/tables/detail/x.hpp": ""}) == []
    assert messages(full | {"src/tables/one_more.cpp": ""}) == [
        "src/tables: 26 sources, at most 25"]
