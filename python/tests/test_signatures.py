# SPDX-License-Identifier: MIT
"""inspect.signature knows every public class and function: editors and notebooks ask it."""

import copy
import inspect
import pickle
import re
import types

import numpy
import polhode
import pytest
from public_names import MODULES
from rejections import rejected

PUBLIC = [
    (module.__name__ + "." + name, getattr(module, name))
    for module in MODULES
    for name in module.__all__
    if callable(getattr(module, name))
]


@pytest.mark.parametrize(("name", "thing"), PUBLIC, ids=[name for name, _ in PUBLIC])
def test_every_public_class_and_function_has_one(name, thing):
    signature = inspect.signature(thing)
    for parameter in signature.parameters.values():
        assert parameter.name != "self"


def test_arguments_defaults_and_kinds_are_those_of_the_call():
    signature = inspect.signature(polhode.integrate)
    assert list(signature.parameters)[:3] == ["problem", "samples", "dense"]
    assert signature.parameters["samples"].default is None
    assert signature.parameters["progress"].kind is inspect.Parameter.KEYWORD_ONLY
    assert signature.return_annotation == "Trajectory"
    adaptive = inspect.signature(polhode.Adaptive).parameters
    assert adaptive["tolerance"].default == 1e-12
    assert adaptive["largest_step"].default == numpy.inf
    assert inspect.signature(polhode.KeplerElements).parameters["epoch"].default == 0.0
    assert list(inspect.signature(polhode.RotorState).parameters) == ["q", "g"]


def test_every_public_method_has_one():
    count = 0
    for _, owner in PUBLIC:
        for name in vars(owner) if isinstance(owner, type) else ():
            if not name.startswith("_") and callable(getattr(owner, name)):
                assert isinstance(inspect.signature(getattr(owner, name)), inspect.Signature), name
                count += 1
    assert count > 100


def test_methods_are_called_pickled_and_shown_as_before():
    at = polhode.FreeRotation.at
    assert str(inspect.signature(at)) == (
        "(self, t: 'numpy.typing.ArrayLike', *, threads: 'int' = 1) -> 'RotorState'")
    body = polhode.Body(1.0, 1.7, 2.1)
    motion = polhode.FreeRotation(body, polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0]))
    assert str(inspect.signature(motion.at)) == (
        "(t: 'numpy.typing.ArrayLike', *, threads: 'int' = 1) -> 'RotorState'")
    assert at(motion, 2.0) == motion.at(2.0) == motion.at(t=2.0)
    assert at.__name__ == "at" and "exact state" in at.__doc__
    assert motion.at.__doc__ == at.__doc__
    assert pickle.loads(pickle.dumps(motion.at))(2.0) == motion.at(2.0)
    rejected(TypeError, r"FreeRotation.at: got no t; expected t \(numbers\)", motion.at)
    rejected(TypeError, "FreeRotation.at: self: got 3, an int; expected a FreeRot", at, 3, 2.0)


# What the signature calls a default is what is taken when the argument is left out.
def test_defaults_can_be_given():
    for thing in (polhode.Adaptive, polhode.Units, polhode.VariationOfConstants):
        given = {name: p.default for name, p in inspect.signature(thing).parameters.items()}
        assert repr(thing(**given)) == repr(thing())


def functions_and_methods():
    for name, thing in PUBLIC:
        if not (isinstance(thing, type) and issubclass(thing, BaseException)):
            yield name, thing
        for method in vars(thing) if isinstance(thing, type) else ():
            if not method.startswith("_") and callable(getattr(thing, method)):
                yield f"{name}.{method}", getattr(thing, method)


def test_no_signature_is_of_arguments_without_names():
    nameless = [
        name for name, thing in functions_and_methods()
        if {"args", "kwargs"} & set(inspect.signature(thing).parameters)
    ]
    assert not nameless


