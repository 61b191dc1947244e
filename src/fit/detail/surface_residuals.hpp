// SPDX-License-Identifier: MIT
// Residuals of light curves for a surface in free rotation, whatever describes it.
//
// A Surface says how many unknowns of its own it has, makes a Shape from them, and gives the
// brightness of that with its gradient, its own derivatives into a row:
//   own(), shape_at(own), brightness(shape, law, s, o), gradient(shape, law, s, o, own row);
// and numbers that are priors of the shape, with a row of own derivatives each:
//   priors(), prior_numbers(shape, own, numbers, rows or nullptr).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "fit/detail/rotation_vector.hpp"
#include "fit/detail/weighed_curves.hpp"
#include "fit/free_motion.hpp"
#include "polhode/light/brightness_gradient.hpp"
#include "polhode/light/scattering.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Not 0: the law would not be computed there, and the fit would see no slope.
inline constexpr double least_multiple = 1e-9;
// The weight of Lambert's law that a fit starts with where none is given (Kaasalainen et al. 2001).
inline constexpr double usual_multiple = 0.1;

inline Unknown multiple_unknown(const Scattering& law) {
  const double given = law.multiple / law.single;
  return {.name = "multiple",
          .start = given > least_multiple ? given : usual_multiple,
          .low = least_multiple};
}

// turn, w_F, ratios of moments, weight of Lambert's law, those of the surface.
struct SurfaceUnknowns {
  bool moments = false, multiple = false;

  std::size_t moments_at() const { return 6; }
  std::size_t multiple_at() const { return moments ? 8 : 6; }
  std::size_t own_at() const { return multiple_at() + (multiple ? 1 : 0); }
};

// Ratios of moments that follow the unknowns of the surface, as a linear function of those about
// `own`; where `own` is empty they do not.
struct FollowedMoments {
  double Ixx = 0.0, Iyy = 0.0;  // over Izz
  std::vector<double> own, Ixx_by_own, Iyy_by_own;
};

template <class Surface>
class SurfaceResiduals {
 public:
  SurfaceResiduals(std::span<const LightCurve> curves, const SurfaceUnknowns& unknowns,
                   const SpinState& start, const Scattering& law, Surface surface,
                   FollowedMoments followed = {}, const Loss& loss = {}, Rows rows = Rows::exact)
      : curves_(curves, loss),
        unknowns_(unknowns),
        start_(start),
        law_(law),
        surface_(std::move(surface)),
        followed_(std::move(followed)),
        rows_(rows) {}

  // The same with other moments that follow.
  SurfaceResiduals with(const FollowedMoments& followed) const {
    SurfaceResiduals other = *this;
    other.followed_ = followed;
    return other;
  }

  const FollowedMoments& followed() const { return followed_; }
  const WeighedCurves& curves() const { return curves_; }
  std::size_t unknowns() const { return unknowns_.own_at() + surface_.own(); }
  std::size_t priors() const { return surface_.priors(); }

  SpinState spin_at(std::span<const double> x) const {
    SpinState s = start_;
    s.q = normalized(start_.q) * turn_by({x[0], x[1], x[2]});
    s.w_F = {x[3], x[4], x[5]};
    if (!unknowns_.moments && !has_followed()) return s;
    s.inertia_F = Mat3::identity();
    double &Ixx = s.inertia_F(0, 0), &Iyy = s.inertia_F(1, 1);
    if (unknowns_.moments) {
      Ixx = x[unknowns_.moments_at()];
      Iyy = x[unknowns_.moments_at() + 1];
      return s;
    }
    Ixx = followed_.Ixx;
    Iyy = followed_.Iyy;
    for (std::size_t k = 0; k < followed_.own.size(); ++k) {
      const double by = own_of(x)[k] - followed_.own[k];
      Ixx += followed_.Ixx_by_own[k] * by;
      Iyy += followed_.Iyy_by_own[k] * by;
    }
    return s;
  }
  Scattering law_at(std::span<const double> x) const {
    return unknowns_.multiple ? Scattering::mixed(x[unknowns_.multiple_at()]) : law_;
  }
  std::span<const double> own_of(std::span<const double> x) const {
    return x.subspan(unknowns_.own_at());
  }

