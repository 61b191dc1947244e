# SPDX-License-Identifier: MIT
"""Rotation of rigid bodies, exact, in Serret-Andoyer and every related variable set.

The names of everyday work are here, the rest in modules: analysis, charts, elliptic, ensemble,
ephemeris, figures, fit, free, kinds, light, rates, satellites, secular, series, shape, spice, types
and vary. Same names as in C++; NumPy in, NumPy out. polhode.figures draws (it needs matplotlib).
"""

import importlib as _importlib
from types import ModuleType as _Module
from typing import TYPE_CHECKING as _TYPE_CHECKING
from typing import Any as _Any

from polhode import analysis as analysis
from polhode import charts as charts
from polhode import elliptic as elliptic
from polhode import ensemble as ensemble
from polhode import ephemeris as ephemeris
from polhode import fit as fit
from polhode import free as free
from polhode import kinds as kinds
from polhode import light as light
from polhode import rates as rates
from polhode import secular as secular
from polhode import series as series
from polhode import shape as shape
from polhode import types as types
from polhode import vary as vary
from polhode._core import (
    Adaptive,
    AndoyerState,
    AnelasticDamping,
    AtmosphericDrag,
    Body,
    Collocation,
    ConstantTorque,
    DipoleField,
    DomainError,
    EddyCurrents,
    EulerState,
    Event,
    Frame,
    FreeRotation,
    FukushimaIshizakiState,
    GravityGradient,
    HamiltonianTerm,
    InternalDamping,
    KaneDamper,
    KeplerElements,
    KeplerOrbit,
    KinoshitaState,
    LinearDamping,
    MomentumTerm,
    OrbitalPerturbation,
    OutputError,
    PoincareState,
    PrecessingKeplerOrbit,
    Problem,
    ResidualDipole,
    RotorState,
    SadovState,
    SaveAt,
    ScenarioError,
    SerretState,
    SolarPressure,
    Splitting,
    Surface,
    System,
    TableOrbit,
    TidalTorque,
    TorqueTable,
    TorqueTerm,
    Trajectory,
    TumblerState,
    TurnedKeplerOrbit,
    Units,
    VariationOfConstants,
    __version__,  # noqa: F401
    angular_velocity,
    energy,
    integrate,
    integrate_many,
    kinetic_energy,
    propagate,
    resume,
    rotor_state,
    to_andoyer,
    to_euler,
    to_fukushima_ishizaki,
    to_kinoshita,
    to_poincare,
    to_rotor,
    to_sadov,
    to_serret,
    to_tumbler,
)
from polhode._notebook import show_tables as _show_tables
from polhode._scenarios import MapResults, Results, Scenario, load
from polhode._signatures import publish as _publish

if _TYPE_CHECKING:
    from polhode import satellites as satellites

__all__ = [
    "Adaptive",
    "AndoyerState",
    "AnelasticDamping",
    "AtmosphericDrag",
    "Body",
    "Collocation",
    "ConstantTorque",
    "DipoleField",
    "DomainError",
    "EddyCurrents",
    "EulerState",
    "Event",
    "Frame",
    "FreeRotation",
    "FukushimaIshizakiState",
    "GravityGradient",
    "HamiltonianTerm",
    "InternalDamping",
    "KaneDamper",
    "KeplerElements",
    "KeplerOrbit",
    "KinoshitaState",
    "LinearDamping",
    "MapResults",
    "MomentumTerm",
    "OrbitalPerturbation",
    "OutputError",
    "PoincareState",
    "PrecessingKeplerOrbit",
    "Problem",
    "ResidualDipole",
    "Results",
    "RotorState",
    "SadovState",
    "SaveAt",
    "Scenario",
    "ScenarioError",
    "SerretState",
    "SolarPressure",
    "Splitting",
    "Surface",
    "System",
    "TableOrbit",
    "TidalTorque",
    "TorqueTable",
    "TorqueTerm",
    "Trajectory",
    "TumblerState",
    "TurnedKeplerOrbit",
    "Units",
    "VariationOfConstants",
    "angular_velocity",
    "energy",
    "integrate",
    "integrate_many",
    "kinetic_energy",
    "load",
    "propagate",
    "resume",
    "rotor_state",
    "to_andoyer",
    "to_euler",
    "to_fukushima_ishizaki",
    "to_kinoshita",
    "to_poincare",
    "to_rotor",
    "to_sadov",
    "to_serret",
    "to_tumbler",
]
_publish(globals())
_show_tables()


def __getattr__(name: str) -> _Any:
    if name.startswith("__") or name in ("figures", "spice"):  # modules that are not imported yet
        raise AttributeError(f"module 'polhode' has no attribute {name!r}")
    satellites = _importlib.import_module("polhode.satellites")  # when it is needed: it takes long
    if name == "satellites":
        return satellites
    for module in [*globals().values(), satellites]:
        if isinstance(module, _Module) and name in getattr(module, "__all__", ()):
            raise AttributeError(f"polhode.{name} is now {module.__name__}.{name}")
    raise AttributeError(f"module 'polhode' has no attribute {name!r}")


def __dir__() -> list[str]:
    modules = [name for name, thing in globals().items() if isinstance(thing, _Module)]
    public = (name for name in modules if not name.startswith("_"))
    return sorted({*__all__, *public, "satellites", "__version__", "__doc__"})
