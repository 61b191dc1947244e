// SPDX-License-Identifier: MIT
// Light curves: checks, aspect angles, light time and magnitudes.
#include "polhode/light/light_curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "math/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/light/aspect.hpp"
#include "polhode/light/light_time.hpp"

namespace polhode {
inline namespace v0 {
namespace light {
namespace detail {

// "light curve NAME", or "light curve" of one without a name.
inline std::string in_words(const LightCurve& curve) {
  return "light curve" + (curve.name.empty() ? "" : " " + curve.name);
}
// "light curve NAME: point 3"
inline std::string in_words(const LightCurve& curve, std::size_t point) {
  return in_words(curve) + ": point " + std::to_string(point + 1);
}

}  // namespace detail

namespace {

using polhode::detail::number_text;

std::string place(std::size_t index) { return "point " + std::to_string(index + 1); }

std::string not_finite(const char* what, double value) {
  return std::string(what) + " " + number_text(value) + "; expected a finite number";
}

// What is wrong with a vector, or nothing.
std::string flaw_of(const Vec3& v, const char* to, bool needed) {
  if (!polhode::detail::is_finite(v)) return std::string("the vector to ") + to + " is not finite";
  if (needed && v == Vec3{})
    return std::string("there is no vector to ") + to +
           "; expected one, in the file or from an orbit";
  return {};
}

std::string flaw_of(const LightPoint& p, const LightCurveNeeds& needs) {
  if (!std::isfinite(p.t)) return not_finite("time", p.t);
  if (!std::isfinite(p.flux)) return not_finite("flux", p.flux);
  if (!std::isfinite(p.sigma)) return not_finite("error", p.sigma);
  if (!(p.sigma > 0.0)) return "error " + number_text(p.sigma) + "; expected one above 0";
  std::string of_sun = flaw_of(p.to_sun, "the Sun", needs.vectors);
  return of_sun.empty() ? flaw_of(p.to_observer, "the observer", needs.vectors) : of_sun;
}

// Of a time after the one before.
std::string flaw_of(const LightCurve& curve, std::size_t k) {
  const double t = curve.points[k].t, before = curve.points[k - 1].t;
  if (t >= before) return {};
  return "time " + number_text(t) + " comes after " + number_text(before) + " of " + place(k - 1) +
         "; expected rising times, or points that are to be sorted";
}

// Of a session as such.
std::string flaw_of(const LightCurve& curve) {
  const std::size_t count = curve.points.size();
  if (count == 0) return "has no points; expected one or more";
  if (curve.is_calibrated) return {};
  if (count == 1)
    return "is relative and has one point, which says nothing, as its factor is free; expected two "
           "points or more, or calibrated fluxes";
  double sum = 0.0;
  for (const LightPoint& p : curve.points) sum += p.flux;
  if (sum > 0.0) return {};
  return "is relative, with the mean flux " + number_text(sum / static_cast<double>(count)) +
         "; expected one above 0";
}

std::optional<LightCurveFlaw> flaw_inside(const LightCurve& curve, std::size_t index,
                                          const LightCurveNeeds& needs) {
  const bool without_errors =
      !curve.points.empty() && std::all_of(curve.points.begin(), curve.points.end(),
                                           [](const LightPoint& p) { return p.sigma == 0.0; });
  if (without_errors)
    return LightCurveFlaw{index, std::nullopt,
                          "has no errors; expected those of the points, or one of all",
                          LightCurveFlaw::Kind::error};
  using enum LightCurveFlaw::Kind;
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    const LightPoint& p = curve.points[k];
    if (std::string text = flaw_of(p, needs); !text.empty())
      return LightCurveFlaw{index, k, std::move(text), p.sigma > 0.0 ? other : error};
    if (k == 0) continue;
    if (std::string text = flaw_of(curve, k); !text.empty())
      return LightCurveFlaw{index, k, std::move(text), order};
    for (std::size_t j = k; j-- > 0 && curve.points[j].t == p.t;)
      if (curve.points[j].flux == p.flux && curve.points[j].sigma == p.sigma)
        return LightCurveFlaw{index, k,
                              "time " + number_text(p.t) + " and flux " + number_text(p.flux) +
                                  " stand twice, here and in " + place(j) +
                                  "; expected each observation once",
                              twice};
  }
  std::string text = flaw_of(curve);
  if (text.empty()) return std::nullopt;
  return LightCurveFlaw{index, std::nullopt, std::move(text)};
}

// A point whose time, flux and error another session has.
std::optional<LightCurveFlaw> shared_point(std::span<const LightCurve> curves) {
  struct Seen {
    double t, flux, sigma;
    std::size_t curve, point;
  };
  std::vector<Seen> all;
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (std::size_t k = 0; k < curves[c].points.size(); ++k) {
      const LightPoint& p = curves[c].points[k];
      all.push_back({p.t, p.flux, p.sigma, c, k});
    }
  const auto key = [](const Seen& s) { return std::tie(s.t, s.flux, s.sigma); };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Seen& a, const Seen& b) { return key(a) < key(b); });
  const auto same = std::adjacent_find(
      all.begin(), all.end(), [&](const Seen& a, const Seen& b) { return key(a) == key(b); });
  if (same == all.end()) return std::nullopt;
  const Seen &first = *same, &again = *(same + 1);
  return LightCurveFlaw{again.curve, again.point,
                        "time " + number_text(again.t) + " and flux " + number_text(again.flux) +
                            " are those of " + place(first.point) + " of light curve " +
                            std::to_string(first.curve + 1) +
                            "; expected each observation in one session",
                        LightCurveFlaw::Kind::twice};
}

}  // namespace

