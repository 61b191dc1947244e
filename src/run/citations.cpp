// SPDX-License-Identifier: MIT
#include <algorithm>
#include <span>
#include <string_view>
#include <variant>

#include "polhode/detail/scenario/fit_plan.hpp"
#include "polhode/run/run.hpp"
#include "polhode/scenario/schema.hpp"
#include "run/detail/experiments.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

struct Paper {
  std::string_view key;
  std::string_view text;
  std::string_view reason;
  // What of a scenario rests on it, parts_of joined by "|"; empty: every scenario.
  std::string_view uses;
};

// The place in the list of a work that a kind of torque, a method or an output format cites. Those
// that have none come last.
constexpr Paper of_kind(std::string_view key) { return {key, {}, {}, {}}; }
// The place of those that charts rest on.
constexpr Paper of_charts = {};

constexpr Paper papers[] = {
    {"gurfil2007",
     "Gurfil, P., Elipe, A., Tangren, W., Efroimsky, M. (2007). The Serret-Andoyer formalism in "
     "rigid-body dynamics: I. Symmetries and perturbations. Regular and Chaotic Dynamics 12, "
     "389-425.",
     "the equations and the notation", ""},
    {"jacobi1850",
     "Jacobi, C. G. J. (1850). Sur la rotation d'un corps. Journal fuer die reine und angewandte "
     "Mathematik 39, 293-350.",
     "the attitude in theta functions", "rotation"},
    {"carlson1995",
     "Carlson, B. C. (1995). Numerical computation of real or complex elliptic integrals. "
     "Numerical Algorithms 10, 13-26.",
     "the elliptic integrals", "rotation"},
    {"kaasalainen2001",
     "Kaasalainen, M. (2001). Interpretation of lightcurves of precessing asteroids. Astronomy "
     "and Astrophysics 376, 302-309.",
     "the observers' description of a tumbler", "tumbler"},
    {"pravec2014",
     "Pravec, P., et al. (2014). The tumbling spin state of (99942) Apophis. Icarus 233, 48-60.",
     "the convention of its angles", "tumbler"},
    of_charts,
    {"efroimsky2007",
     "Efroimsky, M., Escapa, A. (2007). The theory of canonical perturbations applied to attitude "
     "dynamics and to the Earth rotation. Osculating and nonosculating Andoyer variables. "
     "Celestial "
     "Mechanics and Dynamical Astronomy 98, 251-283.",
     "osculating and canonical elements, and which angular velocity is which",
     "moving frame|convective|omega_rel|andoyer_osc|euler_osc|axes_rel"},
    of_kind("wertz1978"),
    of_kind("montenbruck2000"),
    of_kind("schaaf1961"),
    {"markley1995",
     "Markley, F. L. (1995). Kepler equation solver. Celestial Mechanics and Dynamical Astronomy "
     "63, 101-111.",
     "orbits", "orbit"},
    {"erfa",
     "ERFA, Essential Routines for Fundamental Astronomy, from the SOFA software of the "
     "International Astronomical Union. github.com/liberfa/erfa.",
     "positions of Sun, Moon and planets, and time scales", "ephemeris"},
    {"moisson2001",
     "Moisson, X., Bretagnon, P. (2001). Analytical planetary solution VSOP2000. Celestial "
     "Mechanics and Dynamical Astronomy 80, 205-213.",
     "positions of the Earth", "earth"},
    {"meeus1998",
     "Meeus, J. (1998). Astronomical Algorithms, 2nd edition. Willmann-Bell, Richmond.",
     "positions of the Moon", "moon"},
    {"simon1994",
     "Simon, J. L., Bretagnon, P., Chapront, J., Chapront-Touze, M., Francou, G., Laskar, J. "
     "(1994). Numerical expressions for precession formulae and mean elements for the Moon and the "
     "planets. Astronomy and Astrophysics 282, 663-683.",
     "positions of the planets, mean elements of the Moon", "planet|moon"},
    {"park2021",
     "Park, R. S., Folkner, W. M., Williams, J. G., Boggs, D. H. (2021). The JPL planetary and "
     "lunar ephemerides DE440 and DE441. The Astronomical Journal 161, 105.",
     "gravitational parameters", "DE440"},
    {"ccsds502",
     "Consultative Committee for Space Data Systems (2023). Orbit Data Messages. Recommended "
     "Standard CCSDS 502.0-B-3.",
     "the file of an orbit", "oem"},
    of_kind("ccsds504"),
    of_kind("praly2012"),
    of_kind("thebault2015"),
    of_kind("verner2010"),
    of_kind("butcher1964"),
    of_kind("antonana2017"),
    of_kind("celledoni2008"),
    of_kind("blanesmoan2002"),
    of_kind("kahanli1997"),
    of_kind("blanes2013"),
    {"benettin1976",
     "Benettin, G., Galgani, L., Strelcyn, J.-M. (1976). Kolmogorov entropy and numerical "
     "experiments. Physical Review A 14, 2338-2345.",
     "the Lyapunov indicator", "chaos"},
    {"cincotta2000",
     "Cincotta, P. M., Simo, C. (2000). Simple tools to study global dynamics in non-axisymmetric "
     "galactic potentials - I. Astronomy and Astrophysics Supplement Series 147, 205-228.",
     "MEGNO", "chaos"},
    {"laskar1993",
     "Laskar, J., Robutel, P. (1993). The chaotic obliquity of the planets. Nature 361, 608-612.",
     "the mean motion of the spin axis", "obliquity"},
    {"touma1993",
     "Touma, J., Wisdom, J. (1993). The chaotic obliquity of Mars. Science 259, 1294-1297.",
     "the same in inertial axes", "obliquity"},
    {"archinal2018",
     "Archinal, B. A., et al. (2018). Report of the IAU working group on cartographic coordinates "
     "and rotational elements: 2015. Celestial Mechanics and Dynamical Astronomy 130, 22.",
     "the pole of the planet", "planet pole"},
    {"zeebe2022",
     "Zeebe, R. E., Lourens, L. J. (2022). A deep-time dating tool for paleo-applications "
     "utilizing obliquity and precession cycles. Paleoceanography and Paleoclimatology 37, "
     "e2021PA004349.",
     "the precession constant of the Earth", "spin of earth"},
    {"konopliv2016",
     "Konopliv, A. S., Park, R. S., Folkner, W. M. (2016). An improved JPL Mars gravity field and "
     "orientation from Mars orbiter and lander tracking data. Icarus 274, 253-260.",
     "the precession constant of Mars", "spin of mars"},
    {"nerondesurgy1997",
     "Neron de Surgy, O., Laskar, J. (1997). On the long term evolution of the spin of the Earth. "
     "Astronomy and Astrophysics 318, 975-989.",
     "tides of constant time lag", "tides"},
    {"berger1978",
     "Berger, A. (1978). Long-term variations of daily insolation and Quaternary climatic changes. "
     "Journal of the Atmospheric Sciences 35, 2362-2367.",
     "insolation", "insolation"},
    {"salmon2011",
     "Salmon, J. K., Moraes, M. A., Dror, R. O., Shaw, D. E. (2011). Parallel random numbers: as "
     "easy as 1, 2, 3. SC '11: Proceedings of 2011 International Conference for High Performance "
     "Computing, Networking, Storage and Analysis, article 16.",
     "the random numbers of an ensemble", "ensemble"},
    {"joe2008",
     "Joe, S., Kuo, F. Y. (2008). Constructing Sobol sequences with better two-dimensional "
     "projections. SIAM Journal on Scientific Computing 30, 2635-2654.",
     "Sobol's points", "sobol"},
    {"more1978",
     "More, J. J. (1978). The Levenberg-Marquardt algorithm: implementation and theory. Lecture "
     "Notes in Mathematics 630, 105-116.",
     "the fit", "fit"},
    of_kind("mignard1979"),
    of_kind("hut1981"),
    of_kind("burns1973"),
    of_kind("kane1966"),
    of_kind("fritsch1984"),
};

