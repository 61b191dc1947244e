// SPDX-License-Identifier: MIT
#include "polhode/ensemble/first_events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ensemble/detail/number_list.hpp"
#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {

void FirstEvents::leave_out(std::int64_t member) {
  times_.add(member, std::numeric_limits<double>::quiet_NaN());
}

void FirstEvents::merge(const FirstEvents& later) {
  times_.merge(later.times_);
  without_ += later.without_;
}

Bounded FirstEvents::survival(double t) const {
  const auto n = static_cast<double>(count()), had = static_cast<double>(times_.count());
  if (times_.count() == 0) {
    const double all = std::isnan(t) ? t : n / n;
    return {all, all, all};
  }
  const Bounded up_to = times_.part_up_to(t);
  const auto without = [&](double part) { return (n - had * part) / n; };
  return {without(up_to.value), without(up_to.highest), without(up_to.lowest)};
}

std::optional<Bounded> FirstEvents::time_of(double p) const {
  if (!(p >= 0.0 && p <= 1.0))
    throw DomainError("FirstEvents::time_of: got p = " + detail::number_text(p) +
                      "; expected 0 to 1");
  // the least number of members that are the part p or more, but for rounding
  const double members = std::ceil(p * (1.0 - 0x1p-50) * static_cast<double>(count()));
  const auto rank = std::max<std::int64_t>(static_cast<std::int64_t>(members), 1) - 1;
  if (rank >= times_.count()) return std::nullopt;
  return times_.ranked(rank);
}

std::vector<double> FirstEvents::numbers() const {
  std::vector<double> all{static_cast<double>(without_)};
  detail::append(all, times_.numbers());
  return all;
}

FirstEvents FirstEvents::restored(std::span<const double> numbers) const {
  detail::NumberReader reader("FirstEvents::restored", numbers);
  FirstEvents found = *this;
  found.without_ = reader.integer();
  found.times_ = times_.restored(numbers.subspan(1));
  return found;
}

}  // namespace v0
}  // namespace polhode
