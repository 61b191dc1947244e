// SPDX-License-Identifier: MIT
#include "polhode/light/light_curve_checks.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "math/is_finite.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::number_text;

std::string place(std::size_t index) { return "point " + std::to_string(index + 1); }

std::string not_finite(const char* what, double value) {
  return std::string(what) + " " + number_text(value) + "; expected a finite number";
}

// What is wrong with a vector, or nothing.
std::string flaw_of(const Vec3& v, const char* to, bool needed) {
  if (!detail::is_finite(v)) return std::string("the vector to ") + to + " is not finite";
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

}  // namespace v0
}  // namespace polhode