void add_each_once(std::vector<Citation>& all, std::span<const Citation> more) {
  for (const Citation& own : more)
    if (std::none_of(all.begin(), all.end(),
                     [&](const Citation& one) { return one.key == own.key; }))
      all.push_back(own);
}

// Of the charts of its state and of its columns, each once. Other kinds than the rotation have
// none.
std::vector<Citation> citations_of_charts(const Scenario& scenario) {
  std::vector<Citation> all;
  const auto* const rotation = std::get_if<Rotation>(&scenario.experiment);
  if (rotation == nullptr) return all;
  const std::vector<std::string>& groups = scenario.output.columns;
  for (const ChartKind& chart : scenario.document.kinds->charts())
    if (chart.name == rotation->chart ||
        std::find(groups.begin(), groups.end(), chart.name) != groups.end())
      add_each_once(all, chart.sources);
  return all;
}

// What moves it, its groups of columns that are no charts, the sources of its orbits, and what it
// asks for in addition to rows.
std::vector<std::string> parts_of(const Scenario& scenario) {
  std::vector<std::string> parts = detail::cited_parts(scenario);
  for (const std::string& group : scenario.output.columns)
    if (chart_named(group, scenario.document.kinds->charts()) == nullptr) parts.push_back(group);
  if (scenario.map && scenario.map->kind == MapKind::chaos) parts.push_back("chaos");
  if (scenario.ensemble) parts.push_back("ensemble");
  if (scenario.fit != nullptr) parts.push_back("fit");
  if (scenario.ensemble && scenario.ensemble->source == ensemble::DrawSource::sobol)
    parts.push_back("sobol");
  return parts;
}

