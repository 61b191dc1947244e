// SPDX-License-Identifier: MIT
// How well the rows of a table tell what is between them.
#pragma once

#include <optional>

#include "polhode/orbit/table_orbit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// About the largest error between rows, as a fraction of the distance: half-way, how far the path
// is from that through two rows less, or at the lowest order through two more. Nothing where the
// table has no more.
std::optional<double> interpolation_error(const TableOrbit& orbit);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
