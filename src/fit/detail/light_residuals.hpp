// SPDX-License-Identifier: MIT
// Residuals of light curves for a surface in free rotation, whatever describes it.
//
// A Surface has a number of its own unknowns, makes a Shape from them, and computes the brightness
// of that with its gradient; derivatives by its own unknowns go into a row:
//   own(), shape_at(own), brightness(shape, law, s, o), gradient(shape, law, s, o, own row);
// moments that may follow the shape, and what their derivatives `by` add to that row, which is
// finished then:
//   moments_follow(), moments(shape, own), finish_row(shape, by, own row);
// and numbers that are priors of the shape, with a row of own derivatives each:
//   priors(), prior_numbers(shape, own, numbers, rows or nullptr).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "fit/detail/light_surfaces.hpp"
#include "fit/detail/rotation_vector.hpp"
#include "fit/detail/weighed_curves.hpp"
#include "fit/free_motion.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/light/facet_brightness.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// Not 0: the law would not be computed there, and the fit would see no slope.
inline constexpr double least_multiple = 1e-9;
// The weight of Lambert's law that a fit starts with where none is given (Kaasalainen et al. 2001).
inline constexpr double usual_multiple = 0.1;

// Places after turn and w_F: ratios of moments, weight of Lambert's law, and before these or after
// them what the surface has.
struct LightPlaces {
  std::size_t own = 6, moments = 6, multiple = 6, count = 6;
  bool has_moments, has_multiple;

  LightPlaces(const LightUnknowns& unknowns, std::size_t own_count, bool own_first)
      : has_moments(unknowns.moments == MomentSource::fit), has_multiple(unknowns.multiple) {
    moments = own_first ? own + own_count : own;
    multiple = moments + (has_moments ? 2 : 0);
    if (!own_first) own = multiple + (has_multiple ? 1 : 0);
    count = 6 + own_count + (has_moments ? 2 : 0) + (has_multiple ? 1 : 0);
  }
};

inline Mat3 inertia_of(const MomentRatios& ratios) {
  Mat3 m = Mat3::identity();
  m(0, 0) = ratios.Ixx;
  m(1, 1) = ratios.Iyy;
  return m;
}

// The brightness of a body at each point of a motion that is rotated as a whole: q p(t). False if
// one is not finite.
template <class Brightness>
bool brightness_along(const Brightness& brightness, const Quaternion& q,
                      std::span<const MotionPoint> motion, const WeighedCurves& curves,
                      std::span<double> found) {
  bool is_sound = true;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Quaternion back = conj(q * motion[i].q);
    found[i] = brightness(rotate(back, curves[i].to_sun), rotate(back, curves[i].to_observer));
    is_sound = is_sound && std::isfinite(found[i]);
  }
  return is_sound;
}

template <class Surface>
class LightResiduals {
 public:
  LightResiduals(std::shared_ptr<const WeighedCurves> curves, const LightUnknowns& unknowns,
                 const LightModel& start, Surface surface, Rows rows = Rows::exact)
      : curves_(std::move(curves)),
        places_(unknowns, surface.own(), Surface::own_first),
        spin_(start.spin),
        law_(start.law),
        surface_(std::move(surface)),
        rows_(rows) {}

  LightResiduals with(Surface surface) const {
    LightResiduals other = *this;
    other.surface_ = std::move(surface);
    return other;
  }

  const Surface& surface() const { return surface_; }
  const WeighedCurves& curves() const { return *curves_; }
  const LightPlaces& places() const { return places_; }
  std::size_t priors() const { return surface_.priors(); }

  LightModel body_at(std::span<const double> x) const {
    const std::span<const double> own = own_of(x);
    return {spin_at(x, surface_.shape_at(own)), surface_.light_shape(own), law_at(x)};
  }
  std::span<const double> own_of(std::span<const double> x) const {
    return x.subspan(places_.own, surface_.own());
  }

