# SPDX-License-Identifier: MIT
"""A valid call of every public function that takes numbers, read from the stub of the module."""

import ast
import pathlib
import re

import numpy as np
import polhode
from polhode import _core
from public_names import PUBLIC

NUMBERS = re.compile(r"\b(ArrayLike|float|int|NDArray)\b")
BODY = polhode.Body(1.0, 1.7, 2.1)
STATE = polhode.rotor_state(BODY, [1, 0, 0, 0], [0.1, 0.2, 1.0])
ELEMENTS = polhode.KeplerElements(gm=1.0, pericentre=2.0, eccentricity=0.1, inclination=0.3)
ORBIT = polhode.KeplerOrbit(ELEMENTS)
PRECESSING = polhode.PrecessingKeplerOrbit(ELEMENTS, polhode.satellites.SecularRates(0.0, 0.0, 0.0))
SYSTEM = polhode.System(BODY)
SATELLITES = polhode.satellites.SatelliteSystem(1.0)
SATELLITE = polhode.satellites.SatelliteState([1.0, 0.1, 0.2], [0.1, 0.9, 0.3])
DAMPER = polhode.KaneDamper(0.1, 0.2)
DAMPED = polhode.System(BODY, damper=DAMPER)
PROBLEM = polhode.Problem(SYSTEM, STATE, 0.0, 0.1)
CORNERS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
SHAPE = polhode.shape.FacetShape(CORNERS, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
SURFACE = polhode.Surface.of_plate([0.1, 0, 0], [1, 0, 0], 1.0)
DATE = polhode.ephemeris.calendar_date("UTC", 2020, 1, 1)
TIMES = np.linspace(0.0, 10.0, 20)
CIRCLE = np.stack([np.cos(TIMES), np.sin(TIMES), 0 * TIMES], axis=-1)
CHECKPOINTS = []
polhode.integrate(polhode.Problem(SYSTEM, STATE, 0.0, 300.0, polhode.Splitting(0.1)),
                  np.linspace(0, 300, 6001), sink=lambda *block: None,
                  keep_checkpoint=CHECKPOINTS.append, checkpoint_seconds=0.0)
NAMES_OF_SERIES = polhode.series.Symbols(["G", "k"], ["g"], [("g", "G")])
KEEP = polhode.series.Truncation({"k": 1}, 2)
SERIES = polhode.series.Series(NAMES_OF_SERIES, "k*cos(g)")
THEORY = polhode.secular.GravityGradientTheory(BODY, ORBIT, STATE, gm=1e-5, order=1)


def variables(z):
    return np.array([1.0 + z[0], z[1], z[2], 0.5]), z[3:]


# Objects by the class that a parameter is annotated with.
OF_CLASS = {
    "EulerState": polhode.to_euler(STATE),
    "PoincareState": polhode.charts.nearest_poincare(STATE),
    "EulerRates": polhode.charts.to_euler_rates(BODY, STATE),
    "SadovState": polhode.to_sadov(BODY, STATE),
    "KinoshitaState": polhode.to_kinoshita(BODY, STATE),
    "SadovParameters": polhode.free.SadovParameters(1.0, 0.5),
    # where the motion of STATE is at t = 0.5
    "EulerAngles": polhode.charts.euler_angles(polhode.FreeRotation(BODY, STATE).at(0.5).q),
    "FukushimaIshizakiState": polhode.to_fukushima_ishizaki(
        polhode.FreeRotation(BODY, STATE), 0.0
    ),
    "TumblerState": polhode.to_tumbler(polhode.FreeRotation(BODY, STATE), 0.0),
    "Pole": polhode.charts.Pole.zero,
    "Body": BODY,
    "RotorState": STATE,
    "System": SYSTEM,
    "SatelliteSystem": SATELLITES,
    "SatelliteState": SATELLITE,
    "SatellitePath": polhode.satellites.satellite_path(SATELLITES, SATELLITE, 0.0, 2.0),
    "FreeRotation": polhode.FreeRotation(BODY, STATE),
    "AndoyerState": polhode.to_andoyer(STATE),
    "SerretState": polhode.to_serret(BODY, STATE),
    "KeplerElements": ELEMENTS,
    "PrecessingKeplerOrbit": PRECESSING,
    "FacetShape": SHAPE,
    "Surface": SURFACE,
    "Date": DATE,
    "Problem": PROBLEM,
    "MassMoments": polhode.shape.MassMoments.of_points([1.0, 2.0], [[1, 0, 0], [0, 1, 0]]),
    "ElementTable": polhode.secular.ElementSeries([[0.1, 0.2, 0.3]], [[0.1, 0.2, 0.3]]),
    "PrecessionRates": polhode.secular.PrecessionRates(1.0),
    "Symbols": NAMES_OF_SERIES,
    "Truncation": KEEP,
    "Series": SERIES,
    "MeanRotation": THEORY.reference,
    "DampedMaterial": polhode.types.DampedMaterial(1e9, 100.0, 2000.0, 100.0, 0.02),
}

# Numbers and words by the name of a parameter; all other numbers are 1.
OF_NAME = {
    **dict.fromkeys(("q", "q_FB", "q_IS"), [1.0, 0.0, 0.0, 0.0]),
    **dict.fromkeys(
        (
            "g_B",
            "omega_B",
            "omega_I",
            "u",
            "v",
            "mu_S",
            "axis",
            "pole",
            "rotation",
            "centre",
            "normal",
            "origin",
            "x",
            "inertial",
            "relative",
            "dg",
            "damper_rate",
            "I",
            "strength",
        ),
        [0.1, 0.2, 1.0],
    ),
    **dict.fromkeys(("t", "times", "samples"), TIMES),
    "eccentricity": 0.1,
    "t": 0.5,
    "samples": [0.0, 0.1],
    "scale": "UTC",
    "target": "moon",
    "centre": [0.1, 0.2, 1.0],
    "tensor": np.diag([1.0, 1.7, 2.1]),
    "R": np.eye(3),
    "matrix": np.eye(3),
    "positions": CIRCLE,
    "velocities": CIRCLE[:, [1, 0, 2]] * [-1, 1, 0],
    "D": [0.1, 0.2, 0.3],
    "orbit": ORBIT,
    "name": "x",
    "torques": CIRCLE,
    "rows": SURFACE.rows,
    "vertices": CORNERS,
    "triangles": [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    "dimension": "time",
    "third": [0.1] * 10,
    "fourth": [0.1] * 15,
    "derivative": [1.0] * 6,
    "f": variables,
    "z": [0.3, 0.4, 0.5, 0.6, 1.0, 0.2],
    "chart": "andoyer",
    "angle": 1.0,
    "crossing": "rising",
    "dut1": 0.1,
    "overhang": 0.0,
    "order": 4,
    "year": 2020,
    "between": "linear",
    "outside": "hold",
    "function": lambda t, s: s.g,
    "masses": [1.0, 2.0],
    "sun": ORBIT,
    "shadow": "cone",
    "unit": "h",
    "specular": 0.1,
    "diffuse": 0.1,
    "emitted": 0.1,
    "normal_accommodation": 0.5,
    "tangential_accommodation": 0.5,
    "position": [2.0, 0.0, 0.0],
    "velocity": [0.0, 0.8, 0.1],
    "other": 0.5,
    "checkpoint": CHECKPOINTS[0],
}

# What one function wants otherwise.
VECTOR, MATRIX = [0.1, 0.2, 1.0], np.eye(6)
NO_DIPOLE = dict.fromkeys(
    ("field", "gauss", "reference_radius", "pole", "rotation_rate", "meridian", "meridian_epoch"))
OF_CALL = {
    "Body.with_axes": {"moments": [1.0, 1.7, 2.1]},
    "RotorState.__init__": {"g": VECTOR},
    "SatelliteState.__init__": {"r": VECTOR, "p": VECTOR},
    "elements_of_state(SatelliteSystem)": {"chart": "delaunay"},
    "elements_of_state": {"chart": "fukushima-ishizaki", "t0": 0.3},
    "serret_branches": {
        name: getattr(polhode.to_serret(BODY, STATE), name) for name in ("G", "H", "T")
    },
    "sadov_parameters": {"G": 1.0, "T": 0.35},
    **{
        f"element_{name}(SatelliteSystem)": {
            "elements": [0.1, 0.2, 0.3, 1.0, 0.9, 0.5], "chart": "delaunay"
        }
        for name in ("rates", "state", "convective_term")
    },
    "MomentumTerm.__init__": {"a": VECTOR, "axes": "body"},
    "inverse_chart_jacobian": {"state": VECTOR, "chart": MATRIX},
    "canonical_transformation": {"state": VECTOR, "from_chart": MATRIX, "to_chart": MATRIX},
    "attitude": {"rotation": np.eye(3)},
    "TumblerState.__init__": {"mode": "short_axis"},
    "mean_elements": {"J2": 1e-3},
    "free_events": {"events": []},
    "planetary_orbit": {"centre": "earth", "last": 86400.0, "tolerance": 1e-6},
    "MassMoments.of_points": {"positions": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]},
    "GravityGradient.__init__": {"orbit_of": "attractor", "third_moments": [0.1] * 10,
                                 "fourth_moments": [0.1] * 15, "pole": VECTOR},
    "ConstantTorque.__init__": {"torque": VECTOR},
    "TorqueTable.__init__": {
        "times": [0.0, 1.0], **{f"torque_{k}": [0.1, 0.2] for k in (1, 2, 3)}},
    "AtmosphericDrag.__init__": {"air_pole": VECTOR},
    "InternalDamping.__init__": {"k": VECTOR, "wobble_time": None, "rate": None},
    "AnelasticDamping.__init__": {"body": BODY},
    **{
        f"KaneDamper.{name}": {"rate": VECTOR, "g": VECTOR, "momentum": VECTOR}
        for name in ("rate_of_body", "energy", "acceleration", "momentum", "relative_rate")
    },
    "at_damper_rate": {"system": DAMPED, "rate": VECTOR},
    "ResidualDipole.__init__": {"moment": VECTOR, "constant_field": VECTOR, **NO_DIPOLE},
    "EddyCurrents.__init__": {"constant_field": VECTOR, **NO_DIPOLE},
    "RotorRates.__init__": {"g": VECTOR},
    "HubRates.__init__": {"theta": VECTOR, "g": VECTOR},
    "SaveAt.count": {"rows": 3},
    "Modulus.__init__": {"m": 0.25, "m1": 0.75},
    "Outcome.__init__": {"status": "completed", "advice": ""},
    "Adaptive.__init__": {"tolerance": 1e-9},
    "VariationOfConstants.__init__": {"tolerance": 1e-9},
    "Collocation.__init__": {"tolerance": 1e-9, "stages": 8, "step": 0.0},
    "SolarPressure.__init__": {"shadow": "cone", "sun": ORBIT},
    "Frame.orbit_plane_pq": {"p": 0.1, "q": 0.2},
    "integrate_many": {"problems": [PROBLEM]},
    "resume": {"sink": lambda *block: None, "samples": np.linspace(0, 300, 6001),
               "problem": polhode.Problem(SYSTEM, STATE, 0.0, 300.0, polhode.Splitting(0.1))},
    "ElementTable.__init__": {"times": TIMES},
    "TidalRates.__init__": {"orbit": 6.0},
    "ElementSeries.__init__": {name: [[0.1, 0.2, 0.3]] for name in ("ellipse", "plane")},
    "spin_history": {"pole": VECTOR, "times": [1.5, 2.0]},
    "spin_histories": {"poles": VECTOR, "times": [1.5, 2.0], "method": polhode.Splitting(0.5)},
    "shipped_orbit": {"name": "mars"},
    "long_axis_period": {"rotation_period": 2.0},  # longer than that of the short axis
    "planet_rates": {"name": "mars"},
    "planet_pole": {"name": "mars"},
    "nutation_theory": {"satellite_mass": 0.0123, "ellipticity": 0.003, "triaxiality": 0.0,
                        "spin_rate": 7e-5, "order": 1, "least": 1e-9},
    "spectrum": {"values": np.cos(0.7 * np.arange(100.0)), "lines": 2},
    "Truncation.__init__": {"order": 2, "most_bytes": 1000},
    "SeriesTerm.__init__": {"coefficient": 0.5},
    "Series.power": {"n": 2},
    "Series.integral": {"rates": {"g": 1}},
    "Series.substituted": {"name": "G", "s": 2},
    "Series.displaced": {"name": "G", "d": 2},
    "CompiledSeries.at": {"points": [1.0, 0.1, 0.5]},
    "Series.transform_size": {"keep": KEEP},
    "TransformSize.__init__": {"terms": [1.0], "bytes": [2.0]},
    "LieTransform.__init__": {"angles": ["g"],
                              "hamiltonian": SERIES + polhode.series.Series(NAMES_OF_SERIES, "G")},
    "GravityGradientTheory.__init__": {"gm": 1e-5, "order": 1, "least": 1e-9},
    **{f"GravityGradientTheory.{name}": {"tolerance": 1e-9} for name in ("means", "states")},
    "satellite_precession": {"eccentricity": 0.1},
    "chaos_indicator": {"distance": 1e-6, "deviation": [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]},
}


# What takes complex numbers as well.
OF_COMPLEX_NUMBERS = {"spectrum"}


def _classes(annotation):
    return [name for name in re.findall(r"\w+", annotation) if name in OF_CLASS]


class Call:
    """A callable, its arguments by name, and which of them are numbers."""

    def __init__(self, name, owner, node):
        self.name = name
        self._owner = owner
        arguments = node.args
        static = any(getattr(d, "id", "") == "staticmethod" for d in node.decorator_list)
        self.is_method = owner is not None and node.name != "__init__" and not static
        given = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
        self.annotations = {
            a.arg: ast.unparse(a.annotation) if a.annotation else ""
            for a in given
            if a.arg != "self"
        }
        count = len(arguments.defaults)
        optional = (
            {a.arg for a in (arguments.posonlyargs + arguments.args)[-count:]} if count else set()
        )
        optional |= {
            a.arg for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults) if d is not None
        }
        # what stands in brackets are arguments and results of functions
        self.numbers = [
            name
            for name, said in self.annotations.items()
            if NUMBERS.search(re.sub(r"\[.*\]", "", said))
        ]
        self.arguments = {
            name: self._sample(name, said)
            for name, said in self.annotations.items()
            if name in self.numbers or name not in optional
        }
        extra = self._own()
        self.arguments.update({a: x for a, x in extra.items() if a in self.annotations})

    def _own(self):
        """What this function wants otherwise, of overloads that of satellites."""
        overload = f"{self.name}({self.annotations.get('system')})"
        return OF_CALL.get(overload, OF_CALL.get(self.name, {}))

    def _sample(self, name, said):
        own = self._own()
        if name in own:
            return own[name]
        classes = [] if said.startswith("Callable") else _classes(said)
        if classes and name not in ("sun",):
            return OF_CLASS[classes[0]]
        if name in OF_NAME:
            return OF_NAME[name]
        return 1 if said == "int" else 1.0

    @property
    def function(self):
        *path, last = self.name.split(".")
        if not path:
            return PUBLIC[last]
        owner = PUBLIC[path[0]]
        if not self.is_method:
            return owner if last == "__init__" else getattr(owner, last)
        return getattr(OF_SELF[path[0]], last)

    def __call__(self, **changed):
        return self.function(**{**self.arguments, **changed})


