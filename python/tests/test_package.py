# SPDX-License-Identifier: MIT
"""The package as a whole: what importing it costs and shows."""

import dataclasses
import pathlib
import pprint
import subprocess
import sys

import budgets
import polhode
import pytest
from public_names import MODULES, PUBLIC


def imported(statement):
    """The modules that a fresh interpreter holds after a statement."""
    code = f"import sys; {statement}; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True,
                          check=True)
    return set(done.stdout.split())


def test_importing_it_needs_numpy_and_nothing_optional():
    modules = imported("import polhode")
    assert not modules & {"matplotlib", "scipy", "pandas", "xarray", "h5py"}


def test_importing_it_costs_few_modules_beside_numpys():
    more = imported("import numpy, polhode") - imported("import numpy")
    assert not [name for name in more if name.startswith(("numpy", "tomlkit"))]
    assert len([name for name in more if not name.startswith("polhode")]) <= (
        budgets.imported_modules)


def test_what_is_not_imported_at_first_is_found_when_it_is_needed():
    times, values = [0.0, 1, 2, 3, 4, 5, 6, 7], [0.0, 1, 0, -1, 0, 1, 0, -1]
    statement = f"import polhode; polhode.analysis.harmonic_fit({times}, {values}, [4.0])"
    assert "numpy.polynomial" in imported(statement)


def test_every_public_name_has_a_docstring():
    def has_doc(thing):
        return bool((getattr(thing, "__doc__", None) or "").strip())

    assert not [name for name, thing in PUBLIC.items()
                if (isinstance(thing, type) or callable(thing)) and not has_doc(thing)]


def test_every_name_has_one_home_and_says_so():
    for module in MODULES:
        for name in module.__all__:
            assert getattr(module, name).__module__ == module.__name__, name
    assert len(PUBLIC) == sum(len(module.__all__) for module in MODULES)


def test_every_name_of_the_extension_is_public_once():
    compiled = {name for name in dir(polhode._core) if not name.startswith("_")}
    assert compiled <= set(PUBLIC)


def test_an_old_name_says_the_new_one():
    with pytest.raises(AttributeError, match=r"^polhode\.spectrum is now polhode\.analysis\.spec"):
        polhode.spectrum  # noqa: B018
    with pytest.raises(AttributeError, match="polhode.simulate is now polhode.fit.simulate"):
        polhode.simulate  # noqa: B018
    with pytest.raises(AttributeError, match="no attribute 'spectra'"):
        polhode.spectra  # noqa: B018
    with pytest.raises(TypeError, match="polhode.fit is a module; call polhode.fit.fit_scen"):
        polhode.fit("night.toml")
    with pytest.raises(TypeError, match="polhode.ensemble is a module; call Scenario.ensemble"):
        polhode.ensemble("night.toml")


def test_completion_lists_what_is_public():
    modules = {module.__name__.rpartition(".")[2] for module in MODULES[1:]} | {"vary"}
    known = set(dir(polhode)) - {"figures", "spice"}  # once they were imported
    assert known == {*polhode.__all__, *modules, "__version__", "__doc__"}
    assert len(polhode.__all__) < 75


def test_values_are_dataclasses_to_those_who_ask():
    given = polhode.KeplerElements(gm=1.0, pericentre=2.0, eccentricity=0.1)
    assert dataclasses.is_dataclass(given)
    assert [f.name for f in dataclasses.fields(given)][:3] == ["gm", "pericentre", "eccentricity"]
    assert dataclasses.replace(given, eccentricity=0.2).eccentricity == 0.2
    with pytest.raises(ValueError, match="eccentricity"):
        dataclasses.replace(given, eccentricity=-1.0)
    assert dataclasses.asdict(polhode.satellites.SecularRates(0.3, 0.01, 1.0)) == {
        "node": 0.3, "argument": 0.01, "mean_anomaly": 1.0, "inclination": 0.0,
        "eccentricity": 0.0}
    assert polhode.Splitting.__match_args__ == ("step", "scheme")
    assert "KeplerElements(" in pprint.pformat(given)


def test_the_stub_names_what_there_is():
    stub = (pathlib.Path(polhode.__file__).parent / "_core.pyi").read_text()
    compile(stub, "_core.pyi", "exec")
    core = polhode._core
    missing = [name for name in dir(core) if not name.startswith("_")
               and f"def {name}(" not in stub and f"class {name}" not in stub]
    assert not missing


def test_the_version_is_that_of_the_headers():
    header = pathlib.Path(__file__).resolve().parents[2] / "include/polhode/version.hpp"
    numbers = [line.split()[-1] for line in header.read_text().splitlines()
               if line.startswith("#define POLHODE_VERSION_")]
    assert polhode.__version__ == ".".join(numbers)


def test_importing_it_again_gives_the_same_things():
    code = """
import sys, polhode
body = polhode.Body
for name in [name for name in sys.modules if name.startswith("polhode")]:
    del sys.modules[name]
import polhode
assert polhode.Body is body
print(polhode.Body(1, 1, 1))
"""
    done = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    assert (done.returncode, done.stdout) == (0, "Body(1.0, 1.0, 1.0)\n")
