// SPDX-License-Identifier: MIT
// The theory of nutation for real planets: the rigid Earth under Moon and Sun, and planets under
// the Sun alone.
//
// Equations   those of NutationTheory. Earth: Delaunay's arguments, Moon and Sun of
//             their series in them. Others: a Kepler ellipse, with the mean anomaly M of
//             the planet and the mean longitude Ls of the Sun from the equinox as arguments.
// Units       km, s, rad; T in Julian centuries of TDB from J2000.
// Domain      earth, venus, mars; |T| <= 10. What is left out of a request is that of the planet:
//             Earth: H = 0.0032737548 (Souchay & Kinoshita 1996), no triaxiality, the obliquity and
//             the moving ecliptic of IAU 2006, masses of DE440. Venus: Cottereau & Souchay (2009).
//             Mars: Konopliv et al. (2016). Nothing here is fitted to a theory of nutation. Where
//             A < B, axis 1 is along the node at the epoch. satellite_mass is that of what pulls:
//             the positions of Moon and Sun stay as they are, and are counted from the equinox that
//             these numbers make. Orbit and obliquity of Venus and Mars are those of J2000 at every
//             epoch; their "ecliptic" is that orbit.
// Accuracy    docs/guide/nutation.md compares it with direct integration and published tables. The
//             mean longitudes advance evenly: some mas in a century from T, as
//             polhode/secular/nutation.hpp says.
// Errors      DomainError for other planets, a T or numbers out of their ranges, a satellite of a
//             planet that has none here.
// Cost        0.4 s for the Earth, some ms for others.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/ephemeris/date.hpp"
#include "polhode/secular/nutation.hpp"
#include "polhode/text/citation.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// That there is a theory of.
inline constexpr std::string_view nutation_planets = "earth|venus|mars";

struct PlanetNutation {
  std::string planet = "earth";
  double T = 0.0;                             // of the epoch
  std::optional<double> ellipticity = {};     // H = (C - (A + B)/2) / C
  std::optional<double> triaxiality = {};     // (B - A) / C
  std::optional<double> spin_rate = {};       // rad/s
  std::optional<double> obliquity = {};       // rad: of the equator on the orbit of date
  std::optional<double> satellite_mass = {};  // over that of the planet
  int order = 2;
  double least = 5e-12;  // rad: smaller terms, below 1 uas, are left out
};

// T of a date: from J2000, TDB.
double julian_centuries(const ephemeris::Date& date);

secular::NutationProblem nutation_problem(const PlanetNutation& of);
secular::NutationTheory nutation_theory(const PlanetNutation& of);

// The numbers that a request stands for, none left out.
PlanetNutation completed(const PlanetNutation& of);

// The works that the theory of any of the planets rests on.
std::vector<Citation> nutation_citations();

}  // namespace io
}  // namespace v0
}  // namespace polhode
