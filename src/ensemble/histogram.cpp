// SPDX-License-Identifier: MIT
#include "polhode/ensemble/histogram.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "ensemble/detail/cell_counts.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::size_t most_cells = 100'000'000;

std::size_t checked_cells(const Bins& x, const Bins& y) {
  const std::size_t cells = (x.count() + 2) * (y.count() + 2);
  if (cells > most_cells)
    throw DomainError("Histogram2D: got " + std::to_string(x.count()) + " by " +
                      std::to_string(y.count()) + " bins; expected at most " +
                      std::to_string(most_cells) + " cells");
  return cells;
}

void check_bin(const char* name, const Bins& bins, std::size_t bin) {
  if (bin > bins.count() + 1)
    throw DomainError(std::string(name) + "::count: got bin " + std::to_string(bin) +
                      "; expected 0 to " + std::to_string(bins.count() + 1));
}

void check_same(const char* name, bool same) {
  if (!same)
    throw DomainError(std::string(name) + "::merge: got other bins; expected the same edges");
}

}  // namespace

Histogram::Histogram(Bins bins) : bins_(std::move(bins)), cells_(bins_.count() + 2) {}

void Histogram::add(std::int64_t member, double x) {
  if (!std::isfinite(x)) return left_out_.add(member);
  ++cells_[bins_.index(x)];
  ++count_;
}

void Histogram::merge(const Histogram& later) {
  check_same("Histogram", bins_ == later.bins_);
  detail::merge_cells(cells_, later.cells_);
  count_ += later.count_;
  left_out_.merge(later.left_out_);
}

std::int64_t Histogram::count(std::size_t bin) const {
  check_bin("Histogram", bins_, bin);
  return cells_[bin];
}

std::vector<double> Histogram::numbers() const {
  std::vector<double> all{static_cast<double>(count_)};
  detail::append_cells(all, cells_);
  detail::append(all, left_out_.numbers());
  return all;
}

Histogram Histogram::restored(std::span<const double> numbers) const {
  detail::NumberReader reader("Histogram::restored", numbers);
  Histogram found(bins_);
  found.count_ = reader.integer();
  detail::read_cells(reader, found.cells_, found.count_);
  found.left_out_ = LeftOut(reader);
  reader.finish();
  return found;
}

Histogram2D::Histogram2D(Bins x, Bins y)
    : x_(std::move(x)), y_(std::move(y)), cells_(checked_cells(x_, y_)) {}

void Histogram2D::add(std::int64_t member, double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return left_out_.add(member);
  ++cells_[x_.index(x) * (y_.count() + 2) + y_.index(y)];
  ++count_;
}

void Histogram2D::merge(const Histogram2D& later) {
  check_same("Histogram2D", x_ == later.x_ && y_ == later.y_);
  detail::merge_cells(cells_, later.cells_);
  count_ += later.count_;
  left_out_.merge(later.left_out_);
}

std::int64_t Histogram2D::count(std::size_t x_bin, std::size_t y_bin) const {
  check_bin("Histogram2D", x_, x_bin);
  check_bin("Histogram2D", y_, y_bin);
  return cells_[x_bin * (y_.count() + 2) + y_bin];
}

std::vector<double> Histogram2D::numbers() const {
  std::vector<double> all{static_cast<double>(count_)};
  detail::append_cells(all, cells_);
  detail::append(all, left_out_.numbers());
  return all;
}

Histogram2D Histogram2D::restored(std::span<const double> numbers) const {
  detail::NumberReader reader("Histogram2D::restored", numbers);
  Histogram2D found(x_, y_);
  found.count_ = reader.integer();
  detail::read_cells(reader, found.cells_, found.count_);
  found.left_out_ = LeftOut(reader);
  reader.finish();
  return found;
}

}  // namespace v0
}  // namespace polhode
