// SPDX-License-Identifier: MIT
// kind = "nutation".
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "polhode/scenario/planet_nutation.hpp"
#include "polhode/text/epoch.hpp"
#include "scenario/detail/nutation_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

enum class Planet { earth, venus, mars };

struct Arguments {
  Planet planet;
  std::string epoch;
  std::optional<double> ellipticity, triaxiality, spin_rate, obliquity, satellite_mass;
  double least;
};

constexpr KindKey<Arguments> keys[] = {
    choice_key<&Arguments::planet, Planet::earth, Planet::venus, Planet::mars>(
        "planet", "earth|venus|mars",
        "Whose nutation: the Earth under Moon and Sun, or another under the Sun.")
        .required()
        .example("\"earth\""),
    epoch_key<&Arguments::epoch>(
        "epoch", "The date of t = 0. The obliquity and the eccentricities are those of then.")
        .otherwise("\"JD 2451545.0 TDB\"")
        .shown(),
    quantity_key<&Arguments::ellipticity>("ellipticity", Dimension::number,
                                          "H = (C - (A + B)/2) / C. Left out, that of the planet.")
        .example("0.0032737548")
        .positive(),
    quantity_key<&Arguments::triaxiality>("triaxiality", Dimension::number,
                                          "(B - A) / C. Left out, that of the planet.")
        .example("0.0")
        .not_negative(),
    quantity_key<&Arguments::spin_rate>("spin_rate", Dimension::rate,
                                        "Left out, that of the planet.")
        .example("\"7.292115e-5 rad/s\"")
        .positive(),
    quantity_key<&Arguments::obliquity>(
        "obliquity", Dimension::angle,
        "Of the mean equator on the orbit of date. Left out, that of the planet at the epoch.")
        .example("\"84381.406 arcsec\"")
        .positive(),
    quantity_key<&Arguments::satellite_mass>(
        "satellite_mass", Dimension::number,
        "Mass of the Moon over that of the Earth. Left out, that of DE440.")
        .example("0.0123000371")
        .positive(),
    quantity_key<&Arguments::least>("least", Dimension::angle, "Smaller terms are left out.")
        .otherwise("\"1 uas\"")
        .positive(),
};

// In the core unit of time of the file; the theory counts seconds.
double second_of(const ExperimentContext& at) {
  return at.units().to_core(1.0, "s", Dimension::time);
}

PlanetNutation request_of(const Arguments& a, const ExperimentContext& at) {
  PlanetNutation of;
  of.planet = a.planet == Planet::earth ? "earth" : a.planet == Planet::venus ? "venus" : "mars";
  of.T = at.built("epoch", [&] { return julian_centuries(epoch_date(a.epoch)); });
  of.ellipticity = a.ellipticity;
  of.triaxiality = a.triaxiality;
  if (a.spin_rate) of.spin_rate = *a.spin_rate * second_of(at);
  of.obliquity = a.obliquity;
  of.satellite_mass = a.satellite_mass;
  of.least = a.least;
  return of;
}

// Longitude and obliquity of the axes of momentum, figure and rotation; the last once more for the
// rate relative to the ecliptic of date.
OwnExperiment made(const Arguments& a, const ExperimentContext& at) {
  const PlanetNutation of = completed(request_of(a, at));
  const auto theory = std::make_shared<const NutationTheory>(nutation_theory(of));
  std::vector<OwnColumn> columns;
  for (const char* const axis : {"momentum", "figure", "rotation", "relative"})
    for (const char* const angle : {"dpsi_", "deps_"})
      columns.push_back({std::string(angle) + axis, Dimension::angle});
  OwnExperiment own{.kind = "nutation", .rows = at.rows(), .columns = std::move(columns)};
  const double second = second_of(at);
  own.formula = [theory, second](double t_core, std::span<double> row) {
    const double t = t_core / second;
    const NutationOffset momentum = theory->at(PlanetAxis::momentum, t);
    const NutationOffset figure = theory->at(PlanetAxis::figure, t);
    const NutationOffset rotation = theory->at(PlanetAxis::rotation, t);
    const NutationOffset moved = theory->relative_offset();
    const std::array<double, 8> all = {momentum.longitude,
                                       momentum.obliquity,
                                       figure.longitude,
                                       figure.obliquity,
                                       rotation.longitude,
                                       rotation.obliquity,
                                       rotation.longitude + moved.longitude,
                                       rotation.obliquity + moved.obliquity};
    std::copy(all.begin(), all.end(), row.begin());
  };
  const NutationOffset precession = theory->precession();
  own.facts = {
      {"ellipticity", "dynamical ellipticity H", *of.ellipticity, Dimension::number},
      {"obliquity", "mean obliquity at t = 0", *of.obliquity, Dimension::angle},
      {"precession", "precession in longitude", precession.longitude / second, Dimension::rate},
      {"obliquity_rate", "rate of the mean obliquity", precession.obliquity / second,
       Dimension::rate},
      {"terms", "terms of the axis of figure",
       static_cast<double>(theory->terms(PlanetAxis::figure).size()), Dimension::number}};
  return own;
}

}  // namespace

ExperimentKind nutation_kind() {
  return experiment_kind<Arguments>(
      "nutation",
      "Nutation of a rigid planet: how its axes of momentum, figure and rotation swing.", keys,
      made, nutation_citations());
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
