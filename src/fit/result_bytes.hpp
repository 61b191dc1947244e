// SPDX-License-Identifier: MIT
// Results of fits as bytes, for the journal of a search (polhode/ensemble/cell_journal.hpp).
#pragma once

#include <optional>

#include "fit/detail/light_starts.hpp"
#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/fit/spin_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// A mesh is not among the bytes: that of a body which is read is that of `known`.
using KnownBody = std::optional<LightModel>;

void serialize(Archive& bytes, LightModel& body, const KnownBody& known);
void serialize(Archive& bytes, LightTrial& trial, const KnownBody& known);
void serialize(Archive& bytes, LightSolution& found, const KnownBody& known = {});
void serialize(Archive& bytes, FoundLight& found, const KnownBody& known);
void serialize(Archive& bytes, SpinSolution& found);
void serialize(Archive& bytes, RefinedPair& refined);

// Nothing, or what there is.
template <class T, class... Known>
void serialize(Archive& bytes, std::optional<T>& x, const Known&... known) {
  bool is_there = x.has_value();
  bytes(is_there);
  if (bytes.reads() && is_there) x.emplace();
  if (is_there) serialize(bytes, *x, known...);
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
