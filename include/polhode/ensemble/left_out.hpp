// SPDX-License-Identifier: MIT
// LeftOut: the members that a statistic leaves out, because their run failed or their numbers are
// not finite: how many, and the first few by name.
//
// Domain      indices of members, 0 or more.
// Accuracy    exact.
// Errors      DomainError from restored for other numbers than those of numbers().
// Cost        nine numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace detail {
class NumberReader;
}  // namespace detail

class LeftOut {
 public:
  static constexpr std::size_t kept = 8;

  LeftOut() = default;
  explicit LeftOut(detail::NumberReader& numbers);  // the next ones, as numbers() wrote them

  void add(std::int64_t member);
  void merge(const LeftOut& later);

  std::int64_t count() const { return count_; }
  // The first of them, at most `kept`, in the order in which they were added.
  std::span<const std::int64_t> first() const;

  std::vector<double> numbers() const;
  LeftOut restored(std::span<const double> numbers) const;

 private:
  std::int64_t count_ = 0;
  std::array<std::int64_t, kept> first_{};
};

}  // namespace v0
}  // namespace polhode
