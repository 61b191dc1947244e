# SPDX-License-Identifier: MIT
"""MuJoCo, which steps: the free rotation of one body over a hundred turns, at steps of its own.

MuJoCo knows no orbit, so its workload is plain free rotation, where polhode needs no steps at all;
polhode's integrator stands beside it as well. Attitudes are compared with the textbook form at 50
digits.
"""

import subprocess

import numpy as np
from timing import Contender, interleaved

MOMENTS = (0.9, 1.0, 1.1)
RATES = (5.0, 4.0, 7.5)
MOMENTUM = tuple(i * w for i, w in zip(MOMENTS, RATES, strict=True))
STOP = 64.0  # 100 turns; all steps are parts of it
MODEL = """<mujoco>
  <option gravity="0 0 0" integrator="{integrator}" timestep="{step!r}">
    <flag contact="disable" constraint="disable"/>
  </option>
  <worldbody><body>
    <joint type="ball"/>
    <inertial pos="0 0 0" mass="1" diaginertia="{moments}"/>
  </body></worldbody>
</mujoco>"""


def mujoco_contenders(mujoco):
    def run(integrator, step):
        model = mujoco.MjModel.from_xml_string(MODEL.format(
            integrator=integrator, step=step, moments=" ".join(map(repr, MOMENTS))))
        data = mujoco.MjData(model)

        def once():
            mujoco.mj_resetData(model, data)
            data.qvel[:] = RATES
            mujoco.mj_step(model, data, nstep=round(STOP / step))
            return 1, np.array(data.qpos)
        return once

    return [Contender(f"MuJoCo {integrator}", f"{step:g}", run(integrator, step))
            for integrator, powers in (("RK4", (6, 8, 10, 12)), ("implicitfast", (8, 12, 15)))
            for step in (2.0 ** -power for power in powers)]


def polhode_contenders():
    import polhode as ph
    body, start = ph.Body(*MOMENTS), ph.RotorState([1, 0, 0, 0], MOMENTUM)

    def free():
        for _ in range(100):
            end = ph.FreeRotation(body, start).at(STOP)
        return 100, np.array(end.q)

    def run(method):
        problem = ph.Problem(ph.System(body), start, 0.0, STOP, method)

        def once():
            return 1, np.array(ph.integrate(problem, [STOP], dense=False).q[-1])
        return once

    methods = [("Adaptive", "1e-10", ph.Adaptive(1e-10)), ("Adaptive", "1e-15", ph.Adaptive(1e-15)),
               ("Collocation", "default", ph.Collocation())]
    return [Contender("polhode FreeRotation", "prepared and asked once", free),
            *(Contender(f"polhode {who}", setting, run(m)) for who, setting, m in methods)]


def error_of(program, moments, momentum, t, q):
    """Of the attitude q at a time, by the textbook form."""
    rates = [g / i for g, i in zip(momentum, moments, strict=True)]
    rows = [(0.0, 1.0, 0.0, 0.0, 0.0, *rates), (t, *q, *rates)]
    text = "\n".join(" ".join(repr(float(x)) for x in row) for row in rows)
    done = subprocess.run([program, *(repr(float(x)) for x in (*moments, *momentum))], input=text,
                          check=True, text=True, stdout=subprocess.PIPE)
    return float(done.stdout)


def measured(options, program, missing):
    try:
        import mujoco
    except ImportError:
        missing("MuJoCo")
        return []
    if not program.exists():
        missing(f"{program.name} (not built)")
        return []
    found = interleaved(polhode_contenders() + mujoco_contenders(mujoco), options.repetitions)
    return [{"who": t.who, "setting": t.setting, "seconds": t.median, "repetitions": t.seconds,
             "error": error_of(program, MOMENTS, MOMENTUM, STOP, t.ends[0])} for t in found]
