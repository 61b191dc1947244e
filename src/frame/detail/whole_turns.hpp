// SPDX-License-Identifier: MIT
// The whole turns of an angle that is known between -pi and pi: half of it turns quaternions, whose
// sign would change from one turn to the next.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace detail {

class WholeTurns {
 public:
  // None.
  WholeTurns() = default;
  // Counted along rising times at which less than half a turn lies between neighbours.
  template <class Angle>
  static WholeTurns along(const std::vector<double>& times, const Angle& angle) {
    Rows rows;
    double last = 0.0;
    for (const double t : times) {
      const double now = angle(t);
      if (!std::isfinite(now)) continue;
      const double unwrapped = now - turn * std::rint((now - last) / turn);
      last = rows.times.empty() ? now : unwrapped;
      rows.times.push_back(t);
      rows.angles.push_back(last);
    }
    WholeTurns result;
    if (rows.times.size() > 1) result.rows_ = std::make_shared<const Rows>(std::move(rows));
    return result;
  }

  // Whether an odd number of turns belongs to the angle at a time.
  bool odd(double t, double angle) const {
    if (!rows_ || !std::isfinite(t)) return false;
    const auto& times = rows_->times;
    const auto after = std::upper_bound(times.begin() + 1, times.end() - 1, t);
    const auto k = static_cast<std::size_t>(after - times.begin());
    const double share = (t - times[k - 1]) / (times[k] - times[k - 1]);
    const double expected =
        rows_->angles[k - 1] + share * (rows_->angles[k] - rows_->angles[k - 1]);
    return std::fmod(std::rint((expected - angle) / turn), 2.0) != 0.0;
  }

 private:
  static constexpr double turn = 2.0 * std::numbers::pi;
  struct Rows {
    std::vector<double> times;
    std::vector<double> angles;
  };
  std::shared_ptr<const Rows> rows_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