std::optional<LightCurveFlaw> first_flaw(std::span<const LightCurve> curves,
                                         const LightCurveNeeds& needs) {
  for (std::size_t c = 0; c < curves.size(); ++c)
    if (auto flaw = flaw_inside(curves[c], c, needs)) return flaw;
  return shared_point(curves);
}

void require_sound(std::span<const LightCurve> curves, const LightCurveNeeds& needs) {
  const std::optional<LightCurveFlaw> flaw = first_flaw(curves, needs);
  if (!flaw) return;
  const std::string& name = curves[flaw->curve].name;
  throw DomainError("light curve " + std::to_string(flaw->curve + 1) +
                    (name.empty() ? "" : " (" + name + ")") +
                    (flaw->point ? ": " + place(*flaw->point) + ": " : " ") + flaw->text);
}

LightCurve in_order_of_time(LightCurve curve) {
  std::stable_sort(curve.points.begin(), curve.points.end(),
                   [](const LightPoint& a, const LightPoint& b) { return a.t < b.t; });
  return curve;
}

LightCurve at_unit_distances(LightCurve curve, double unit) {
  if (!(unit > 0.0) || !std::isfinite(unit))
    throw DomainError("at_unit_distances: unit " + polhode::detail::number_text(unit) +
                      "; expected a length above 0");
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    LightPoint& p = curve.points[k];
    const double distances = (norm(p.to_sun) / unit) * (norm(p.to_observer) / unit);
    if (!(distances > 0.0))
      throw DomainError("at_unit_distances: " + detail::in_words(curve, k) +
                        " has no distances; expected vectors to the Sun and to the observer");
    const double factor = distances * distances;
    p.flux *= factor;
    p.sigma *= factor;
  }
  return curve;
}

namespace detail {

void fail_light_time(const LightCurve& curve, std::size_t point, const char* what) {
  throw DomainError(in_words(curve, point) + ": " + what);
}

void require_speed_of_light(double c) {
  if (!(c > 0.0) || !std::isfinite(c))
    throw DomainError("light time: speed of light " + number_text(c) + "; expected one above 0");
}

}  // namespace detail

LightCurve at_body(LightCurve curve, double c) {
  detail::require_speed_of_light(c);
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    LightPoint& p = curve.points[k];
    const double distance = norm(p.to_observer);
    if (!(distance > 0.0))
      detail::fail_light_time(curve, k,
                              "there is no vector to the observer; expected one, or a "
                              "light time");
    p.t -= distance / c;
  }
  return curve;
}

LightCurve at_body_after(LightCurve curve, double light_time) {
  if (!(light_time >= 0.0) || !std::isfinite(light_time))
    throw DomainError("at_body_after: light time " + polhode::detail::number_text(light_time) +
                      "; expected a finite time, 0 or more");
  for (LightPoint& p : curve.points) p.t -= light_time;
  return curve;
}

namespace {

double required_mean(const LightCurve& curve, const char* function) {
  const double mean = mean_flux(curve);
  if (!(mean > 0.0) || !std::isfinite(mean))
    throw DomainError(std::string(function) + ": " + detail::in_words(curve) +
                      ": its mean flux is " + polhode::detail::number_text(mean) +
                      "; expected one above 0");
  return mean;
}

}  // namespace

double mean_flux(const LightCurve& curve) {
  double sum = 0.0;
  for (const LightPoint& p : curve.points) sum += p.flux;
  return sum / static_cast<double>(curve.points.size());  // 0 / 0 of none
}

LightCurve normalised(LightCurve curve) {
  const double mean = required_mean(curve, "normalised");
  for (LightPoint& p : curve.points) {
    p.flux /= mean;
    p.sigma /= mean;
  }
  return curve;
}

LightCurve with_relative_sigma(LightCurve curve, double fraction) {
  if (!(fraction > 0.0) || !std::isfinite(fraction))
    throw DomainError("with_relative_sigma: fraction " + polhode::detail::number_text(fraction) +
                      "; expected one above 0");
  const double sigma = fraction * required_mean(curve, "with_relative_sigma");
  for (LightPoint& p : curve.points) p.sigma = sigma;
  return curve;
}

}  // namespace light
}  // namespace v0
}  // namespace polhode
