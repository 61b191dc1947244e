// SPDX-License-Identifier: MIT
// Rows, as they come, to every sink.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "polhode/output/sink.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

class RowWriter {
 public:
  // `rows` are in the sinks already.
  RowWriter(std::size_t width, std::span<const std::unique_ptr<Sink>> sinks, std::int64_t rows)
      : width_(width), sinks_(sinks), rows_(rows) {}

  // fill(numbers) writes as many rows.
  template <class Fill>
  void push(std::size_t rows, const Fill& fill) {
    numbers_.resize(rows * width_);
    fill(std::span<double>(numbers_));
    for (const std::unique_ptr<Sink>& sink : sinks_) sink->push(numbers_);
    rows_ += static_cast<std::int64_t>(rows);
  }
  void finish() {
    for (const std::unique_ptr<Sink>& sink : sinks_) sink->finish();
  }
  std::size_t width() const { return width_; }
  std::int64_t rows() const { return rows_; }

 private:
  std::size_t width_;
  std::span<const std::unique_ptr<Sink>> sinks_;
  std::vector<double> numbers_;
  std::int64_t rows_;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
