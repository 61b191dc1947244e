# SPDX-License-Identifier: MIT
"""A new user's first minutes with a wheel, in a root that has none of our libraries; and what shows
that the root is bare: without any one of the wheel's own libraries nothing works."""

import shutil
import subprocess
import sys

from bare_root import BareRoot
from static_hdf5 import run

PICTURE = """
import polhode
from polhode import figures

results = polhode.load("/home/apophis.toml").run()
figures.save(figures.overview(results), "/home/apophis.png")
print(len(results.t), "states drawn")
"""


def wheelhouse(folder, python, wheel):
    """The wheels that pip needs beside ours: what a machine with a network would download."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    version = run(python, "-c", "import sys; print('%d.%d' % sys.version_info[:2])").strip()
    run(sys.executable, "-m", "pip", "download", "--quiet", "--only-binary=:all:",
        f"--python-version={version}", "--dest", folder, f"{wheel}[figures]")
    return folder


def same_bytes(inside, program, scenario, folder):
    """The program of the wheel and that of the build tree write the same rows."""
    outside = folder / "outside.csv"
    subprocess.run([program, "run", scenario, "--out", outside], check=True,
                   stdout=subprocess.DEVNULL)
    if inside.read_bytes() != outside.read_bytes():
        raise SystemExit(f"wheel: {inside} is not what {program} writes")


def try_without(root, site, name):
    """With one of its libraries gone the package must not import: nothing else offers it."""
    library = root.path(site) / "polhode.libs" / name
    hidden = library.with_name("hidden")
    library.rename(hidden)
    said, _ = root.run("/home/venv/bin/python", "-c", "import polhode", status=1)
    hidden.rename(library)
    if f"{name}: cannot open shared object file" not in said:
        raise SystemExit(f"wheel: without {name}: {said}")


def try_wheel(wheel, own, python, build, checkout, keep_root=False):
    wheels = wheelhouse(build / "wheelhouse", python, wheel)
    root = BareRoot(build / "bare-root", python)
    for path in wheels.glob("*.whl"):
        shutil.copy(path, root.path("/home"))
    scenario = checkout / "examples/apophis.toml"
    shutil.copy(scenario, root.path("/home/apophis.toml"))
    times = {}

    def timed(what, *command):
        said, times[what] = root.run(*command)
        return said

    timed("python -m venv", root.python, "-m", "venv", "/home/venv")
    timed("pip install WHEEL[figures]", "/home/venv/bin/python", "-m", "pip", "install", "--quiet",
          "--no-index", "--find-links", "/home", f"/home/{wheel.name}[figures]")
    command = "/home/venv/bin/polhode"
    timed("the first picture", "/home/venv/bin/python", "-c", PICTURE)
    timed("polhode --version", command, "--version")
    timed("polhode run --out csv, h5", command, "run", "/home/apophis.toml",
          "--out", "/home/a.csv", "--out", "/home/a.h5")
    said = timed("polhode spectrum of h5", command, "spectrum", "/home/a.h5", "--column", "w1")
    if "amplitude" not in said:
        raise SystemExit(f"wheel: polhode spectrum: {said}")
    picture = root.path("/home/apophis.png").read_bytes()
    if not picture.startswith(b"\x89PNG") or len(picture) < 20_000:
        raise SystemExit("wheel: the first picture is none")
    program = build / "release/polhode"
    if program.exists():
        same_bytes(root.path("/home/a.csv"), program, scenario, build)
    version = run(python, "-c", "import sys; print('%d.%d' % sys.version_info[:2])").strip()
    for name in sorted(own):
        try_without(root, f"/home/venv/lib/python{version}/site-packages", name)
    print("in a root with the libraries " + ", ".join(sorted(root.libraries)) + ":")
    for what, seconds in times.items():
        print(f"  {what:28} {seconds:6.2f} s")
    first = times["pip install WHEEL[figures]"] + times["the first picture"]
    print(f"  from pip install to the first picture, downloads left out: {first:.1f} s")
    print(f"  without any one of {', '.join(sorted(own))}: no import, as it must be", flush=True)
    if not keep_root:
        shutil.rmtree(root.root)
