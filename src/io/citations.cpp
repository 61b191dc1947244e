// SPDX-License-Identifier: MIT
#include "polhode/io/citations.hpp"

#include <algorithm>
#include <string_view>

namespace polhode {
inline namespace v0 {
namespace {

struct Paper {
  std::string_view key;
  std::string_view text;
  std::string_view reason;
  // Chart of [state] or group of [output] columns that rests on it; empty: every scenario.
  std::string_view uses;
};

constexpr Paper papers[] = {
    {"gurfil2007",
     "Gurfil, P., Elipe, A., Tangren, W., Efroimsky, M. (2007). The Serret-Andoyer formalism in "
     "rigid-body dynamics: I. Symmetries and perturbations. Regular and Chaotic Dynamics 12, "
     "389-425.",
     "the equations and the notation", ""},
    {"jacobi1850",
     "Jacobi, C. G. J. (1850). Sur la rotation d'un corps. Journal fuer die reine und angewandte "
     "Mathematik 39, 293-350.",
     "the attitude in theta functions", ""},
    {"carlson1995",
     "Carlson, B. C. (1995). Numerical computation of real or complex elliptic integrals. "
     "Numerical Algorithms 10, 13-26.",
     "the elliptic integrals", ""},
    {"kaasalainen2001",
     "Kaasalainen, M. (2001). Interpretation of lightcurves of precessing asteroids. Astronomy "
     "and Astrophysics 376, 302-309.",
     "the observers' description of a tumbler", "tumbler"},
    {"pravec2014",
     "Pravec, P., et al. (2014). The tumbling spin state of (99942) Apophis. Icarus 233, 48-60.",
     "the convention of its angles", "tumbler"},
    {"andoyer1923",
     "Andoyer, H. (1923). Cours de mecanique celeste, vol. 1. Gauthier-Villars, Paris.",
     "Andoyer variables", "andoyer"},
    {"serret1866",
     "Serret, J. A. (1866). Memoire sur l'emploi de la methode de la variation des arbitraires "
     "dans la theorie des mouvements de rotation. Memoires de l'Academie des sciences de Paris "
     "35, 585-616.",
     "Serret's elements", "serret"},
    {"sadov1970",
     "Sadov, Yu. A. (1970). The action-angle variables in the Euler-Poinsot problem. Journal of "
     "Applied Mathematics and Mechanics 34, 922-925.",
     "action-angle variables", "sadov"},
    {"kinoshita1972",
     "Kinoshita, H. (1972). First-order perturbations of the two finite body problem. "
     "Publications of the Astronomical Society of Japan 24, 423-457.",
     "action-angle variables, the form with Heuman's Lambda", "sadov"},
};

}  // namespace

std::vector<Citation> citations(const Scenario& scenario) {
  const auto used = [&](std::string_view part) {
    const std::vector<std::string>& columns = scenario.columns;
    return part.empty() || part == scenario.chart ||
           std::find(columns.begin(), columns.end(), part) != columns.end();
  };
  std::vector<Citation> result;
  for (const Paper& paper : papers)
    if (used(paper.uses))
      result.push_back(
          {std::string(paper.key), std::string(paper.text), std::string(paper.reason)});
  return result;
}

}  // namespace v0
}  // namespace polhode
