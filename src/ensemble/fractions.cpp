// SPDX-License-Identifier: MIT
// Fractions of members by class, and the members that are left out.
#include "ensemble/fractions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "ensemble/detail/number_list.hpp"
#include "math/number_text.hpp"
#include "polhode/ensemble/bins.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

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

namespace {

constexpr int most_classes = 1'000'000;

std::size_t checked_size(int size) {
  if (size < 1 || size > most_classes)
    throw DomainError("Fractions: got " + std::to_string(size) + " classes; expected 1 to " +
                      std::to_string(most_classes));
  return static_cast<std::size_t>(size);
}

std::size_t checked(const char* function, int in_class, std::size_t size) {
  if (in_class < 0 || static_cast<std::size_t>(in_class) >= size)
    throw DomainError("Fractions::" + std::string(function) + ": got class " +
                      std::to_string(in_class) + "; expected 0 to " + std::to_string(size - 1));
  return static_cast<std::size_t>(in_class);
}

}  // namespace

Fractions::Fractions(int size) : counts_(checked_size(size)) {}

void Fractions::add(std::int64_t member, int in_class) {
  if (in_class < 0 || static_cast<std::size_t>(in_class) >= counts_.size())
    throw DomainError("Fractions::add: got class " + std::to_string(in_class) + " of member " +
                      std::to_string(member) + "; expected 0 to " +
                      std::to_string(counts_.size() - 1));
  ++counts_[static_cast<std::size_t>(in_class)];
}

void Fractions::merge(const Fractions& later) {
  if (later.counts_.size() != counts_.size())
    throw DomainError("Fractions::merge: got " + std::to_string(later.counts_.size()) +
                      " classes; expected " + std::to_string(counts_.size()));
  detail::merge_cells(counts_, later.counts_);
  left_out_.merge(later.left_out_);
}

std::int64_t Fractions::count() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0});
}

std::int64_t Fractions::count(int in_class) const {
  return counts_[checked("count", in_class, counts_.size())];
}

double Fractions::fraction(int of_class) const {
  const std::int64_t n = counts_[checked("fraction", of_class, counts_.size())];
  constexpr double none = std::numeric_limits<double>::quiet_NaN();  // 0 / 0 has a sign of its own
  return count() == 0 ? none : static_cast<double>(n) / static_cast<double>(count());
}

Bounds Fractions::interval(int of_class, double z) const {
  const auto k = static_cast<double>(counts_[checked("interval", of_class, counts_.size())]);
  if (!(z >= 0.0 && std::isfinite(z)))
    throw DomainError("Fractions::interval: got z = " + polhode::detail::number_text(z) +
                      "; expected a finite number of deviations, 0 or more");
  const auto n = static_cast<double>(count());
  const double middle = k + 0.5 * z * z;
  const double reach = z * std::sqrt(k * ((n - k) / n) + 0.25 * z * z);
  // of none and of all the ends are 0 and 1
  return {k == 0.0 ? 0.0 * n / n : (middle - reach) / (n + z * z),
          k == n ? n / n : (middle + reach) / (n + z * z)};
}

std::vector<double> Fractions::numbers() const {
  std::vector<double> all;
  detail::append_integers(all, counts_);
  detail::append(all, left_out_.numbers());
  return all;
}

Fractions Fractions::restored(std::span<const double> numbers) const {
  detail::NumberReader reader("Fractions::restored", numbers);
  Fractions found(size());
  for (std::int64_t& n : found.counts_) n = reader.integer();
  found.left_out_ = LeftOut(reader);
  reader.finish();
  return found;
}

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
