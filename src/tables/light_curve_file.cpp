// SPDX-License-Identifier: MIT
// Files of light curves, of any format: sessions and the dates of their points.
#include "polhode/tables/light_curve_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/light/light_curve.hpp"
#include "tables/detail/light_sessions.hpp"
#include "text/dates.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr double last_julian_date = 5373484.5;  // the end of the year 9999

}  // namespace

LightTimes::LightTimes(ephemeris::TimeScale scale, const std::optional<ephemeris::Date>& epoch,
                       double julian_zero)
    : scale_(scale), julian_zero_(julian_zero), epoch_(epoch) {
  for (const ephemeris::TimeScale given : {scale, epoch ? epoch->scale : scale})
    if (given == ephemeris::TimeScale::UT1)
      throw DomainError(
          "times of light curves in UT1; expected UTC, TAI, TT or TDB, as UT1 - UTC "
          "is observed");
  if (epoch) epoch_in_tt_ = ephemeris::converted(*epoch, ephemeris::TimeScale::TT);
}

double LightTimes::of_julian_date(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  const ephemeris::Date date = julian_date(field, scale_, julian_zero_);
  const double sum = date.day + date.fraction;
  if (!(sum >= 0.0 && sum <= last_julian_date))
    throw DomainError("is no Julian date from 0 to 5373484.5");
  return seconds(date);
}

double LightTimes::of_date(std::string_view field) { return seconds(date_in(field, scale_)); }

double LightTimes::seconds(const ephemeris::Date& date) {
  if (!epoch_) {
    epoch_ = ephemeris::Date{scale_, std::floor(date.day + date.fraction - 0.5) + 0.5, 0.0};
    epoch_in_tt_ = ephemeris::converted(*epoch_, ephemeris::TimeScale::TT);
  }
  return ephemeris::seconds_between(*epoch_in_tt_, date);
}

LightTimes light_times(const std::string& shown, ephemeris::TimeScale scale,
                       const std::optional<ephemeris::Date>& epoch) {
  try {
    return {scale, epoch};
  } catch (const DomainError& error) {
    throw DomainError(shown + ": " + error.what());
  }
}

std::string julian_text(const ephemeris::Date& date) {
  constexpr int decimals = 12;  // 0.1 us
  double whole = std::floor(date.day);
  double part = (date.day - whole) + date.fraction;
  whole += std::floor(part);
  part -= std::floor(part);
  std::array<char, 32> buffer;
  const auto fixed = [&](double x, int places) {
    const std::to_chars_result end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x,
                                                   std::chars_format::fixed, places);
    return std::string(buffer.data(), end.ptr);
  };
  std::string digits = fixed(part, decimals);
  if (digits.front() == '1') whole += 1.0;  // rounded up to the next day
  digits.erase(0, 1);
  digits.erase(std::max<std::size_t>(digits.find_last_not_of('0') + 1, 2));
  if (digits.size() < 2) digits += '0';
  return fixed(whole, 0) + digits;
}

}  // namespace detail

namespace {

constexpr double faintest = 100.0;

[[noreturn]] void fail(const LightCurveFile& file, std::size_t line, const std::string& text) {
  throw DomainError(file.file + (line > 0 ? ":" + std::to_string(line) : "") + ": " + text);
}

const char* in_words(Distances distances) {
  return distances == Distances::unit ? "at unit distances" : "at the distances of the time";
}

// " (JD 2459274.5)" of a time of a file with dates.
std::string dated(const LightCurveFile& file, double t) {
  if (!file.epoch || !std::isfinite(t)) return {};
  const ephemeris::Date date =
      ephemeris::converted(ephemeris::date_after(*file.epoch, t), file.epoch->scale);
  char text[32];
  std::snprintf(text, sizeof text, " (JD %.6f)", date.day + date.fraction);
  return text;
}

// What calibrated fluxes are must be the same in all sessions.
void require_one_scale(const LightCurveFile& file) {
  const LightSession* first = nullptr;
  const LightSession* known = nullptr;  // the first that says its distances
  const auto place = [](const LightSession& session) {
    return " of the session of line " + std::to_string(session.line);
  };
  for (const LightSession& session : file.sessions) {
    if (!session.curve.is_calibrated) continue;
    if (first == nullptr) first = &session;
    if (session.band != first->band)
      fail(file, session.line,
           "calibrated fluxes in the band \"" + detail::printable(session.band) +
               "\" have no scale in common with \"" + detail::printable(first->band) + "\"" +
               place(*first) + "; expected one band, or relative sessions");
    if (session.distances == Distances::unknown) continue;
    if (known == nullptr) known = &session;
    if (session.distances != known->distances)
      fail(file, session.line,
           std::string("calibrated fluxes ") + in_words(session.distances) + ", those" +
               place(*known) + " are " + in_words(known->distances) + "; expected the same");
  }
}

}  // namespace

std::vector<light::LightCurve> light_curves(const LightCurveFile& file) {
  std::vector<light::LightCurve> curves;
  curves.reserve(file.sessions.size());
  for (const LightSession& session : file.sessions) curves.push_back(session.curve);
  return curves;
}

void require_sound(const LightCurveFile& file, const light::LightCurveNeeds& needs) {
  const std::vector<light::LightCurve> curves = light_curves(file);
  if (const std::optional<light::LightCurveFlaw> flaw = light::first_flaw(curves, needs)) {
    const LightSession& session = file.sessions[flaw->curve];
    const std::string which = "light curve " + std::to_string(flaw->curve + 1);
    const bool has_line = flaw->point && *flaw->point < session.lines.size();
    if (flaw->point)
      fail(file, has_line ? session.lines[*flaw->point] : session.line,
           which + ", point " + std::to_string(*flaw->point + 1) +
               dated(file, session.curve.points[*flaw->point].t) + ": " + flaw->text);
    fail(file, session.line, which + " " + flaw->text);
  }
  require_one_scale(file);
}

namespace detail {

void require_size(std::string_view text, const std::string& shown) {
  if (text.size() > largest_light_file)
    throw DomainError(shown + ": has more than " + std::to_string(largest_light_file >> 20) +
                      " MiB");
}

std::string magnitude_flaw(double magnitude) {
  if (std::abs(magnitude) <= faintest) return {};
  return "magnitude " + polhode::detail::number_text(magnitude) + "; expected one from -100 to 100";
}

void take_magnitudes(LightSession& session) {
  std::vector<light::LightPoint>& points = session.curve.points;
  double zero = 0.0;
  if (!session.curve.is_calibrated && !points.empty()) {
    const auto count = static_cast<double>(points.size());
    for (const light::LightPoint& p : points) zero += p.flux / count;
    double mean = 0.0;
    for (const light::LightPoint& p : points)
      mean += light::flux_of({p.flux, 0.0}, zero).value / count;
    zero -= 2.5 * std::log10(mean);
  }
  for (light::LightPoint& p : points) {
    const light::Flux flux = light::flux_of({p.flux, p.sigma}, zero);
    p.flux = flux.value;
    p.sigma = flux.sigma;
  }
  session.zero_magnitude = zero;
}

}  // namespace detail

}  // namespace io
}  // namespace v0
}  // namespace polhode