  // The numbers of the points, then those of priors; derivatives row by row where `jacobian` is not
  // empty.
  bool at(std::span<const double> x, std::span<double> numbers, std::span<double> jacobian) const {
    const SpinState spin = spin_at(x);
    const Scattering law = law_at(x);
    const auto shape = surface_.shape_at(own_of(x));
    const bool derivatives = !jacobian.empty();
    const std::size_t n = unknowns(), count = curves_.size();
    std::vector<MotionPoint> motion;
    if (!free_motion(spin, curves_.times(), {derivatives, false}, motion)) return false;
    std::vector<double> B(count);
    const Mat3 turn = exp_derivative({x[0], x[1], x[2]});
    for (std::size_t i = 0; i < count; ++i) {
      const Quaternion back = conj(motion[i].q);
      const Vec3 s = rotate(back, curves_[i].to_sun), o = rotate(back, curves_[i].to_observer);
      B[i] = derivatives ? row_at(shape, law, turn, motion[i], s, o, jacobian.subspan(i * n, n))
                         : surface_.brightness(shape, law, s, o);
    }
    if (!curves_.residuals(B, n, numbers, jacobian.subspan(0, derivatives ? count * n : 0), rows_))
      return false;
    std::vector<double> rows(derivatives ? priors() * surface_.own() : 0);
    surface_.prior_numbers(shape, own_of(x), numbers.subspan(count, priors()),
                           derivatives ? rows.data() : nullptr);
    for (std::size_t k = 0; derivatives && k < priors(); ++k) {
      const std::span<double> row = jacobian.subspan((count + k) * n, n);
      std::ranges::fill(row, 0.0);
      std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(k * surface_.own()), surface_.own(),
                  row.begin() + static_cast<std::ptrdiff_t>(unknowns_.own_at()));
    }
    return true;
  }

  // At each point; empty where the body has no motion.
  std::vector<double> brightness_at(std::span<const double> x) const {
    const auto shape = surface_.shape_at(own_of(x));
    std::vector<MotionPoint> motion;
    std::vector<double> B;
    if (!free_motion(spin_at(x), curves_.times(), {}, motion)) return B;
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      const Quaternion back = conj(motion[i].q);
      B.push_back(surface_.brightness(shape, law_at(x), rotate(back, curves_[i].to_sun),
                                      rotate(back, curves_[i].to_observer)));
    }
    return B;
  }

 private:
  bool has_followed() const { return !followed_.own.empty(); }

  // A rotation d in body axes changes the brightness by d . (by_sun x s + by_observer x o).
  template <class Shape>
  double row_at(const Shape& shape, const Scattering& law, const Mat3& turn,
                const MotionPoint& motion, const Vec3& s, const Vec3& o,
                std::span<double> row) const {
    const BrightnessGradient g =
        surface_.gradient(shape, law, s, o, row.subspan(unknowns_.own_at()));
    const Vec3 by_turn = cross(g.by_sun, s) + cross(g.by_observer, o);
    Vec3 at_epoch;
    for (std::size_t k = 0; k < 3; ++k) {
      at_epoch[static_cast<int>(k)] = dot(by_turn, motion.turn[k]);
      row[first_rate + k] = dot(by_turn, motion.turn[first_rate + k]);
    }
    for (int k = 0; k < 3; ++k)
      row[static_cast<std::size_t>(k)] =
          at_epoch.x * turn(0, k) + at_epoch.y * turn(1, k) + at_epoch.z * turn(2, k);
    if (unknowns_.moments) {
      row[unknowns_.moments_at()] = dot(by_turn, motion.turn[first_ratio]);
      row[unknowns_.moments_at() + 1] = dot(by_turn, motion.turn[first_ratio + 1]);
    }
    for (std::size_t k = 0; k < followed_.own.size(); ++k)
      row[unknowns_.own_at() + k] +=
          followed_.Ixx_by_own[k] * dot(by_turn, motion.turn[first_ratio]) +
          followed_.Iyy_by_own[k] * dot(by_turn, motion.turn[first_ratio + 1]);
    if (unknowns_.multiple) row[unknowns_.multiple_at()] = g.by_multiple;
    return g.value;
  }

  WeighedCurves curves_;
  SurfaceUnknowns unknowns_;
  SpinState start_;
  Scattering law_;
  Surface surface_;
  FollowedMoments followed_;
  Rows rows_;
};

// Unknowns that every surface has, from a start.
inline std::vector<Unknown> spin_unknowns(const SurfaceUnknowns& unknowns, const SpinState& s,
                                          const Scattering& law) {
  std::vector<Unknown> found;
  for (const char* name : {"turn_x", "turn_y", "turn_z"}) found.push_back({.name = name});
  found.push_back({.name = "w_x", .start = s.w_F.x});
  found.push_back({.name = "w_y", .start = s.w_F.y});
  found.push_back({.name = "w_z", .start = s.w_F.z});
  const Mat3& T = s.inertia_F;
  if (unknowns.moments) {
    found.push_back({.name = "Ixx/Izz", .start = T(0, 0) / T(2, 2)});
    found.push_back({.name = "Iyy/Izz", .start = T(1, 1) / T(2, 2)});
  }
  if (unknowns.multiple) found.push_back(multiple_unknown(law));
  return found;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
