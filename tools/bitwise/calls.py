# SPDX-License-Identifier: MIT
"""Results of the public Python package, one value a line: case, field, value.

The tests have a valid call of every public function that takes numbers (public_calls.py,
fit_calls.py, test_quantities.py); these are made, and made again with wrong arguments. Scenarios,
runs, maps, ensembles and fits are added here.
"""

import inspect
import os
import pathlib
import sys
import tempfile
import warnings

HERE = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(HERE / "python/tests"), str(HERE / "tests")]
EXAMPLES = HERE / "examples"

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import polhode  # noqa: E402
import public_calls  # noqa: E402
import public_names  # noqa: E402
import test_quantities  # noqa: E402

DEEPEST = 4
MOST = 4000  # values listed of one array


def said(case, field, text):
    """One line; the folders of this side are cut out."""
    for folder in (HERE, pathlib.Path.cwd()):
        text = text.replace(f"{folder}/", "").replace(str(folder), "")
    line = text.replace("\\", "\\\\").replace("\t", "\\t").replace("\n", "\\n").replace("\r", "\\r")
    print(case, field, line, sep="\t")


def listed(case, field, value, depth=0):
    """All numbers, texts and public attributes of a value."""
    if isinstance(value, (float, np.floating)):
        said(case, field, float(value).hex())
    elif isinstance(value, (bool, np.bool_, int, np.integer, str, bytes, type(None))):
        said(case, field, repr(value.item() if isinstance(value, np.generic) else value))
    elif isinstance(value, (complex, np.complexfloating)):
        listed(case, field + ".real", value.real)
        listed(case, field + ".imag", value.imag)
    elif isinstance(value, np.ndarray):
        said(case, field, f"{value.dtype} {value.shape}")
        for k, item in enumerate(value.ravel()[:MOST].tolist()):
            listed(case, f"{field}[{k}]", item, depth + 1)
    elif depth > DEEPEST:
        return
    elif isinstance(value, dict) or hasattr(value, "keys"):
        for key in value.keys():
            listed(case, f"{field}[{key!r}]", value[key], depth + 1)
    elif isinstance(value, (list, tuple)):
        for k, item in enumerate(value):
            listed(case, f"{field}[{k}]", item, depth + 1)
    elif type(value).__module__.startswith("polhode"):
        try:
            text = repr(value)
        except Exception as error:
            text = f"{type(error).__name__}: {error}"
        said(case, field, type(value).__name__ if " at 0x" in text else text)
        attributes_of(case, field, value, depth)
    else:  # of another package
        said(case, field, type(value).__name__)


def attributes_of(case, field, value, depth):
    for name in dir(type(value)):
        of_class = inspect.getattr_static(type(value), name)
        if not name.startswith("_") and not callable(of_class) and not isinstance(
                of_class, (classmethod, staticmethod)):
            try:
                found = getattr(value, name)
            except Exception as error:
                found = f"{type(error).__name__}: {error}"
            if not callable(found) and not isinstance(found, type(value)):
                listed(case, f"{field}.{name}", found, depth + 1)


def called(case, function, *arguments, **keywords):
    """Lists the result or the exception, and the warnings."""
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        try:
            result = function(*arguments, **keywords)
        except Exception as error:
            result = f"{type(error).__name__}: {error}"
    for warning in seen:
        if issubclass(warning.category, (UserWarning, RuntimeWarning)):
            said(case, "warning", str(warning.message))
    listed(case, "", result)
    return result


def of_tests():
    for call in public_calls.all_calls():
        called(call.name, call)
    tables = [test_quantities.fit_calls.of_fits(), test_quantities.no_figures(pathlib.Path.cwd()),
              {f"elliptic.{k}": of for k, of in test_quantities.of_elliptic().items()}]
    for table in tables:
        for name, (function, numbers, others) in table.items():
            called(name, function, **others, **numbers)


def refused(case, function, **keywords):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            function(**keywords)
        except Exception as error:
            said(case, "refused", f"{type(error).__name__}: {error}")
        else:
            said(case, "refused", "no")


def refusals():
    """Each number in turn is replaced by NaN, a text and None."""
    for call in public_calls.all_calls():
        for name in call.numbers:
            value = test_quantities.sample(call, name)
            for item in (float("nan"), "text", None):
                refused(f"{call.name}({name} = {item})", call,
                        **{name: test_quantities.with_item(value, item)})


def of_figures():
    """Coordinates of the lines and points of each figure."""
    for name, (function, numbers, others) in test_quantities.of_figures(pathlib.Path.cwd()).items():
        called(f"figures.{name}", function, **others, **numbers)
        for k, axes in enumerate(axes for n in plt.get_fignums() for axes in plt.figure(n).axes):
            drawn = {"title": axes.get_title(), "x": axes.get_xlabel(), "y": axes.get_ylabel(),
                     "lines": [line.get_xydata() for line in axes.lines],
                     "points": [np.asarray(of.get_offsets()) for of in axes.collections]}
            listed(f"figures.{name}", f"axes[{k}]", drawn)
        plt.close("all")


def of_elliptic_arrays():
    m, phi = np.linspace(0.0, 1.0, 33), np.linspace(-7.0, 7.0, 33)
    for name, (function, numbers, _) in test_quantities.of_elliptic().items():
        for of_m in ({"m": m, "m1": 1 - m}, {"m": m[::-1] ** 8, "m1": 1 - m[::-1] ** 8}):
            called(f"elliptic.{name} of arrays", function,
                   **{key: of_m.get(key, phi) for key in numbers})


def of_scenarios():
    for path in sorted(EXAMPLES.glob("*.toml")):
        called(f"load {path.stem}", polhode.load, path)
    small = polhode.load(EXAMPLES / "apophis.toml").replace({"time.stop": 100})
    called("run", small.run)
    for suffix in ("csv", "h5"):
        called(f"run to {suffix}", small.run, f"a.{suffix}")
    driven = polhode.load(HERE / "tools/bitwise/scenarios/long.toml").replace({"time.stop": 20})
    called("run under a torque", driven.run)
    section = polhode.load(EXAMPLES / "hyperion-section.toml").replace({"time.stop": 200})
    for threads in (1, 2):
        called(f"map, {threads} threads", section.map, threads=threads)
    members = HERE / "tools/bitwise/scenarios/ensemble.toml"
    for keep in ("statistics", "final", "rows"):
        for threads in (1, 2):
            called(f"ensemble {keep}, {threads} threads", polhode.load(members).ensemble, size=24,
                   keep=keep, threads=threads)
    called("fit of light, searched", searched_light)


def searched_light():
    nights = HERE / "tools/bitwise/scenarios/fit-light.toml"
    polhode.fit.simulate(nights, "night")
    pathlib.Path("night/fit.toml").write_bytes(nights.read_bytes())
    searched = polhode.load("night/fit.toml").replace({"fit.from": "search"})
    return polhode.fit.fit_scenario(searched, starts=4, threads=2)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, thing in sorted(public_names.PUBLIC.items()):
            said("names", name, type(thing).__name__)
        of_tests()
        of_figures()
        refusals()
        of_elliptic_arrays()
        of_scenarios()
