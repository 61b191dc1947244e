// SPDX-License-Identifier: MIT
#include "polhode/dynamics/event.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

void require_valid_event(const std::string& event, bool has_function, double period,
                         double interval) {
  const std::string name = "event \"" + event + "\"";
  if (!has_function) throw DomainError(name + " must have a function");
  const auto positive = [&](const char* what, double x) {
    if (!(x >= 0.0) || !std::isfinite(x))
      throw DomainError(name + ": " + what + " " + detail::number_text(x) +
                        " must be positive, or 0 for none");
  };
  positive("period", period);
  positive("interval", interval);
}

}  // namespace v0
}  // namespace polhode
