# SPDX-License-Identifier: MIT
"""Normal form of the triaxial rotor: how fast its error falls

A Lie transform removes l from the Hamiltonian of the free rotor, as a series in the triaxiality e.
Shown is its largest error against Sadov's closed form for momenta 10 and 30 degrees from the short
axis, orders 1 to 8. Left: the frequencies. Odd orders add nothing to them, since l -> l + 90 deg
changes the sign of e; the lines of orders 2 n and 2 n + 1 are one, of slope 2 n + 2. Right: the
mean angle l of a state, of slope order + 1.
"""

import numpy as np
import polhode
from polhode import figures
from polhode.series import LieTransform, Series, Symbols, Truncation

names = Symbols(["L", "G", "e"], ["l", "g"], [("l", "L"), ("g", "G")])
h = Series(names, "-L^2/2 - e/2*(G^2 - L^2)*cos(2*l)")  # (H - a G^2/2) / b
sizes = np.geomspace(5e-3, 0.4, 12)
G = 2.0


def errors(order):
    t = LieTransform(h, Truncation({"e": 1}, order), ["l"])
    rate, back = t.mean_hamiltonian.derivative("L"), t.short_period_back("l")
    worst = []
    for e in sizes:
        # a = 1, b = 1/4
        body = polhode.Body(1 / (1 + e / 4), 1 / (1 - e / 4), 4 / 3)
        of_rate = of_angle = 0.0
        for J in np.radians([10, 30]):
            for angle in (0.2, 1.0, 2.1, 3.9, 5.5):
                L = G * np.cos(J)
                state = polhode.AndoyerState(l=angle, g=0.7, h=0.3, L=L, G=G, H=1.1)
                motion = polhode.FreeRotation(body, polhode.to_rotor(state))
                sadov, exact = polhode.to_sadov(motion, 0.0), polhode.free.sadov_frequencies(motion)
                n_l = rate(L=sadov.I_l, G=G, e=e, l=0.0, g=0.0) / 4
                of_rate = max(of_rate, abs(n_l / exact.n_l - 1))
                mean = angle + back(L=L, G=G, e=e, l=angle, g=0.0)
                off = np.remainder(mean - sadov.phi_l - np.pi / 2 + np.pi, 2 * np.pi) - np.pi
                of_angle = max(of_angle, abs(off))
        worst.append((of_rate, of_angle))
    return np.array(worst).T


with figures.style.style():
    (panels,) = figures.style.panels(None, 1, 2, (figures.DOUBLE_COLUMN, 3.2))
    left, right = panels
    for order in range(1, 9):
        of_rate, of_angle = errors(order)
        for ax, error in zip(panels, (of_rate, of_angle)):
            ax.loglog(sizes, error, ".-", color=str(0.75 - 0.09 * order), lw=0.8)
        label = {1: "1", 2: "2, 3", 4: "4, 5", 6: "6, 7", 8: "8"}.get(order, "")
        left.annotate(f" {label}", (sizes[-1], of_rate[-1]), va="center", fontsize="small")
        first = np.flatnonzero(of_angle > 2e-15)[0]  # above rounding
        right.annotate(f"{order} ", (sizes[first], of_angle[first]), ha="right", va="center",
                       fontsize="small")  # fmt: skip
    left.set(xlabel="triaxiality e", ylabel="relative error of the frequency of l")
    right.set(xlabel="triaxiality e", ylabel="error of the mean l (rad)")
    for ax in panels:
        ax.set(ylim=(1e-16, 1), xlim=(4e-3, 0.6))
    figures.save(left, "normal_form.png")
