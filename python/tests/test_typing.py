# SPDX-License-Identifier: MIT
"""The stub as a type checker reads it."""

import os
import pathlib
import re
import runpy
import subprocess
import sys
import typing

import polhode
import pytest
import typing_extensions

TESTS = pathlib.Path(__file__).parent
PROGRAM = TESTS / "typed_program.py"
REWRITE = TESTS.parent / "generic_stub.py"
STUB = pathlib.Path(polhode._core.__file__).with_name("_core.pyi")


def checked(path, cache):
    found = pathlib.Path(polhode.__file__).parents[1]
    return subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache, path],
        env={**os.environ, "PYTHONPATH": str(found)}, capture_output=True, text=True)


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    return tmp_path_factory.mktemp("mypy")


def test_states_are_floats_or_arrays_by_what_they_were_made_from(cache):
    done = checked(PROGRAM, cache)
    assert done.returncode == 0, done.stdout + done.stderr


def class_of(kind):
    found = typing.get_origin(kind) or kind
    # on Python 3.12 and later, NDArray of NumPy 2.5 is an alias of an array type
    return class_of(found.__value__) if hasattr(found, "__value__") else found


def test_what_the_types_say_is_what_the_program_makes(monkeypatch):
    asserted = []

    def holds(value, said):
        kinds = typing.get_args(said) if typing.get_origin(said) is typing.Union else [said]
        classes = tuple(class_of(kind) for kind in kinds if kind is not typing.Any)
        assert not classes or isinstance(value, classes)
        asserted.append(said)

    monkeypatch.setattr(typing_extensions, "assert_type", holds)
    runpy.run_path(str(PROGRAM))
    assert len(asserted) > 30


def test_every_state_has_its_parameter():
    generic = set(re.findall(r"^class (\w+)\(Generic\[_Value\]\):$", STUB.read_text(), re.M))
    core = vars(polhode._core)
    assert generic == {name for name in core if hasattr(core[name], "__class_getitem__")}
    for name in generic:
        assert core[name][float] is core[name]


# As nanobind writes it: a class of states and one that has states.
PLAIN = """
class Angle:
    def __init__(self, x: numpy.typing.ArrayLike) -> None: ...
    def x(self) -> float | numpy.typing.NDArray[numpy.float64]:
    def reshape(self, shape: object) -> Angle:
class Run:
    def initial_state(self) -> Angle:
    def initial(self) -> Angle:
    def s(self) -> Angle:
    def states(self) -> Angle:
"""


def rewritten(tmp_path, text):
    path = tmp_path / "_core.pyi"
    path.write_text(text)
    done = subprocess.run([sys.executable, REWRITE, path, path], capture_output=True, text=True)
    return done, path.read_text()


def test_a_stub_becomes_generic(tmp_path):
    done, text = rewritten(tmp_path, PLAIN)
    assert done.returncode == 0, done.stderr
    assert "def __init__(self: Angle[float], x: float) -> None: ..." in text
    assert "def initial(self) -> Angle[float]:" in text


@pytest.mark.parametrize("gone, message", [
    ("def reshape(self, shape", "the stub has no class of states"),
    ("def x(self)", "Angle has no field x"),
    ("def initial(self)", "no class has a state initial"),
])
def test_a_stub_without_what_is_expected_is_refused(tmp_path, gone, message):
    assert gone in PLAIN
    done, text = rewritten(tmp_path, PLAIN.replace(gone, "def other(self"))
    assert done.returncode == 1 and done.stderr.strip() == "generic_stub.py: " + message
    assert "Generic" not in text


@pytest.mark.parametrize("good, wrong", [
    ("assert_type(one.L, float)", "assert_type(one.L, Array)"),
    ("length(many)", "length(one)"),
    ("polhode.RotorState[float])", "polhode.RotorState[Array])"),
    ("motion.at(1.0)", "motion.at(body)"),
    ("of: polhode.RotorState[float]) -> float", "of: polhode.RotorState[Array]) -> float"),
])
def test_what_is_wrong_is_found(cache, tmp_path, good, wrong):
    text = PROGRAM.read_text()
    assert good in text
    path = tmp_path / "wrong.py"
    path.write_text(text.replace(good, wrong))
    assert "error: " in checked(path, cache).stdout
