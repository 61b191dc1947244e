// SPDX-License-Identifier: MIT
// Histograms, and the bins that they count in.
#include "ensemble/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "ensemble/detail/number_list.hpp"
#include "math/number_text.hpp"
#include "polhode/ensemble/bins.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

namespace {

constexpr std::size_t most_bins = 1'000'000;

// Between `lowest` and `highest`, of which neither half overflows.
double between(double lowest, double highest, double part) {
  return lowest * (1.0 - part) + highest * part;
}

std::vector<double> even_edges(double lowest, double highest, int count) {
  if (!(std::isfinite(lowest) && std::isfinite(highest) && lowest < highest))
    throw DomainError("Bins::linear: got edges " + polhode::detail::tuple_text({lowest, highest}) +
                      "; expected two finite ones, the lower first");
  if (count < 1 || static_cast<std::size_t>(count) > most_bins)
    throw DomainError("Bins::linear: got " + std::to_string(count) + " bins; expected 1 to " +
                      std::to_string(most_bins));
  std::vector<double> edges;
  for (int k = 0; k < count; ++k) edges.push_back(between(lowest, highest, double(k) / count));
  edges.push_back(highest);
  return edges;
}

// From smallest to largest.
std::vector<double> growing_edges(double relative_error, double smallest, double largest) {
  if (!(relative_error > 0.0 && relative_error < 1.0))
    throw DomainError("Bins::logarithmic: got a relative error of " +
                      polhode::detail::number_text(relative_error) +
                      "; expected one between 0 and 1");
  if (!(smallest > 0.0 && smallest < largest && std::isfinite(largest)))
    throw DomainError("Bins::logarithmic: got numbers " +
                      polhode::detail::tuple_text({smallest, largest}) +
                      "; expected two positive finite ones, the smaller first");
  const double factor = (1.0 + relative_error) / (1.0 - relative_error);
  const double bins = (std::log(largest) - std::log(smallest)) / std::log(factor);
  if (!(bins < 0.5 * static_cast<double>(most_bins)))
    throw DomainError(
        "Bins::logarithmic: relative error " + polhode::detail::number_text(relative_error) +
        " from " + polhode::detail::number_text(smallest) + " to " +
        polhode::detail::number_text(largest) + " takes " + polhode::detail::rounded_text(bins) +
        " bins; expected at most " + std::to_string(most_bins / 2));
  std::vector<double> edges{smallest};
  while (edges.back() < largest) {
    const double next = edges.back() * factor;
    edges.push_back(std::isfinite(next) ? next : largest);
  }
  return edges;
}

}  // namespace

Bins::Bins(std::vector<double> edges, Widths widths) {
  if (edges.size() < 2 || edges.size() > most_bins + 1)
    throw DomainError("Bins: got " + std::to_string(edges.size()) + " edges; expected 2 to " +
                      std::to_string(most_bins + 1));
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (!std::isfinite(edges[k]) || (k > 0 && !(edges[k - 1] < edges[k])))
      throw DomainError("Bins: edge " + std::to_string(k) + " is " +
                        polhode::detail::number_text(edges[k]) +
                        (k > 0 ? " after " + polhode::detail::number_text(edges[k - 1]) : "") +
                        "; expected finite edges, each greater than the one before");
  const double n = static_cast<double>(edges.size() - 1);
  const double per_width = widths == Widths::relative
                               ? 1.0 / std::log(edges.back() / edges[edges.size() - 2])
                               : n / (edges.back() - edges.front());
  shared_ = std::make_shared<const Shared>(Shared{std::move(edges), widths, per_width});
}

Bins Bins::linear(double lowest, double highest, int count) {
  return {even_edges(lowest, highest, count), Widths::even};
}

Bins Bins::around(std::span<const double> numbers, double margin, int count) {
  if (!(margin >= 0.0 && std::isfinite(margin)))
    throw DomainError("Bins::around: got a margin of " + polhode::detail::number_text(margin) +
                      "; expected a finite one of 0 or more");
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const double x : numbers) {
    if (!std::isfinite(x)) continue;
    lowest = std::min(lowest, x);
    highest = std::max(highest, x);
  }
  if (!(lowest <= highest))
    throw DomainError("Bins::around: got " + std::to_string(numbers.size()) +
                      " numbers, none finite; expected one at least");
  double width = margin * (highest - lowest);
  if (lowest == highest) width = lowest == 0.0 ? 1.0 : 0.5 * std::abs(lowest);
  return linear(lowest - width, highest + width, count);
}

Bins Bins::logarithmic(double relative_error, double smallest, double largest) {
  return {growing_edges(relative_error, smallest, largest), Widths::relative};
}

Bins Bins::signed_logarithmic(double relative_error, double smallest, double largest) {
  const std::vector<double> positive = growing_edges(relative_error, smallest, largest);
  std::vector<double> edges;
  for (auto e = positive.rbegin(); e != positive.rend(); ++e) edges.push_back(-*e);
  edges.insert(edges.end(), positive.begin(), positive.end());
  return {std::move(edges), Widths::relative};
}

Bins Bins::of_edges(std::vector<double> edges) { return {std::move(edges), Widths::any}; }

// A bin, less 1, next to that of x, which is within the edges.
std::size_t Bins::near(double x) const {
  const std::vector<double>& e = shared_->edges;
  double guess = 0.0;
  if (shared_->widths == Widths::even) {
    guess = (x - e.front()) * shared_->per_width;
  } else {
    // logarithmic ones, of both signs if there are ones below 0: smallest, the least above
    const bool is_signed = e.front() < 0.0;
    const std::size_t smallest = is_signed ? e.size() / 2 : 0;
    const double steps = std::log(std::abs(x) / e[smallest]) * shared_->per_width;
    const auto first = static_cast<double>(smallest);
    guess = steps < 0.0 ? first - 1.0 : x > 0.0 ? first + steps : first - 2.0 - std::floor(steps);
  }
  const std::size_t last = e.size() - 2;
  if (!(guess < static_cast<double>(last))) return last;  // or NaN, of widths beyond double range
  return guess > 0.0 ? static_cast<std::size_t>(guess) : 0;
}

std::size_t Bins::index(double x) const {
  const std::vector<double>& e = shared_->edges;
  const std::size_t n = e.size() - 1;
  if (x < e.front()) return 0;
  if (!(x < e.back())) return x == e.back() ? n : n + 1;
  if (shared_->widths == Widths::any)
    return static_cast<std::size_t>(std::upper_bound(e.begin(), e.end(), x) - e.begin());
  std::size_t k = near(x);
  while (x < e[k]) --k;
  while (!(x < e[k + 1])) ++k;
  return k + 1;
}

double Bins::middle(std::size_t bin) const {
  const std::vector<double>& e = shared_->edges;
  if (bin < 1 || bin >= e.size())
    throw DomainError("Bins::middle: got bin " + std::to_string(bin) + "; expected 1 to " +
                      std::to_string(e.size() - 1));
  const double a = e[bin - 1], b = e[bin];
  if (shared_->widths == Widths::relative && (a > 0.0 || b < 0.0))
    return a / (0.5 + 0.5 * (a / b));  // 2ab/(a + b)
  return 0.5 * a + 0.5 * b;
}

bool Bins::operator==(const Bins& other) const {
  return shared_ == other.shared_ ||
         (shared_->edges == other.shared_->edges && shared_->widths == other.shared_->widths);
}

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

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
