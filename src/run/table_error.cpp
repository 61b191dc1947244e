// SPDX-License-Identifier: MIT
#include "run/detail/table_error.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace detail {

std::optional<double> interpolation_error(const TableOrbit& orbit) {
  const std::vector<double>& t = orbit.table().times;
  const int per_row = orbit.has_velocities() ? 2 : 1, two_rows = 2 * per_row;
  const int order = orbit.order() + (orbit.order() > two_rows ? -two_rows : two_rows);
  if (t.size() < static_cast<std::size_t>(order / per_row)) return std::nullopt;
  const TableOrbit other(orbit.table(), order);
  double largest = 0.0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double middle = t[k - 1] + 0.5 * (t[k] - t[k - 1]);
    const Vec3 x = orbit.position(middle);
    const double apart = norm(x - other.position(middle));
    if (apart > largest * norm(x)) largest = apart / norm(x);
  }
  return largest;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