// What the kinds of its torques and orbits cite, or its own kind.
std::vector<Citation> citations_of(const Rotation& rotation, const Kinds& kinds) {
  std::vector<Citation> all;
  for (const PerturbationKind& kind : kinds.perturbations())
    if (std::find(rotation.kinds.begin(), rotation.kinds.end(), kind.name) != rotation.kinds.end())
      add_each_once(all, kind.citations);
  for (const ScenarioOrbit& orbit : rotation.orbits)
    if (const OrbitKind* const kind = kinds.orbit(orbit.kind)) add_each_once(all, kind->citations);
  return all;
}
std::vector<Citation> citations_of(const Obliquity& of, const Kinds& kinds) {
  const OrbitKind* const kind = kinds.orbit(of.orbit_kind);
  return kind != nullptr ? kind->citations : std::vector<Citation>();
}
std::vector<Citation> citations_of(const CustomExperiment& own, const Kinds& kinds) {
  const ExperimentKind* const kind = kinds.experiment(own.kind);
  return kind == nullptr ? std::vector<Citation>{} : kind->citations;
}

// What the kinds of a scenario cite, its method, and the formats that it has something
// to say to.
std::vector<Citation> citations_of_kinds(const Scenario& scenario) {
  const Kinds& kinds = *scenario.document.kinds;
  std::vector<Citation> all =
      std::visit([&](const auto& kind) { return citations_of(kind, kinds); }, scenario.experiment);
  if (const std::optional<Method> method = propagation_method(scenario)) {
    const MethodKind* const kind = kinds.method(method_traits(*method).kind);
    if (kind != nullptr && kind->cited) add_each_once(all, kind->cited(*method));
  }
  if (const FitPlan* const plan = scenario.fit.get())
    for (const Observation& one : plan->observations)
      if (const ObservationKind* const kind = kinds.observation(one.kind))
        add_each_once(all, kind->citations);
  for (const ColumnKind& kind : kinds.columns().all())
    if (std::ranges::find(scenario.output.columns, kind.name) != scenario.output.columns.end())
      add_each_once(all, kind.citations);
  for (const OutputFormat& format : kinds.formats().all())
    if (scenario.output.options.contains(format.name)) add_each_once(all, format.citations);
  return all;
}

}  // namespace

std::vector<std::string> detail::cited_parts(const Rotation& rotation) {
  std::vector<std::string> parts = {"rotation"};
  if (!std::holds_alternative<ChartState>(rotation.state)) parts.push_back(rotation.chart);
  if (!rotation.frame.is_inertial()) parts.push_back("moving frame");
  for (const ScenarioOrbit& orbit : rotation.orbits) {
    if (!std::holds_alternative<TableOrbit>(orbit.motion)) parts.push_back("orbit");
    parts.insert(parts.end(), orbit.sources.begin(), orbit.sources.end());
  }
  return parts;
}

std::vector<Citation> citations(const Scenario& scenario) {
  const std::vector<std::string> parts = parts_of(scenario);
  const auto used = [&](std::string_view uses) {
    const std::vector<std::string_view> any = separated(uses, '|');
    return any.empty() || std::any_of(any.begin(), any.end(), [&](std::string_view part) {
             return std::find(parts.begin(), parts.end(), part) != parts.end();
           });
  };
  std::vector<Citation> own_works = citations_of_kinds(scenario);
  std::vector<Citation> result;
  for (const Paper& paper : papers) {
    const auto own = std::find_if(own_works.begin(), own_works.end(),
                                  [&](const Citation& one) { return one.key == paper.key; });
    if (paper.key.empty()) {
      add_each_once(result, citations_of_charts(scenario));
    } else if (own != own_works.end()) {
      result.push_back(*own);
      own_works.erase(own);
    } else if (!paper.text.empty() && used(paper.uses)) {
      result.push_back({paper.key, paper.text, paper.reason});
    }
  }
  result.insert(result.end(), own_works.begin(), own_works.end());
  return result;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
