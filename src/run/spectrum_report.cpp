// SPDX-License-Identifier: MIT
// The spectrum of a column of a file as text and as CSV.
#include "polhode/run/spectrum_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/time_series.hpp"
#include "polhode/error.hpp"
#include "polhode/text/units.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
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
      throw DomainError(series.file + ": row " + std::to_string(k + 1) + ": time " +
                        polhode::detail::number_text(t[k]) +
                        " is not evenly spaced from those before; expected one interval " +
                        "throughout");
  return mean;
}

std::string line_text(const analysis::SpectralLine& line, double unit, double resolution) {
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
    report.spectrum = analysis::spectrum(start, step, std::span<const double>(series.columns[1]),
                                         request.options);
    return report;
  }
  std::vector<std::complex<double>> samples;
  for (std::size_t k = 0; k < series.columns[0].size(); ++k)
    samples.emplace_back(series.columns[1][k], series.columns[2][k]);
  report.spectrum = analysis::spectrum(start, step, std::span<const std::complex<double>>(samples),
                                       request.options);
  return report;
}

std::string spectrum_text(const SpectrumReport& report) {
  const analysis::Spectrum& of = report.spectrum;
  const std::string unit =
      report.column_unit.empty() || report.column_unit == "1" ? "" : " " + report.column_unit;
  std::string text;
  if (of.mean != 0.0) text += fmt::format("mean {:.10g}{}\n", of.mean, unit);
  text += fmt::format("frequency in {}, period in {}, phase at t = 0 in deg\n", report.unit,
                      report.time_unit.empty() ? "the unit of t" : report.time_unit);
  text += fmt::format("{:>18}  {:>14} {:>14} {:>10} {:>9} {:>9} {:>9}\n", "frequency", "period",
                      "amplitude", "phase", "error of", "amplitude", "phase");
  for (const analysis::SpectralLine& line : of.lines)
    text += line_text(line, report.per_unit, of.resolution);
  if (analysis::unresolved(of) > 0)
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
  for (const analysis::SpectralLine& line : report.spectrum.lines)
    text += fmt::format("{},{},{},{},{},{},{},{}\n", line.frequency / report.per_unit,
                        2.0 * std::numbers::pi / line.frequency, line.amplitude, line.phase,
                        line.frequency_error / report.per_unit, line.amplitude_error,
                        line.phase_error, line.isolation / report.per_unit);
  return text;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
