# SPDX-License-Identifier: MIT
"""Scenarios of these tests, and the command line that they are compared with."""

import pathlib
import subprocess

import pytest
from polhode import _core
from scenario_parts import BODY, STATE
from slowdown import SLOWDOWN

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.toml"))
TIME = "[time]\nstop = 10\nstep = 0.5\n"
FREE = BODY + STATE + TIME
# An attracting point that the body falls through: no method gets beyond t = 1.
COLLISION = (
    "[orbit.moon]\ngm = 1\npericentre = 1e-13\neccentricity = 1.0000000000000002\nepoch = 1\n"
    "[[perturbation]]\nkind = \"gravity-gradient\"\norbit = \"moon\"\n"
)
FAILING = BODY + STATE + COLLISION + "[time]\nstop = 2\nstep = 0.001\n"
ENDLESS = (
    BODY + STATE + "[[perturbation]]\nkind = \"constant-torque\"\ntorque = [1e-9, 0, 0]\n"
    "[time]\nstop = 1e9\nstep = 20\n"
)


def command_line(*arguments: object) -> str:
    """What the `polhode` of the same build prints."""
    program = pathlib.Path(_core.__file__).resolve().parents[2] / "polhode"
    if not program.exists():
        pytest.skip("an installed package has no command line with it")
    done = subprocess.run([program, *map(str, arguments)], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, check=True, timeout=120 * SLOWDOWN)
    return done.stdout
