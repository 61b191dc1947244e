// SPDX-License-Identifier: MIT
// Any bytes are an Attitude Ephemeris Message with finite attitudes at rising times, or one
// DomainError: never a crash.
#include "polhode/tables/aem.hpp"

#include <cmath>

#include "fuzz.hpp"
#include "polhode/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polhode;
  using fuzz::require;
  try {
    const io::AttitudeEphemeris read = io::aem_from_text(fuzz::text_of(data, size), "fuzz");
    require(!read.segments.empty());
    for (const io::AemSegment& s : read.segments) {
      require(!s.t.empty() && s.q_AB.size() == s.t.size() && s.epochs.size() == s.t.size());
      require(s.w_AB_B.empty() || s.w_AB_B.size() == s.t.size());
      require(s.w3.empty() || s.w3.size() == s.t.size());
      for (std::size_t k = 0; k < s.t.size(); ++k) {
        require(std::isfinite(s.t[k]) && (k == 0 || s.t[k] >= s.t[k - 1]));
        require(std::fabs(normalized(s.q_AB[k]).w) <= 1.0);
      }
    }
    try {
      require(io::aem_csv(read).ends_with('\n'));
    } catch (const DomainError&) {
      require(read.segments.size() > 1);  // of different objects or frames
    }
  } catch (const DomainError& error) {
    fuzz::require_message(error.what());
  }
  return 0;
}
