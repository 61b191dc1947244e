# SPDX-License-Identifier: MIT
"""Orekit's TorqueFree on Hipparchus (TorqueFree.java), where java and mvn are found.

Goals G1 and G5 from the languages that people call them from: polhode from Python, the other from
Java, its virtual machine warm. Every repetition goes from one to the other. Errors by the textbook
form at 50 digits.
"""

import pathlib
import shutil
import subprocess
import time

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
WHO = "Orekit's TorqueFree on Hipparchus"
JARS = ("hipparchus-core", "hipparchus-ode")
VERSION = "4.0.1"
COPY = "org.apache.maven.plugins:maven-dependency-plugin:3.6.1:copy"
FARTHEST = 62831.853  # 1e4 turns at a rate near 1
COUNT, CHECKED = 1024, 64
LEAST = 0.05  # seconds of a repetition


def compiled(folder):
    """The class path: jars of Maven's central repository, the driver beside them. None without."""
    if not (shutil.which("javac") and shutil.which("mvn")):
        return None
    home = folder / "java"
    try:
        for jar in JARS:
            if not (home / f"{jar}-{VERSION}.jar").exists():
                subprocess.run(["mvn", "-q", "-B", COPY, f"-DoutputDirectory={home.resolve()}",
                                f"-Dartifact=org.hipparchus:{jar}:{VERSION}"], check=True)
        path = ":".join([str(home), *(str(home / f"{jar}-{VERSION}.jar") for jar in JARS)])
        subprocess.run(["javac", "-cp", path, "-d", home, HERE / "TorqueFree.java"], check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return path


def start_of(k, random):
    """Moments, and a momentum in short-axis mode of modulus k at any phase, with a rate near 1."""
    a, b, c = random.uniform((1.5, 1.2, 0.8), (2.0, 1.45, 1.15)) ** 2
    A, B, C = moments = ((b + c) / 4.0, (a + c) / 4.0, (a + b) / 4.0)
    phi = random.uniform(-1.5, 1.5)
    x = k * np.sqrt((C - B) * A / ((B - A) * C))
    y = x * np.sqrt(B * (C - A) / (A * (C - B)))
    g = np.array([x * np.cos(phi), y * np.sin(phi), np.sqrt(1.0 - (k * np.sin(phi)) ** 2)])
    return moments, tuple(float(part) for part in B * g / np.linalg.norm(g))


def text_of(rows):
    return "\n".join(" ".join(repr(float(x)) for x in row) for row in rows)


class Java:
    """The driver's process: rows first, then a measurement for each question."""

    def __init__(self, path, numbers, folder):
        data = folder / "java/numbers.txt"
        data.write_text(text_of([x] for x in numbers))
        self.process = subprocess.Popen(
            ["java", "-cp", path, "TorqueFree", data], text=True, stdin=subprocess.PIPE,
            stdout=subprocess.PIPE)
        self.rows = [self.process.stdout.readline() for _ in range(CHECKED + 1)]
        self.process.stdout.readline()  # it is warm

    def nanoseconds(self, what):
        self.process.stdin.write(f"{what}\n")
        self.process.stdin.flush()
        return float(self.process.stdout.readline())

    def end(self):
        self.process.stdin.close()
        self.process.wait()


def own_nanoseconds(run, units):
    """Of processor time for a unit, until a repetition is full."""
    done, begin = 0, time.process_time()
    while True:
        run()
        done += units
        passed = time.process_time() - begin
        if passed >= LEAST:
            return 1e9 * passed / done


def lines(k, random, path, options, program):
    """The lines of two cases: many times of one body, and its preparation."""
    import polhode as ph
    moments, momentum = start_of(k, random)
    body, state = ph.Body(*moments), ph.RotorState([1, 0, 0, 0], momentum)
    motion, times = ph.FreeRotation(body, state), random.uniform(0.0, FARTHEST, COUNT)
    times[0] = 0.0
    java = Java(path, [*moments, *momentum, *times], options.folder)
    own = {"states": (lambda: motion.at(times), COUNT),
           "prepare": (lambda: ph.FreeRotation(body, state), 1)}
    s = motion.at(times[:CHECKED + 1])
    errors = {}
    for who, rows in ((WHO, "".join(java.rows)), ("polhode FreeRotation", text_of(
            np.column_stack([times[:CHECKED + 1], s.q, s.g / np.array(moments)])))):
        done = subprocess.run([program, *map(repr, (*map(float, moments), *momentum))], input=rows,
                              check=True, text=True, stdout=subprocess.PIPE)
        errors[who] = float(done.stdout)
    values = {(who, what): [] for who in errors for what in own}
    for _ in range(options.repetitions):
        for what, (run, units) in own.items():
            values["polhode FreeRotation", what].append(own_nanoseconds(run, units))
            values[WHO, what].append(java.nanoseconds(what))
    java.end()
    cases = {"states": ("G1", f"from Python and Java, {COUNT} times, k = {k:g}"),
             "prepare": ("G5", f"from Python and Java, k = {k:g}")}
    return [{"goal": cases[what][0], "case": cases[what][1], "who": who, "unit": "ns",
             "error": errors[who], "repetitions": values[who, what]} for who, what in values]


def measured(options, program, missing):
    path = compiled(options.folder) if program.exists() else None
    if path is None:
        missing(f"{WHO} (no java, mvn, Hipparchus or {program.name})")
        return []
    random = np.random.default_rng(options.seed)
    return [line for k in (0.5, 0.75, 0.9999) for line in lines(k, random, path, options, program)]
