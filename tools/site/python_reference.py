# SPDX-License-Identifier: MIT
"""The Python reference: which public name stands on which page; mkdocstrings writes the rest.

A name of the package that no page claims is put on the index under OTHERS;
tests/docs/test_site.py fails then. A name that a page claims and the package lacks is left out."""

import json
import os
import pathlib
import subprocess
import sys
from dataclasses import dataclass

OTHERS = "Others"
OVERVIEW = """\
# Python

`import polhode` brings everything on these pages but `polhode.figures`, `polhode.satellites` and
`polhode.spice`, which need packages of their own.
Names are those of the [C++ library](../cpp/index.md), in whose reference the equations, the
accuracy and the cost of each stand; accessors without arguments are properties.

- **Shapes.** Vectors are array-likes `(..., 3)`, quaternions `(..., 4)`, scalar first; a SciPy
  `Rotation` is taken wherever a quaternion is expected. A class of states holds one state or an
  array of any shape; its fields are floats for one state, else read-only arrays that share its
  memory. Arguments broadcast as in NumPy. `s[key]` indexes the leading axes.
- **Numbers.** Any real type in, `float32` too: it is widened to `float64`, which all results are.
- **Units.** Any consistent ones; angles are radians. Units in text belong to
  [scenarios](scenarios-and-results.md).
- **Errors.** `ValueError` (also as `polhode.DomainError`) for a value outside the domain, with
  the value, what was expected and its index; `TypeError` for a wrong type, with the argument, its
  value and what was expected. Functions of states
  check nothing: NaN in, NaN out.
- **Threads.** Whatever takes long releases the GIL.
- **Copies.** Everything is immutable. Bodies, states, motions, orbits, frames, terms, systems,
  methods, scenarios, results and trajectories can be pickled (a trajectory without its dense
  output); states and other values compare by their bits.
- **Sources.** `[SA (84)]` is equation (84) of the paper; [the map](../../theory/paper_map.md)
  leads from it to code and test.
"""


@dataclass
class Page:
    file: str
    title: str
    introduction: str
    groups: dict[str, str]  # heading -> names in order
    module: str = "polhode"


