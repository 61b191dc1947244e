// SPDX-License-Identifier: MIT
#include "polhode/ensemble/left_out.hpp"

#include <algorithm>

#include "ensemble/detail/number_list.hpp"

namespace polhode {
inline namespace v0 {

LeftOut::LeftOut(detail::NumberReader& numbers) : count_(numbers.integer()) {
  const auto named = std::min<std::int64_t>(count_, kept);
  for (std::int64_t i = 0; i < named; ++i) first_[static_cast<std::size_t>(i)] = numbers.integer();
}

void LeftOut::add(std::int64_t member) {
  if (count_ < static_cast<std::int64_t>(kept)) first_[static_cast<std::size_t>(count_)] = member;
  ++count_;
}

void LeftOut::merge(const LeftOut& later) {
  const std::span<const std::int64_t> names = later.first();
  const std::size_t named = first().size();
  std::copy_n(names.begin(), std::min(kept - named, names.size()), first_.begin() + named);
  count_ += later.count_;
}

std::span<const std::int64_t> LeftOut::first() const {
  return std::span(first_).first(std::min(kept, static_cast<std::size_t>(count_)));
}

std::vector<double> LeftOut::numbers() const {
  std::vector<double> all{static_cast<double>(count_)};
  detail::append_integers(all, first());
  return all;
}

LeftOut LeftOut::restored(std::span<const double> numbers) const {
  detail::NumberReader reader("LeftOut::restored", numbers);
  const LeftOut found(reader);
  reader.finish();
  return found;
}

}  // namespace v0
}  // namespace polhode
