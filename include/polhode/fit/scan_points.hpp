// SPDX-License-Identifier: MIT
// ScanPoints: light curves as Fourier scans take them, weighted, each session from a constant of
// its own.
//
// Equations   relative fluxes are F_i / s of one factor s a session. In flux (ScanQuantity::flux)
//             each session is divided by its mean and has a constant of its own, which is a factor
//             to first order in the difference of the means: what is left over is that difference
//             times the variation (Pravec et al. 2005 scan fluxes so). In logarithms
//             (ScanQuantity::log_flux, magnitudes but for 1.086) a factor is a constant exactly, as
//             in Harris et al. (1989), and the error of ln F is sigma / F. Calibrated sessions
//             share one mean and one constant.
// Units       those of the light curves; values are relative to a mean, 1 being all of it.
// Domain      any times in any order, the same time twice included; flux finite, sigma > 0. Vectors
//             to Sun and observer are not looked at: times should be free of light time.
// Accuracy    that of double.
// Errors      DomainError for no points, times, fluxes or sigmas that are no such, a mean that is
//             not positive (flux) or a flux that is not (log_flux), a relative session of one
//             point, all points at one time.
// Cost        a pass over the points.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {

namespace detail {
struct ScanTable;
}  // namespace detail

enum class ScanQuantity { flux, log_flux };

class ScanPoints {
 public:
  explicit ScanPoints(std::span<const LightCurve> sessions,
                      ScanQuantity quantity = ScanQuantity::flux);

  std::size_t size() const;
  // Constants of their own: one of each relative session, one of all calibrated ones.
  std::size_t constants() const;
  double epoch() const { return epoch_; }          // midway between the first and the last time
  double time_base() const { return time_base_; }  // from the first to the last
  // Sum of weights times squares of the values, each from the mean of its group: chi-square of no
  // harmonics at all.
  double total() const;

  // For the sources of this layer.
  const detail::ScanTable& table() const { return *table_; }

 private:
  std::shared_ptr<const detail::ScanTable> table_;
  double epoch_ = 0.0, time_base_ = 0.0;
};

}  // namespace v0
}  // namespace polhode