PAGES = [
    Page("bodies-and-states", "Bodies and states", """\
A body is its principal moments; a state is the hub [`RotorState`][polhode.RotorState]. Every
other set of variables is a chart, made by `to_...` and turned back by `to_rotor`: see [variable
sets](../../guide/charts.md) and [singularities](../../guide/singularities.md).
""", {
        "Body": "Body",
        "The hub":
            "RotorState rotor_state rotor_state_inertial to_rotor angular_velocity "
            "inertial_angular_velocity kinetic_energy inertial_momentum",
        "Charts":
            "EulerAngles EulerState EulerRates AndoyerState PoincareState Pole SerretState "
            "SadovState SadovRegion TumblerState",
        "From the hub to a chart":
            "to_euler to_euler_rates to_andoyer to_poincare nearest_poincare to_serret to_sadov "
            "to_tumbler",
        "Attitudes": "attitude attitude_matrix euler_angles to_scipy",
        "Derivatives":
            "CanonicalSet CanonicalChart chart_jacobian inverse_chart_jacobian "
            "canonical_transformation body_rate_jacobian inverse_body_rate_jacobian "
            "inertial_rate_jacobian inverse_inertial_rate_jacobian",
        "Errors": "DomainError ScenarioError OutputError",
    }),
    Page("free-rotation", "Free rotation", """\
The exact motion without torque ([guide](../../guide/free-rotation.md),
[regimes](../../theory/regimes.md)).
""", {
        "The motion": "FreeRotation free_rotation propagate Regime regime_name Modulus",
        "What belongs to a motion":
            "SadovFrequencies sadov_frequencies psi_max least_period_ratio long_axis_period "
            "rounding_sensitivity free_events GeneratingFunction generating_function",
        "Golden cases": "GoldenCase golden_cases write_golden",
    }),
    Page("spin-axes", "Spin axes over ages", """\
The direction of a planet's spin, averaged over its rotation and its orbit
([guide](../../guide/obliquity.md)).
""", {
        "Orbits": "ElementTable ElementSeries HistoryOrbit shipped_orbit",
        "What turns the axis":
            "PrecessionRates rates_of_precession star_precession satellite_precession "
            "geodetic_precession inner_satellites_factor planet_rates planet_pole TidalRates "
            "tidal_rate",
        "The motion": "spin_history SpinHistory",
        "Climates": "daily_insolation",
        "Frequencies": "spectrum Spectrum",
        "Nutation": "nutation_theory NutationTheory PlanetAxis iau_nutation",
    }),
    Page("perturbation-theory", "Perturbation theory", """\
Hamiltonians as Poisson series, and angles eliminated from them
([guide](../../guide/perturbation-theory.md)).
""", {
        "Series": "Symbols Series SeriesTerm Truncation ProductSize TransformSize CompiledSeries",
        "Lie transforms": "LieTransform LieMethod",
        "The free rotor": "TriaxialNormalForm RotorFrequencies",
        "Mean rotation": "GravityGradientTheory MeanRotation",
    }),
    Page("frames-and-orbits", "Frames and orbits", """\
Where attitudes are counted from, and where the attracting body is. Any Python function of time
that returns three numbers is an orbit wherever one is expected.
""", {
        "Frames": "Frame FrameMotion",
        "Orbits":
            "KeplerElements KeplerOrbit PrecessingKeplerOrbit SecularRates j2_rates mean_elements "
            "mean_motion semi_major_axis pericentre_distance TurnedKeplerOrbit TableOrbit",
        "Dates": "Date TimeScale calendar_date date_after seconds_between",
        "Sun, Moon and planets":
            "Planetary planetary_position planetary_orbit planetary_gm j2000_from_teme",
        "Derivatives of your functions": "Dual DualState",
    }),
    Page("shapes", "Shapes and surfaces", """\
Meshes, what they weigh, and what light and air do to them ([guide](../../guide/shapes.md)).
""", {
        "Shapes": "FacetShape read_obj MassProperties mass_properties",
        "Surfaces": "Surface SolarPressure AtmosphericDrag",
        "YORP": "yorp_torque mean_pressure",
    }),
    Page("perturbations-and-systems", "Perturbations and systems", """\
A system is a body, a frame and terms. What its two angular velocities are, and which elements
osculate: [frames and osculation](../../guide/frames-and-osculation.md).
""", {
        "System": "System at_damper_rate",
        "Terms":
            "GravityGradient ConstantTorque LinearDamping TorqueTerm HamiltonianTerm SpaceAxes "
            "AnyPerturbation",
        "Gravity of higher degree, tides":
            "HigherGravity OblateGravity TidalTorque MassMoments OrbitOf Oblateness TidalBody",
        "Inside the body": "InternalDamping KaneDamper DampedMaterial wobble_time",
        "Tables": "TorqueTable Between Outside",
        "Magnetic torques": "DipoleField ResidualDipole EddyCurrents",
        "What a system does to a state":
            "Effect effect AngularVelocities energy RotorRates rotor_rates inertial_state "
            "reference_state",
        "Elements":
            "osculating_state canonical_state osculating_andoyer canonical_andoyer "
            "modified_andoyer from_modified_andoyer modified_andoyer_rates",
        "Their rates":
            "AndoyerRates andoyer_rates euler_phase_rates EulerPhaseRates HubRates hub_rates "
            "canonical_rates perturbation_rates convective_term",
        "Axes": "RotorAxes AxisAngles inertial_axes relative_axes axis_angles",
        "Andoyer's method": "equations_of_motion canonical_defect lagrange_brackets",
    }),
    Page("integrating", "Integrating", """\
[`integrate`][polhode.integrate] follows a system from a state; [which
propagator?](../../guide/which-propagator.md) helps to choose a method.
""", {
        "Problem": "Problem integrate resume Checkpoint state_transitions",
        "Methods": "Adaptive Precision Splitting SplittingScheme VariationOfConstants",
        "When": "SaveAt Event Crossing",
        "What a run leaves": "Trajectory EventRecord Outcome Statistics TransitionSamples",
        "Chaos": "chaos_indicator ChaosIndicator DeviationBy",
        "Surfaces of section": (
            "andoyer_section AndoyerSection AndoyerAngle spin_orbit_section SpinOrbitSection"
        ),
    }),
    Page("scenarios-and-results", "Scenarios and results", """\
[Scenario files](../scenario.md) from Python, and back: the rows of a run as arrays under the
names of the [columns](../files.md).
""", {
        "Scenario": "load Scenario Summary Citation",
        "Results": "Results MapResults",
        "Attitude files": "read_aem AttitudeEphemeris AemSegment",
        "Orbit files": "read_oem OrbitEphemeris OemSegment",
        "Terms of a run": "ArgumentFit HarmonicFit argument_fit harmonic_fit",
        "Units": "Units Dimension known_units",
    }),
    Page("elliptic", "Elliptic functions", """\
`polhode.elliptic`: integrals and functions over arrays, for every real modulus
([guide](../../guide/elliptic.md), [accuracy](../../accuracy/elliptic.md)).
""", {
        "Jacobi's functions":
            "jacobi JacobiFunctions amplitude jacobi_zeta nome complementary_nome",
        "Legendre's integrals":
            "legendre_f legendre_e legendre_pi legendre_d legendre_b heuman_lambda0",
        "Complete integrals": "complete_k complete_e complete_pi complete_d complete_b cel agm",
        "Carlson's integrals": "carlson_rf carlson_rc carlson_rd carlson_rj",
    }, "polhode.elliptic"),
    Page("figures", "Figures", """\
`from polhode import figures`. Each function takes Axes or makes them, and returns them.
""", {
        "Figures":
            "momentum_sphere frames_and_angles phase_plane orbit_ellipses polhode_and_herpolhode "
            "polhode_on_ellipsoid herpolhode attitude_of_body animation overview time_series "
            "poincare_section chaos_map chaos_growth energy_error",
        "What they draw, and from where": "RunData OblatePlanet BodyPicture View",
    }, "polhode.figures"),
    Page("satellites", "Satellites of the Earth", """\
`from polhode import satellites`; it needs sgp4 ([orbits](../../guide/orbits.md)).
""", {
        "Elements and what comes of them": "Satellite satellite_from_tle satellite_from_omm",
    }, "polhode.satellites"),
    Page("spice", "SPICE", """\
`import polhode.spice`; it needs spiceypy ([attitude files](../../guide/attitude-files.md)).
""", {
        "C-kernels": "write_ck write_ck_rows Kernels ephemeris_time",
    }, "polhode.spice"),
]


