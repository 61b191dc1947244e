// SPDX-License-Identifier: MIT
// Reports of nutation, of a shape and of a spectrum, for people and for programs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "math/number_text.hpp"
#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/output/time_series.hpp"
#include "polhode/run/nutation_report.hpp"
#include "polhode/run/shape_report.hpp"
#include "polhode/run/spectrum_report.hpp"
#include "polhode/text/units.hpp"
#include "polhode/version.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double mas = std::numbers::pi / 648000.0e3;
constexpr double day = 86400.0;
constexpr double year = 365.25 * day;

const std::vector<NutationTerm>& terms_of(const NutationReport& report) {
  const NutationRequest& of = report.request;
  return of.part == NutationPart::oppolzer ? report.theory.oppolzer_terms(of.axis)
                                           : report.theory.terms(of.axis);
}

NutationOffset offset_of(const NutationReport& report) {
  const NutationRequest& of = report.request;
  NutationOffset offset = report.theory.offset(of.axis);
  if (of.part == NutationPart::oppolzer) {
    const NutationOffset momentum = report.theory.offset(PlanetAxis::momentum);
    offset = {offset.longitude - momentum.longitude, offset.obliquity - momentum.obliquity};
  }
  if (of.relative) {
    const NutationOffset by_ecliptic = report.theory.relative_offset();
    offset = {offset.longitude + by_ecliptic.longitude, offset.obliquity + by_ecliptic.obliquity};
  }
  return offset;
}

std::string what(const NutationRequest& of) {
  std::string text = of.part == NutationPart::oppolzer
                         ? fmt::format("Oppolzer terms of the axis of {}", name(of.axis))
                         : fmt::format("nutation of the axis of {}", name(of.axis));
  if (of.axis == PlanetAxis::rotation)
    text +=
        of.relative ? ", of the rate relative to the ecliptic of date" : ", of the inertial rate";
  return text;
}

// Lines without an end.
std::vector<std::string> notes(const NutationReport& report) {
  const PlanetNutation& of = report.request.of;
  const NutationTheory& theory = report.theory;
  const NutationOffset precession = theory.precession(), offset = offset_of(report);
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
  if (report.request.axis == PlanetAxis::rotation && !report.request.relative) {
    const NutationOffset by_ecliptic = theory.relative_offset();
    lines.push_back(
        fmt::format("the rate relative to the ecliptic of date is another {:.3f} uas in longitude "
                    "and {:.3f} uas in obliquity away",
                    by_ecliptic.longitude / mas * 1e3, by_ecliptic.obliquity / mas * 1e3));
  }
  return lines;
}

std::string coefficients(const NutationWave& of, double unit) {
  return fmt::format(",{:.6f},{:.6f},{:.6f},{:.6f}", of.longitude_sine * unit,
                     of.longitude_cosine * unit, of.obliquity_cosine * unit,
                     of.obliquity_sine * unit);
}

}  // namespace

NutationReport nutation_report(const NutationRequest& request) {
  if (request.relative && request.axis != PlanetAxis::rotation)
    throw DomainError("nutation: a relative rate has the axis of rotation alone; got the axis of " +
                      std::string(name(request.axis)));
  if (request.part == NutationPart::oppolzer && request.axis == PlanetAxis::momentum)
    throw DomainError(
        "nutation: Oppolzer terms are those of figure or rotation against the momentum; got the "
        "axis of momentum");
  NutationRequest all = request;
  all.of = completed(request.of);
  NutationTheory theory = nutation_theory(all.of);
  return {std::move(all), std::move(theory)};
}

