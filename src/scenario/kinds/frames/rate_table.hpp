// SPDX-License-Identifier: MIT
// A table of rates and the angle that is their integral: that of the polynomials of a TableOrbit.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "math/gauss_legendre.hpp"
#include "polhode/orbit/table_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

class RateTable {
 public:
  // DomainError as TableOrbit; the rows cover `epoch`, where the angle is 0.
  RateTable(std::vector<double> times, const std::vector<double>& rates, double epoch)
      : times_(std::make_shared<const std::vector<double>>(std::move(times))),
        rate_(table_of(*times_, rates)) {
    std::vector<double> sums(times_->size(), 0.0);
    for (std::size_t k = 1; k < sums.size(); ++k)
      sums[k] = sums[k - 1] + part<double>((*times_)[k - 1], (*times_)[k]);
    sums_ = std::make_shared<const std::vector<double>>(std::move(sums));
    offset_ = sum(epoch);
  }

  // NaN outside of the rows.
  template <Real T>
  T angle(const T& t) const {
    return sum(t) - T(offset_);
  }

 private:
  // Exact for polynomials of degree 15, as no order above 16 is taken.
  static constexpr std::size_t points = 8;

  static TableOrbit table_of(const std::vector<double>& times, const std::vector<double>& rates) {
    PositionTable table{times, {}};
    for (const double rate : rates) table.positions.push_back({rate, 0.0, 0.0});
    return TableOrbit(std::move(table));
  }
  template <Real T>
  T sum(const T& t) const {
    const auto after = std::upper_bound(times_->begin() + 1, times_->end() - 1, to_double(t));
    const auto k = static_cast<std::size_t>(after - times_->begin()) - 1;
    return T((*sums_)[k]) + part<T>((*times_)[k], t);
  }
  // The integral from a row to a time before the next one.
  template <Real T>
  T part(double from, const T& to) const {
    static const GaussRule<double, points> rule = gauss_legendre<double, points>();
    const T half = T(0.5) * (to - T(from));
    T sum(0.0);
    for (std::size_t i = 0; i < points; ++i)
      sum = sum + T(rule.w[i]) * rate_.position(T(T(from) + half * T(1.0 + rule.x[i]))).x;
    return half * sum;
  }

  std::shared_ptr<const std::vector<double>> times_, sums_;
  TableOrbit rate_;
  double offset_ = 0.0;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
