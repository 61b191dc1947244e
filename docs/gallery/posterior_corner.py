# SPDX-License-Identifier: MIT
"""The posterior of Toutatis in December 1992

Draws from the posterior of the fit of 17 attitudes by radar: rates in the middle of the
observations and ratios of moments, with errors as large as the residuals say. Needs
`pip install polhode[sample]`.
"""

import polhode
from polhode import figures

(solution,) = polhode.fit("examples/toutatis-1992.toml").solutions
draws = solution.sample(scaled=True, draws=600, seed=1)
columns = ["w_x", "w_y", "w_z", "Ixx/Izz", "Iyy/Izz"]
figures.save(figures.corner_plot(draws, columns), "posterior_corner.png")