def public_names(root: pathlib.Path) -> dict[str, dict[str, str]]:
    """Of the package and its parts: name -> the module that defines it."""
    path = root / os.environ.get("POLHODE_PYTHON", "build/release/python")
    code = ("import importlib, json, inspect\n"
            "found = {}\n"
            f"for name in {sorted({page.module for page in PAGES})}:\n"
            "    module = importlib.import_module(name)\n"
            "    things = {n: getattr(module, n) for n in module.__all__}\n"
            "    found[name] = {n: getattr(thing, '__module__', name)\n"
            "                   for n, thing in things.items() if not inspect.ismodule(thing)}\n"
            "print(json.dumps(found))\n")
    done = subprocess.run([sys.executable, "-c", code], text=True, capture_output=True,
                          env=dict(os.environ, PYTHONPATH=str(path), MPLBACKEND="agg"))
    if done.returncode:
        raise RuntimeError(f"{path}: no package to document: make build\n{done.stderr}")
    return json.loads(done.stdout)


def path_of(module: str, name: str, defined_in: str) -> str:
    """Where the reference finds it: a module of figures has the name of its function."""
    return f"{defined_in if module == 'polhode.figures' else module}.{name}"


def page_text(page: Page, groups: dict[str, list[str]]) -> str:
    parts = [f"# {page.title}\n", page.introduction]
    for heading, paths in groups.items():
        if paths:
            parts += [f"## {heading}\n", *(f"::: {path}\n" for path in paths)]
    return "\n".join(parts)


def pages(root: pathlib.Path) -> dict[str, str]:
    """Page in reference/python -> its Markdown."""
    left = public_names(root)
    index, found = [OVERVIEW, "| page | what is on it |", "|---|---|"], {}
    for page in PAGES:
        names = left[page.module]
        groups = {heading: [path_of(page.module, name, names.pop(name))
                            for name in group.split() if name in names]
                  for heading, group in page.groups.items()}
        if page.module == "polhode.figures":
            rest = left.pop(page.module)
            groups["Style"] = [path_of(page.module, *item) for item in rest.items()]
        found[f"{page.file}.md"] = page_text(page, groups)
        paths = [path for group in groups.values() for path in group]
        links = ", ".join(f"[`{path.rpartition('.')[2]}`][{path}]" for path in paths)
        index.append(f"| [{page.title}]({page.file}.md) | {links} |")
    if left["polhode"]:
        others = [path_of("polhode", *item) for item in left["polhode"].items()]
        index += ["", f"## {OTHERS}\n", *(f"::: {path}\n" for path in others)]
    return {"index.md": "\n".join(index) + "\n", **found}
