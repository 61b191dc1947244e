# SPDX-License-Identifier: MIT
"""Makes debris-cloud.csv, the fragments of debris-cloud.toml: flat pieces of aluminium sheet."""

import math
import random

COLUMNS = "I1,I2,I3,M1,M2,M3,area,x,y,z,w1,w2,w3".split(",")  # kg m2, S m4, m2, m, deg/s


def torsion(a, b):
    """Saint-Venant's constant of a rectangle of sides a and b."""
    a, b = max(a, b), min(a, b)
    series = sum(math.tanh(k * math.pi * a / (2 * b)) / k**5 for k in range(1, 40, 2))
    return a * b**3 / 3 * (1 - 192 * b / (math.pi**5 * a) * series)


def fragment(chance):
    """Moments, magnetic tensor, area, its centre from the centre of mass, angular velocity."""
    # more than L long: as L^-1.71, from 0.1 m to 1 m (Johnson et al. 2001)
    a = (1 - chance.random() * (1 - 10**-1.71)) ** (-1 / 1.71) / 10
    b = a * (0.3 + 0.7 * chance.random())
    c = 0.001 * 10 ** chance.random()  # 1 mm to 1 cm thick
    m = 2700 * a * b * c
    moments = [m * (b * b + c * c) / 12, m * (a * a + c * c) / 12, m * (a * a + b * b) / 12]
    # Currents of a prism flow across its axis, along the lines of its torsion function. Holes and
    # seams take from the conductivity of the metal, 2.5e7 S/m, we cannot know how much.
    conductivity = 2.5e7 * chance.random()
    sides = [(a, b, c), (b, a, c), (c, a, b)]
    tensor = [conductivity * along * torsion(*across) / 4 for along, *across in sides]
    # the mass is not even: its centre is off by up to 5 % of the sides
    centre = [0.05 * (2 * chance.random() - 1) * side for side in (a, b, c)]
    rate = 0.05 * 10 ** chance.random()  # deg/s: one turn in 2 h to one in 12 min
    z, longitude = 2 * chance.random() - 1, 2 * math.pi * chance.random()
    across = math.sqrt(1 - z * z)
    spin = [rate * across * math.cos(longitude), rate * across * math.sin(longitude), rate * z]
    return [*moments, *tensor, a * b, *centre, *spin]


def digits(row):
    """Five of each number; no body has moments of which one is above the sum of the others."""
    text = [f"{x:.5g}" for x in row]
    if float(text[2]) > float(text[0]) + float(text[1]):
        text[2] = f"{row[2] * (1 - 5e-5):.5g}"
    return text


chance = random.Random(2009)
fragments = [fragment(chance) for _ in range(500)]
with open("debris-cloud.csv", "w", encoding="utf-8") as file:
    file.write(",".join(COLUMNS) + "\n")
    for row in fragments:
        file.write(",".join(digits(row)) + "\n")

areas = sorted(row[6] for row in fragments)
print(f"{len(fragments)} fragments, areas {1e4 * areas[0]:.0f} to {1e4 * areas[-1]:.0f} cm2, "
      f"half of them below {1e4 * areas[250]:.0f} cm2")
# Prints:
# 500 fragments, areas 34 to 9221 cm2, half of them below 130 cm2