def test_of_several_overloads_it_is_their_union():
    def names(thing):
        return list(inspect.signature(thing).parameters)

    assert names(polhode.to_rotor) == ["body", "state", "t", "threads"]
    assert names(polhode.to_serret) == ["body", "state", "t", "threads"]
    assert names(polhode.angular_velocity) == ["system", "t", "state"]
    assert names(polhode.charts.chart_jacobian) == ["body", "state", "t", "chart"]
    assert names(polhode.ephemeris.Date) == ["instant", "scale", "day", "fraction"]
    assert str(inspect.signature(polhode.charts.canonical_transformation)).startswith(
        "(state: 'RotorState | numpy.typing.ArrayLike', from_chart: 'CanonicalChart | ")
    body = polhode.Body(1.0, 1.7, 2.1)
    state = polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0])
    union = inspect.signature(polhode.to_rotor)
    for arguments in [(polhode.to_andoyer(state),), (body, polhode.to_sadov(body, state)),
                      (body, polhode.to_serret(body, state), 0.0)]:
        assert union.bind(*arguments).args == arguments
        polhode.to_rotor(*arguments)


def test_a_subclass_has_its_own():
    class Mine(polhode.Adaptive):
        def __init__(self, x):
            super().__init__(x)

    assert list(inspect.signature(Mine).parameters) == ["x"]
    assert inspect.signature(type("Plain", (polhode.Adaptive,), {})).parameters


def test_functions_are_pickled_and_copied_by_name():
    for _, thing in PUBLIC:
        if not isinstance(thing, type) and not isinstance(thing, types.ModuleType):
            assert pickle.loads(pickle.dumps(thing)) is thing
            assert copy.copy(thing) is thing
            assert thing.__module__.startswith("polhode")
            assert thing.__doc__


def test_what_a_function_raises_passes_through():
    with pytest.raises(TypeError, match="integrate: problem: got 3, an int; expected a Problem"):
        polhode.integrate(3, 4, 5, 6)


def test_signatures_of_terms_name_every_orbit_that_they_take():
    times = numpy.linspace(0, 6, 40)
    elements = polhode.KeplerElements(1, 0.9, 0.1)
    precessing = polhode.PrecessingKeplerOrbit(elements, polhode.satellites.SecularRates())
    orbits = [
        polhode.KeplerOrbit(elements), precessing,
        polhode.TurnedKeplerOrbit.from_equator(precessing),
        polhode.TableOrbit(times, numpy.stack([numpy.cos(times), numpy.sin(times), 0 * times], 1)),
        polhode.secular.HistoryOrbit(polhode.secular.shipped_orbit("mars"), 1, 1),
        lambda t: [1, 0, 0],
    ]
    plate = polhode.Surface.of_plate((1, 0, 0), (0, 1, 0), 1.0)
    makers = {
        polhode.GravityGradient: lambda orbit: polhode.GravityGradient(orbit, 1),
        polhode.ResidualDipole: lambda orbit: polhode.ResidualDipole(
            [1, 0, 0], orbit, field=polhode.DipoleField([0, 0, 1])),
        polhode.SolarPressure: lambda orbit: polhode.SolarPressure(plate, orbit, 1, 1),
        polhode.AtmosphericDrag: lambda orbit: polhode.AtmosphericDrag(plate, orbit, 1, 1),
        polhode.TidalTorque: lambda orbit: polhode.TidalTorque(orbit, 1, 0.1, 0.1, 0.1, gm=1),
    }
    for term, make in makers.items():
        annotation = inspect.signature(term).parameters["orbit"].annotation
        for orbit in orbits:
            name = "Callable" if inspect.isfunction(orbit) else type(orbit).__name__
            try:
                make(orbit)
            except TypeError:
                assert name not in annotation, f"{term}: {name}"
            else:
                assert name in annotation, f"{term}: {name}"


def properties():
    for full_name, thing in PUBLIC:
        name = full_name.rpartition(".")[2]
        if isinstance(thing, type):
            for field, value in vars(thing).items():
                if isinstance(value, property) and not field.startswith("_"):
                    yield f"{name}.{field}", value


# A signature alone, "l(self) -> float", says nothing that the name does not.
def test_every_property_says_what_it_is():
    every = dict(properties())
    assert len(every) > 400
    dumb = [
        name for name, value in every.items()
        if not (value.__doc__ or "").strip()
        or re.fullmatch(r"\w*\(self.*\) -> .*", value.__doc__.strip())
    ]
    assert not dumb
