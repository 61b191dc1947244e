// SPDX-License-Identifier: MIT
// SharedPlaces: what orbits have said of one set of times, so that several who ask for the same
// orbit have it computed once.
//
// Units       those of the orbits.
// Domain      orbits that can tell whether another is the same: a member shares_with. It is to be
//             filled and asked while the orbits that it has heard of live, and for the same times
//             alone. Six answers for up to 32 times are kept; what is beyond is computed again.
// Accuracy    the bits of what was computed.
// Errors      none of its own.
// Cost        a comparison for each answer that is kept, and a copy; 10 kB, not filled before.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
// An orbit that can tell without much ado whether another one is the same.
template <class O>
concept SharedOrbit = requires(const O& orbit) {
  { orbit.shares_with(orbit) } -> std::same_as<bool>;
};

class SharedPlaces {
 public:
  static constexpr std::size_t most_times = 32;
  static constexpr std::size_t most_rows = 6;

  enum class Asked { positions, positions_with_rests, motions };

  // The rows of an orbit, computed by `compute` where they are not known; `known` may be null.
  template <class O, std::size_t n, class F>
  static void once(SharedPlaces* known, const O& orbit, Asked asked, std::size_t count,
                   const std::array<double*, n>& to, const F& compute) {
    if constexpr (SharedOrbit<O>) {
      if (known != nullptr) return known->rows(orbit, asked, count, to, compute);
    }
    compute();
  }

 private:
  // One address for each type.
  template <class O>
  static constexpr char type_of = 0;

  template <SharedOrbit O, std::size_t n, class F>
  void rows(const O& orbit, Asked asked, std::size_t count, const std::array<double*, n>& to,
            const F& compute) {
    static_assert(n <= most_rows);
    for (std::size_t k = 0; k < size_; ++k) {
      const Entry& e = entries_[k];
      if (e.type != &type_of<O> || e.asked != asked) continue;
      if (e.orbit != &orbit && !static_cast<const O*>(e.orbit)->shares_with(orbit)) continue;
      for (std::size_t r = 0; r < n; ++r) std::copy_n(e.rows[r].begin(), count, to[r]);
      return;
    }
    compute();
    if (size_ == entries_.size() || count > most_times) return;
    Entry& e = entries_[size_++];
    e.type = &type_of<O>;
    e.orbit = &orbit;
    e.asked = asked;
    for (std::size_t r = 0; r < n; ++r) std::copy_n(to[r], count, e.rows[r].begin());
  }

  struct Entry {
    const char* type;
    const void* orbit;
    Asked asked;
    std::array<std::array<double, most_times>, most_rows> rows;
  };
  std::size_t size_ = 0;
  std::array<Entry, 6> entries_;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled first
};

}  // namespace v0
}  // namespace polhode
