# SPDX-License-Identifier: MIT
"""How far MuJoCo drifts from the exact rotation

Two golden cases, torque-free, in MuJoCo: a body that wobbles about its short axis (top), and
one that spins about its intermediate axis and turns over (bottom). Error of attitude, of the
kinetic energy and of the angular momentum in space against the exact motion, for three of its
integrators and two steps. Black dots: polhode's FreeRotation against the golden states. 16 and
18 turns; a step of 0.01 is about 0.01 rad. Errors below 1e-17 are drawn there. What to
conclude, and a table: [polhode next to MuJoCo](mujoco.md)."""

import mujoco
import numpy as np
import polhode
from polhode import figures
from polhode.charts import inertial_momentum

CASES = ("sam", "near-b2")
INTEGRATORS = ("Euler", "implicit", "RK4")
STEPS = (0.01, 0.002, 0.001)
SAME = ("implicitfast", "discrete")  # for one free body these turn out to be `implicit`
STOP, ROWS = 100, 400  # STOP / ROWS is a whole number of steps
FLOOR = 1e-17  # a logarithmic axis has no zero

MODEL = """<mujoco>
  <option timestep="{step!r}" integrator="{integrator}" gravity="0 0 0">
    <flag gravity="disable" contact="disable" constraint="disable"/>
  </option>
  <worldbody><body><freejoint/>
    <inertial pos="0 0 0" mass="1" diaginertia="{I[0]!r} {I[1]!r} {I[2]!r}"/>
  </body></worldbody>
</mujoco>"""


def engine(case, integrator, step):
    """Times and states of MuJoCo. Its quaternion is (w, x, y, z), body to world, and the angular
    velocity of a free joint is along the body axes: polhode's conventions."""
    text = MODEL.format(step=step, integrator=integrator, I=[float(I) for I in case.moments])
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.qpos[3:] = case.q0 / np.linalg.norm(case.q0)
    data.qvel[3:] = case.omega0
    each = round(STOP / ROWS / step)
    rows = []
    for _ in range(ROWS):
        mujoco.mj_step(model, data, nstep=each)
        rows.append([*data.qpos[3:], *data.qvel[3:]])
    q, omega = np.split(np.array(rows), [4], axis=1)
    t = step * each * np.arange(1, ROWS + 1)
    return t, polhode.RotorState(q, case.moments * omega)


def angle(q, exact):
    """Angle (rad) between attitudes; q and -q are the same one."""
    d = np.minimum(np.linalg.norm(q - exact, axis=-1), np.linalg.norm(q + exact, axis=-1))
    return 4 * np.arcsin(d / 2)


def motion_of(case):
    body = polhode.Body(*case.moments)
    return polhode.FreeRotation(body, polhode.rotor_state(body, case.q0, case.omega0))


def errors(case, t, states):
    """Of attitude (rad), energy and momentum (relative), against the exact motion."""
    motion = motion_of(case)
    momentum = inertial_momentum(states) - inertial_momentum(motion.initial_state)
    return np.array(
        [
            angle(states.q, motion.at(t).q),
            polhode.kinetic_energy(motion.body, states) / motion.energy - 1,
            np.linalg.norm(momentum, axis=-1) / motion.momentum,
        ]
    )


def exact_errors(case):
    """The same errors of polhode itself, its attitude against the golden states."""
    golden = (case.t > 0) & (case.t <= STOP)
    states = motion_of(case).at(case.t[golden])
    found = errors(case, case.t[golden], states)
    found[0] = angle(states.q, case.q[golden])
    return case.t[golden], found


def draw(row, t, found, **look):
    for ax, error in zip(row, np.maximum(np.abs(found), FLOOR)):
        ax.loglog(t, error, **look)


def table_row(case, integrator, step, t, found):
    ten = found[0, np.argmin(np.abs(t - 10))]
    cells = [f"{ten:.1e}", f"{found[0, -1]:.1e}", f"{found[1, -1]:+.1e}", f"{found[2, -1]:.1e}"]
    return f"| {case.name} | {integrator} | {step:g} | " + " | ".join(cells) + " |"


def dress(panels):
    for ax, title in zip(panels[0], ("attitude (rad)", "energy (relative)", "momentum (relative)")):
        ax.set_title(f"error of {title}")
    for ax, text in zip(panels[:, 0], ("wobble (sam)", "turning over (near-b2)")):
        ax.set_ylabel(text)
    for ax in panels.flat:
        ax.set_ylim(3e-18, 10)
    for ax in panels[1]:
        ax.set_xlabel("$t$")
    lines = panels[0, 0].get_legend_handles_labels()
    panels[0, 0].figure.legend(*lines, loc="outside lower center", ncols=4)


cases = [case for name in CASES for case in polhode.free.golden_cases() if case.name == name]
print(f"MuJoCo {mujoco.__version__}, polhode {polhode.__version__}\n")
print("| case | integrator | step | attitude, t = 10 | attitude, t = 100 | energy | momentum |")
print("|---|---|---|---|---|---|---|")
with figures.style.style():
    panels = figures.style.panels(None, 2, 3, (figures.DOUBLE_COLUMN, 3.9), sharex=True)
    for row, case in zip(panels, cases):
        for k, integrator in enumerate(INTEGRATORS):
            for step in STEPS:
                t, states = engine(case, integrator, step)
                found = errors(case, t, states)
                print(table_row(case, integrator, step, t, found))
                if step != STEPS[-1]:  # the finest only in the table
                    look = figures.series(k).line | {"linewidth": 1.1 if step == STEPS[0] else 0.5}
                    draw(row, t, found, label=f"{integrator}, step {step:g}", **look)
        draw(row, *exact_errors(case), color="black", marker="o", ls="", ms=2.5, label="polhode")
    dress(panels)
figures.save(panels, "mujoco_drift.png")

for name in SAME:
    pairs = [(engine(case, name, 0.01)[1], engine(case, "implicit", 0.01)[1]) for case in cases]
    far = max(np.max(angle(one.q, other.q)) for one, other in pairs)
    print(f"\n`{name}` differs from `implicit` by {far:.0e} rad at most.")
