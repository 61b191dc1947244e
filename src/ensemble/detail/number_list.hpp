// SPDX-License-Identifier: MIT
// The numbers of an accumulator: written one after the other, and read back with a look at each.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {

// Counts and indices are doubles in a list of numbers.
inline constexpr double most_counted = 0x1p53;

class NumberReader {
 public:
  NumberReader(std::string name, std::span<const double> numbers)
      : name_(std::move(name)), numbers_(numbers) {}

  double number() {
    if (next_ == numbers_.size())
      throw DomainError(name_ + ": got " + std::to_string(next_) + " numbers; expected more");
    return numbers_[next_++];
  }
  void read(std::span<double> to) {
    for (double& x : to) x = number();
  }
  // An integer from `least` to 2^53.
  std::int64_t integer(std::int64_t least = 0) {
    const double x = number();
    if (!(x >= static_cast<double>(least) && x <= most_counted && x == std::floor(x)))
      refuse("an integer from " + std::to_string(least) + " to 2^53");
    return static_cast<std::int64_t>(x);
  }
  // Says that the number before is not what it must be.
  [[noreturn]] void refuse(const std::string& requirement) const {
    throw DomainError(name_ + ": number " + std::to_string(next_ - 1) + " is " +
                      polhode::detail::number_text(numbers_[next_ - 1]) + "; expected " +
                      requirement);
  }
  void finish() const {
    if (next_ != numbers_.size())
      throw DomainError(name_ + ": got " + std::to_string(numbers_.size()) + " numbers; expected " +
                        std::to_string(next_));
  }

 private:
  std::string name_;
  std::span<const double> numbers_;
  std::size_t next_ = 0;
};

inline void append(std::vector<double>& to, std::span<const double> numbers) {
  to.insert(to.end(), numbers.begin(), numbers.end());
}
inline void append_integers(std::vector<double>& to, std::span<const std::int64_t> numbers) {
  for (const std::int64_t n : numbers) to.push_back(static_cast<double>(n));
}

inline void append_cells(std::vector<double>& to, const std::vector<std::int64_t>& cells) {
  double empty = 0.0;
  for (const std::int64_t n : cells) {
    if (n == 0) {
      ++empty;
      continue;
    }
    if (empty > 0.0) to.push_back(-empty);
    empty = 0.0;
    to.push_back(static_cast<double>(n));
  }
  if (empty > 0.0) to.push_back(-empty);
}

// Into cells that are all there; their sum must be `total`.
inline void read_cells(NumberReader& from, std::vector<std::int64_t>& cells, std::int64_t total) {
  std::int64_t left = total;
  for (std::size_t k = 0; k < cells.size();) {
    const auto rest = static_cast<std::int64_t>(cells.size() - k);
    const std::int64_t n = from.integer(-rest);
    if (n < 0) {
      k += static_cast<std::size_t>(-n);
      continue;
    }
    if (n == 0 || n > left)
      from.refuse("a count from 1 to " + std::to_string(left) + ", or a run of empty cells");
    cells[k++] = n;
    left -= n;
  }
  if (left != 0) from.refuse("counts of " + std::to_string(left) + " more");
}

inline void merge_cells(std::vector<std::int64_t>& cells, const std::vector<std::int64_t>& later) {
  for (std::size_t k = 0; k < cells.size(); ++k) cells[k] += later[k];
}

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
