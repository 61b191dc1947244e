// SPDX-License-Identifier: MIT
// Results of fits as bytes, for the journal of a search (polhode/ensemble/cell_journal.hpp).
#pragma once

#include <optional>

#include "polhode/fit/convex_fit.hpp"
#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/fit/spin_fit.hpp"
#include "polhode/trajectory/archive.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void serialize(Archive& bytes, SpinState& s);
void serialize(Archive& bytes, EllipsoidModel& body);
void serialize(Archive& bytes, std::optional<ConvexModel>& body);
void serialize(Archive& bytes, LightSolution& found);
void serialize(Archive& bytes, SpinSolution& found);
void serialize(Archive& bytes, RefinedPair& refined);

// Nothing, or what there is.
template <class T>
void serialize(Archive& bytes, std::optional<T>& x) {
  bool is_there = x.has_value();
  bytes(is_there);
  if (bytes.reads() && is_there) x.emplace();
  if (is_there) serialize(bytes, *x);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
