// SPDX-License-Identifier: MIT
// Any bytes are an Orbit Ephemeris Message with finite states at rising times, or one DomainError:
// never a crash.
#include "polhode/tables/oem.hpp"

#include <cmath>

#include "fuzz.hpp"
#include "polhode/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polhode;
  using fuzz::require;
  try {
    const io::OrbitEphemeris read = io::oem_from_text(fuzz::text_of(data, size), "fuzz");
    require(!read.segments.empty());
    for (const io::OemSegment& s : read.segments) {
      require(!s.t.empty() && s.position.size() == s.t.size() && s.velocity.size() == s.t.size());
      for (std::size_t k = 0; k < s.t.size(); ++k)
        require(std::isfinite(s.t[k]) && std::isfinite(s.position[k].x) &&
                (k == 0 || s.t[k] >= s.t[k - 1]));
    }
  } catch (const DomainError& error) {
    fuzz::require_message(error.what());
  }
  return 0;
}