  // (flux - f B) / sigma of the points, then the numbers of priors; derivatives row by row where
  // `jacobian` is not empty.
  bool at(std::span<const double> x, std::span<double> numbers, std::span<double> jacobian) const {
    const auto shape = surface_.shape_at(own_of(x));
    const SpinState spin = spin_at(x, shape);
    const light::Scattering law = law_at(x);
    const bool derivatives = !jacobian.empty();
    const std::size_t n = places_.count, count = curves_->size();
    std::vector<MotionPoint> motion;
    if (!free_motion(spin, curves_->times(), {derivatives, false}, motion)) return false;
    std::vector<double> B(count);
    const Mat3 turn = exp_derivative({x[0], x[1], x[2]});
    for (std::size_t i = 0; i < count; ++i) {
      const Quaternion back = conj(motion[i].q);
      const Vec3 s = rotate(back, (*curves_)[i].to_sun),
                 o = rotate(back, (*curves_)[i].to_observer);
      B[i] = derivatives ? row_at(shape, law, turn, motion[i], s, o, jacobian.subspan(i * n, n))
                         : surface_.brightness(shape, law, s, o);
    }
    if (!curves_->residuals(B, n, numbers, jacobian.subspan(0, derivatives ? count * n : 0), rows_))
      return false;
    add_priors(x, shape, numbers.subspan(count, priors()),
               jacobian.subspan(derivatives ? count * n : 0));
    return true;
  }

 private:
  SpinState spin_at(std::span<const double> x, const typename Surface::Shape& shape) const {
    SpinState s = spin_;
    s.q = normalized(spin_.q) * turn_by({x[0], x[1], x[2]});
    s.w_F = {x[3], x[4], x[5]};
    if (places_.has_moments)
      s.inertia_F = inertia_of({x[places_.moments], x[places_.moments + 1]});
    else if (surface_.moments_follow())
      s.inertia_F = inertia_of(surface_.moments(shape, own_of(x)));
    return s;
  }
  light::Scattering law_at(std::span<const double> x) const {
    return places_.has_multiple ? light::Scattering::mixed(x[places_.multiple]) : law_;
  }

  // A rotation d in body axes turns v into v + v x d: it changes the brightness by d . (by_sun x s
  // + by_observer x o).
  double row_at(const typename Surface::Shape& shape, const light::Scattering& law,
                const Mat3& turn, const MotionPoint& motion, const Vec3& s, const Vec3& o,
                std::span<double> row) const {
    const std::span<double> own = row.subspan(places_.own, surface_.own());
    const light::BrightnessGradient g = surface_.gradient(shape, law, s, o, own);
    const Vec3 by_turn = cross(g.by_sun, s) + cross(g.by_observer, o);
    Vec3 at_epoch;
    for (std::size_t k = 0; k < 3; ++k) {
      at_epoch[static_cast<int>(k)] = dot(by_turn, motion.turn[k]);
      row[first_rate + k] = dot(by_turn, motion.turn[first_rate + k]);
    }
    for (int k = 0; k < 3; ++k)
      row[static_cast<std::size_t>(k)] =
          at_epoch.x * turn(0, k) + at_epoch.y * turn(1, k) + at_epoch.z * turn(2, k);
    const MomentRatios by{dot(by_turn, motion.turn[first_ratio]),
                          dot(by_turn, motion.turn[first_ratio + 1])};
    surface_.finish_row(shape, by, own);
    if (places_.has_moments) {
      row[places_.moments] = by.Ixx;
      row[places_.moments + 1] = by.Iyy;
    }
    if (places_.has_multiple) row[places_.multiple] = g.by_multiple;
    return g.value;
  }

  void add_priors(std::span<const double> x, const typename Surface::Shape& shape,
                  std::span<double> numbers, std::span<double> jacobian) const {
    const std::size_t n = places_.count, own = surface_.own();
    std::vector<double> rows(jacobian.empty() ? 0 : priors() * own);
    surface_.prior_numbers(shape, own_of(x), numbers, rows.empty() ? nullptr : rows.data());
    for (std::size_t k = 0; !rows.empty() && k < priors(); ++k) {
      const std::span<double> row = jacobian.subspan(k * n, n);
      std::ranges::fill(row, 0.0);
      std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(k * own), own,
                  row.begin() + static_cast<std::ptrdiff_t>(places_.own));
    }
  }

  std::shared_ptr<const WeighedCurves> curves_;
  LightPlaces places_;
  SpinState spin_;
  light::Scattering law_;
  Surface surface_;
  Rows rows_;
};

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
