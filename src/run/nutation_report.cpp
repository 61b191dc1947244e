// SPDX-License-Identifier: MIT
// The nutation of a rigid planet as text and as CSV.
#include "polhode/run/nutation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/version.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

constexpr double mas = std::numbers::pi / 648000.0e3;
constexpr double day = 86400.0;
constexpr double year = 365.25 * day;

const std::vector<secular::NutationTerm>& terms_of(const NutationReport& report) {
  const NutationRequest& of = report.request;
  return of.part == NutationPart::oppolzer ? report.theory.oppolzer_terms(of.axis)
                                           : report.theory.terms(of.axis);
}

secular::NutationOffset offset_of(const NutationReport& report) {
  const NutationRequest& of = report.request;
  secular::NutationOffset offset = report.theory.offset(of.axis);
  if (of.part == NutationPart::oppolzer) {
    const secular::NutationOffset momentum = report.theory.offset(secular::PlanetAxis::momentum);
    offset = {offset.longitude - momentum.longitude, offset.obliquity - momentum.obliquity};
  }
  if (of.relative) {
    const secular::NutationOffset by_ecliptic = report.theory.relative_offset();
    offset = {offset.longitude + by_ecliptic.longitude, offset.obliquity + by_ecliptic.obliquity};
  }
  return offset;
}

std::string what(const NutationRequest& of) {
  std::string text = of.part == NutationPart::oppolzer
                         ? fmt::format("Oppolzer terms of the axis of {}", secular::name(of.axis))
                         : fmt::format("nutation of the axis of {}", secular::name(of.axis));
  if (of.axis == secular::PlanetAxis::rotation)
    text +=
        of.relative ? ", of the rate relative to the ecliptic of date" : ", of the inertial rate";
  return text;
}

// Lines without an end.
std::vector<std::string> notes(const NutationReport& report) {
  const PlanetNutation& of = report.request.of;
  const secular::NutationTheory& theory = report.theory;
  const secular::NutationOffset precession = theory.precession(), offset = offset_of(report);
  const double degree = std::numbers::pi / 180.0;
  std::vector<std::string> lines = {
      fmt::format("{}, rigid: {}", of.planet, what(report.request)),
      fmt::format("H = (C - (A + B)/2)/C {:.10g}, (B - A)/C {:.6g}, spin {:.10g} rad/s",
                  *of.ellipticity, *of.triaxiality, *of.spin_rate),
      fmt::format("obliquity {:.8f} deg at T = {:g} centuries from J2000 (TDB), order {}",
                  *of.obliquity / degree, of.T, of.order)};
  if (of.satellite_mass)
    lines.push_back(
        fmt::format("mass of the Moon over that of the Earth {:.10g}", *of.satellite_mass));
  std::string arguments;
  for (std::size_t i = 0; i < theory.arguments().size(); ++i)
    arguments += fmt::format(" {} {:.6f}", theory.arguments()[i],
                             std::remainder(theory.at_epoch()[i] / degree, 360.0));
  lines.push_back("arguments at the epoch, deg:" + arguments);
  lines.push_back(fmt::format(
      "precession on the ecliptic of date {:.6f} arcsec/yr, of the "
      "obliquity {:.6f} arcsec/yr",
      precession.longitude * year / (1e3 * mas), precession.obliquity * year / (1e3 * mas)));
  lines.push_back(
      fmt::format("offset from the mean axis of momentum {:.6f} mas in longitude, "
                  "{:.6f} mas in obliquity",
                  offset.longitude / mas, offset.obliquity / mas));
  if (report.request.axis == secular::PlanetAxis::rotation && !report.request.relative) {
    const secular::NutationOffset by_ecliptic = theory.relative_offset();
    lines.push_back(
        fmt::format("the rate relative to the ecliptic of date is another {:.3f} uas in longitude "
                    "and {:.3f} uas in obliquity away",
                    by_ecliptic.longitude / mas * 1e3, by_ecliptic.obliquity / mas * 1e3));
  }
  return lines;
}

std::string coefficients(const secular::NutationWave& of, double unit) {
  return fmt::format(",{:.6f},{:.6f},{:.6f},{:.6f}", of.longitude_sine * unit,
                     of.longitude_cosine * unit, of.obliquity_cosine * unit,
                     of.obliquity_sine * unit);
}

}  // namespace

NutationReport nutation_report(const NutationRequest& request) {
  if (request.relative && request.axis != secular::PlanetAxis::rotation)
    throw DomainError("nutation: a relative rate has the axis of rotation alone; got the axis of " +
                      std::string(secular::name(request.axis)));
  if (request.part == NutationPart::oppolzer && request.axis == secular::PlanetAxis::momentum)
    throw DomainError(
        "nutation: Oppolzer terms are those of figure or rotation against the momentum; got the "
        "axis of momentum");
  NutationRequest all = request;
  all.of = completed(request.of);
  secular::NutationTheory theory = nutation_theory(all.of);
  return {std::move(all), std::move(theory)};
}

std::string nutation_text(const NutationReport& report) {
  std::string text;
  for (const std::string& line : notes(report)) text += line + "\n";
  const std::vector<secular::NutationTerm>& terms = terms_of(report);
  text += "\n";
  for (const std::string& argument : report.theory.arguments())
    text += fmt::format("{:>4}", argument);
  text += fmt::format("{:>14} {:>14} {:>12} {:>14} {:>12}\n", "period d", "dpsi sin mas", "cos",
                      "deps cos mas", "sin");
  const std::size_t shown =
      std::min(terms.size(), static_cast<std::size_t>(std::max(report.request.lines, 0)));
  for (std::size_t i = 0; i < shown; ++i) {
    const secular::NutationTerm& term = terms[i];
    for (const int k : term.multipliers) text += fmt::format("{:>4}", k);
    text += fmt::format("{:>14.4f} {:>14.4f} {:>12.4f} {:>14.4f} {:>12.4f}\n",
                        2.0 * std::numbers::pi / term.rate / day, term.wave.longitude_sine / mas,
                        term.wave.longitude_cosine / mas, term.wave.obliquity_cosine / mas,
                        term.wave.obliquity_sine / mas);
  }
  if (shown < terms.size()) text += fmt::format("and {} smaller terms\n", terms.size() - shown);
  return text;
}

std::string nutation_csv(const NutationReport& report) {
  std::string text = fmt::format("# polhode {}\n", version());
  for (const std::string& line : notes(report)) text += "# " + line + "\n";
  for (const Citation& citation : nutation_citations())
    text += fmt::format("# cite: {}\n", citation.text);
  text += "# units: period [d], dpsi and deps [mas], their changes (_t) [mas a century]\n";
  for (const std::string& argument : report.theory.arguments()) text += argument + ",";
  text += "period,dpsi_sin,dpsi_cos,deps_cos,deps_sin";
  const bool changes = report.request.changes;
  text += changes ? ",dpsi_sin_t,dpsi_cos_t,deps_cos_t,deps_sin_t\n" : "\n";
  for (const secular::NutationTerm& term : terms_of(report)) {
    for (const int k : term.multipliers) text += fmt::format("{},", k);
    text += fmt::format("{:.6f}{}", 2.0 * std::numbers::pi / term.rate / day,
                        coefficients(term.wave, 1.0 / mas));
    text += (changes ? coefficients(term.change, 36525.0 * day / mas) : "") + "\n";
  }
  return text;
}

void write_nutation_csv(const NutationReport& report, const std::string& path) {
  detail::PartFile file(path);
  file.write(nutation_csv(report));
  file.commit();
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