std::string nutation_text(const NutationReport& report) {
  std::string text;
  for (const std::string& line : notes(report)) text += line + "\n";
  const std::vector<NutationTerm>& terms = terms_of(report);
  text += "\n";
  for (const std::string& argument : report.theory.arguments())
    text += fmt::format("{:>4}", argument);
  text += fmt::format("{:>14} {:>14} {:>12} {:>14} {:>12}\n", "period d", "dpsi sin mas", "cos",
                      "deps cos mas", "sin");
  const std::size_t shown =
      std::min(terms.size(), static_cast<std::size_t>(std::max(report.request.lines, 0)));
  for (std::size_t i = 0; i < shown; ++i) {
    const NutationTerm& term = terms[i];
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
  for (const NutationTerm& term : terms_of(report)) {
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

namespace {

std::string power(const std::string& unit, int exponent) {
  return unit == "1" ? "" : unit + std::to_string(exponent);
}

}  // namespace

std::vector<SummaryLine> shape_summary(const FacetShape& shape, const MassProperties& properties,
                                       const Units& units) {
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  const auto unit = [&](Dimension dimension) {
    const std::string label = units.label(dimension);
    if (label == "1") return std::string();
    return label == "kg m2/m2" ? std::string("kg") : label;
  };
  const Body principal = body(properties);
  const Vec3& I = principal.moments();
  const Quaternion& q = principal.q_FB();
  const Vec3& c = properties.centre;
  const MassMoments m = principal_moments(properties, principal);
  const std::string length = units.length();
  return {
      {"vertices", "vertices", {count(shape.vertices().size())}, "", ""},
      {"facets", "facets", {count(shape.triangles().size())}, "", ""},
      {"area", "area", {shape.area()}, "", power(length, 2)},
      {"volume", "volume", {properties.volume}, "", power(length, 3)},
      {"mass", "mass", {properties.mass}, "", unit(Dimension::mass)},
      {"centre",
       "centre of mass, in the axes of the file",
       {c.x, c.y, c.z},
       "",
       length == "1" ? "" : length},
      {"moments", "principal moments I1, I2, I3", {I.x, I.y, I.z}, "", unit(Dimension::moment)},
      {"principal_axes",
       "principal axes in those of the file (quaternion)",
       {q.w, q.x, q.y, q.z},
       "",
       ""},
      {"third",
       "third moments xxx ... zzz, principal axes",
       {m.third.begin(), m.third.end()},
       "",
       unit(Dimension::moment3)},
      {"fourth",
       "fourth moments xxxx ... zzzz",
       {m.fourth.begin(), m.fourth.end()},
       "",
       unit(Dimension::moment4)},
  };
}

std::string body_table(const MassProperties& properties, const Units& units) {
  const Mat3& I = properties.inertia;
  const bool is_plain = units.moment() == "1";
  std::string table = std::string("[body]\ntensor = ") + (is_plain ? "[" : "{ value = [");
  for (int i = 0; i < 3; ++i) {
    table += i == 0 ? "[" : ", [";
    for (int j = 0; j < 3; ++j) table += (j == 0 ? "" : ", ") + detail::number_text(I(i, j));
    table += "]";
  }
  return table + (is_plain ? "]\n" : "], unit = \"" + units.moment() + "\" }\n");
}

namespace {

constexpr double uneven = 1e-6;  // of the interval

std::string time_unit_of(const SpectrumRequest& request, const std::string& said) {
  if (!request.time_unit.empty() && !said.empty() && request.time_unit != said)
    throw DomainError("spectrum: --time-unit: got \"" + request.time_unit + "\"; the file says \"" +
                      said + "\"");
  return !said.empty() ? said : request.time_unit;
}

// What one `unit` is in rad per unit of time.
double rate_unit(const std::string& unit, const std::string& time) {
  try {
    return Units(time).to_core(1.0, unit, Dimension::rate);
  } catch (const DomainError& error) {
    throw DomainError("spectrum: --unit: got \"" + unit + "\"; " + error.what());
  }
}

void find_units(SpectrumReport& report, const SpectrumRequest& request, const TimeSeries& series) {
  report.time_unit = time_unit_of(request, series.units[0]);
  report.column_unit = series.units[1];
  if (report.time_unit.empty()) {
    if (!request.unit.empty())
      throw DomainError("spectrum: --unit: got \"" + request.unit +
                        "\" of a file that does not say its unit of time; expected --time-unit");
    report.unit = "rad per unit of t";
    return;
  }
  constexpr std::string_view of_ages[] = {"yr", "kyr", "Myr", "Gyr", "ka", "Ma"};
  const bool is_long =
      std::find(std::begin(of_ages), std::end(of_ages), report.time_unit) != std::end(of_ages);
  report.unit =
      !request.unit.empty() ? request.unit : (is_long ? "arcsec/yr" : "rad/" + report.time_unit);
  report.per_unit = rate_unit(report.unit, report.time_unit);
}

// An angle that goes round and round jumps back by a turn in the column of a file.
void require_no_jumps(const TimeSeries& series) {
  const std::string& unit = series.units[1];
  double turn = 0.0;
  try {
    turn = 2.0 * std::numbers::pi / Units().to_core(1.0, unit, Dimension::angle);
  } catch (const DomainError&) {
    return;
  }
  const std::vector<double>& x = series.columns[1];
  for (std::size_t k = 1; k < x.size(); ++k)
    if (std::fabs(x[k] - x[k - 1]) > 0.5 * turn)
      throw DomainError(series.file + ": row " + std::to_string(k + 1) +
                        ": this angle jumps by more than half a turn; expected columns that do "
                        "not, such as its cosine and its sine (--column and --imaginary)");
}

// The interval; negative where times fall.
double interval_of(const TimeSeries& series) {
  const std::vector<double>& t = series.columns[0];
  if (t.size() < 2) throw DomainError(series.file + ": has no two rows; expected 8 or more");
  const double mean = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  for (std::size_t k = 0; k < t.size(); ++k)
    if (!(std::fabs(t[k] - (t.front() + static_cast<double>(k) * mean)) <=
          uneven * std::fabs(mean)))
      throw DomainError(
          series.file + ": row " + std::to_string(k + 1) + ": time " + detail::number_text(t[k]) +
          " is not evenly spaced from those before; expected one interval " + "throughout");
  return mean;
}

std::string line_text(const SpectralLine& line, double unit, double resolution) {
  return fmt::format("{:>18.10f}{} {:>14.6g} {:>14.7g} {:>10.4f} {:>9.1e} {:>9.1e} {:>9.1e}\n",
                     line.frequency / unit, line.isolation < resolution ? "*" : " ",
                     2.0 * std::numbers::pi / line.frequency, line.amplitude,
                     line.phase * 180.0 / std::numbers::pi, line.frequency_error / unit,
                     line.amplitude_error, line.phase_error * 180.0 / std::numbers::pi);
}

}  // namespace

SpectrumReport spectrum_report(const SpectrumRequest& request) {
  std::vector<std::string> wanted = {request.time, request.column};
  if (!request.imaginary.empty()) wanted.push_back(request.imaginary);
  TimeSeries series = read_time_series(request.file, wanted);
  SpectrumReport report;
  find_units(report, request, series);
  const double interval = interval_of(series);
  if (request.imaginary.empty()) require_no_jumps(series);
  if (interval < 0.0)
    for (std::vector<double>& column : series.columns) std::reverse(column.begin(), column.end());
  const double start = series.columns[0].front(), step = std::fabs(interval);
  if (request.imaginary.empty()) {
    report.spectrum =
        spectrum(start, step, std::span<const double>(series.columns[1]), request.options);
    return report;
  }
  std::vector<std::complex<double>> samples;
  for (std::size_t k = 0; k < series.columns[0].size(); ++k)
    samples.emplace_back(series.columns[1][k], series.columns[2][k]);
  report.spectrum =
      spectrum(start, step, std::span<const std::complex<double>>(samples), request.options);
  return report;
}

std::string spectrum_text(const SpectrumReport& report) {
  const Spectrum& of = report.spectrum;
  const std::string unit =
      report.column_unit.empty() || report.column_unit == "1" ? "" : " " + report.column_unit;
  std::string text;
  if (of.mean != 0.0) text += fmt::format("mean {:.10g}{}\n", of.mean, unit);
  text += fmt::format("frequency in {}, period in {}, phase at t = 0 in deg\n", report.unit,
                      report.time_unit.empty() ? "the unit of t" : report.time_unit);
  text += fmt::format("{:>18}  {:>14} {:>14} {:>10} {:>9} {:>9} {:>9}\n", "frequency", "period",
                      "amplitude", "phase", "error of", "amplitude", "phase");
  for (const SpectralLine& line : of.lines) text += line_text(line, report.per_unit, of.resolution);
  if (unresolved(of) > 0)
    text += fmt::format(
        "* closer than {:.4g}, 10 turns over the samples, to another line or to its own mirror "
        "image at the negative frequency: not free of it\n",
        of.resolution / report.per_unit);
  text += fmt::format("residual {:.3g}{} rms, of {:.3g}{}\n", of.residual, unit, of.size, unit);
  return text;
}

std::string spectrum_csv(const SpectrumReport& report) {
  std::string text = "# units: frequency [" + report.unit + "], period [" +
                     (report.time_unit.empty() ? "1" : report.time_unit) +
                     "], phase [rad]\nfrequency,period,amplitude,phase,frequency_error,"
                     "amplitude_error,phase_error,isolation\n";
  for (const SpectralLine& line : report.spectrum.lines)
    text += fmt::format("{},{},{},{},{},{},{},{}\n", line.frequency / report.per_unit,
                        2.0 * std::numbers::pi / line.frequency, line.amplitude, line.phase,
                        line.frequency_error / report.per_unit, line.amplitude_error,
                        line.phase_error, line.isolation / report.per_unit);
  return text;
}

}  // namespace v0
}  // namespace polhode