def all_calls():
    stub = pathlib.Path(_core.__file__).with_name("_core.pyi").read_text(encoding="utf-8")
    calls = []
    for node in ast.parse(stub).body:
        if isinstance(node, ast.ClassDef):
            for inner in node.body:
                if isinstance(inner, ast.FunctionDef) and (
                    inner.name == "__init__" or not inner.name.startswith("_")
                ):
                    calls.append(Call(f"{node.name}.{inner.name}", node.name, inner))
        elif isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            calls.append(Call(node.name, None, node))
    # only callbacks of the user receive a DualState or a KindTable
    return [c for c in calls if c.numbers and "DualState" not in c.annotations.values()
            and not c.name.startswith("KindTable.")]


# Objects by the class that a method is of.
OF_SELF = {
    "Body": BODY,
    "FreeRotation": OF_CLASS["FreeRotation"],
    "SatellitePath": OF_CLASS["SatellitePath"],
    "KeplerOrbit": ORBIT,
    "Dual": polhode.types.Dual(1.0),
    "PrecessingKeplerOrbit": PRECESSING,
    "TurnedKeplerOrbit": polhode.TurnedKeplerOrbit(PRECESSING, 0.4),
    "TableOrbit": polhode.TableOrbit(TIMES, CIRCLE),
    "HistoryOrbit": polhode.secular.HistoryOrbit(
        polhode.secular.shipped_orbit("mars"), 39.47, 1.52
    ),
    "Frame": polhode.Frame.inertial(),
    "NutationTheory": polhode.secular.nutation_theory("mars", order=1),
    "Date": DATE,
    "FacetShape": SHAPE,
    "Surface": SURFACE,
    "MassMoments": OF_CLASS["MassMoments"],
    "KaneDamper": DAMPER,
    "DipoleField": polhode.DipoleField([0, 0, 1.0]),
    "Units": polhode.Units(),
    "Series": SERIES,
    "GravityGradientTheory": THEORY,
    "CompiledSeries": polhode.series.CompiledSeries(SERIES),
    "TriaxialNormalForm": polhode.series.TriaxialNormalForm(BODY, 2),
    "Trajectory": polhode.integrate(polhode.Problem(DAMPED, STATE, 0.0, 1.0)),
}
