// SPDX-License-Identifier: MIT
// The fits of a search: short ones of starts, and those to the end, which begin with a part of the
// points and with the stricter models.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fit/detail/light_starts.hpp"
#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct LightFinalist {
  BrightEllipsoid start;
  std::size_t periods;
  bool is_strict = true;  // of the strictest model: its moments are those of the shape
};

class LightSearchFits {
 public:
  explicit LightSearchFits(const LightSearch& search);

  std::optional<LightTrial> trial(std::size_t number) const;
  LightSolution to_end(const LightFinalist& finalist) const;

 private:
  const LightSearch& search_;
  LightSearch coarse_;                 // of fewer points, and the strictest model
  std::vector<LightUnknowns> models_;  // from the strictest to the one that is asked for
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
