// SPDX-License-Identifier: MIT
// Points that are listed: an even grid over several axes, and the rows of a table of draws.
//
// Equations   point k of an axis is from + k (to - from) / (count - 1), as SaveAt::count has it;
//             the points of a grid are counted with the last axis the fastest, as the cells of a
//             map.
// Units       those of the numbers.
// Domain      1 to 2^53 points; an axis of one point has `from`. Tables of finite numbers, one row
//             or more.
// Accuracy    that of SaveAt; the rows of a table are as given.
// Errors      DomainError names the axis, or the entry, and what it must be; `at` and `row` for an
//             index past the last one.
// Cost        a table is shared by its copies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "polhode/trajectory/save_at.hpp"

namespace polhode {
inline namespace v0 {

struct DrawAxis {
  double from;
  double to;
  std::int64_t count;
};

class DrawGrid {
 public:
  explicit DrawGrid(std::vector<DrawAxis> axes);
  const std::vector<DrawAxis>& axes() const { return axes_; }
  std::uint64_t size() const { return size_; }
  // The point `index`, one number an axis.
  void at(std::uint64_t index, std::span<double> x) const;

 private:
  std::vector<DrawAxis> axes_;
  std::vector<SaveAt> points_;  // of each axis
  std::uint64_t size_ = 1;
};

// Whether member 0 has row 0, member 1 row 1 and so on, or each a row drawn by a uniform number.
enum class RowOrder { in_order, with_replacement };

class DrawTable {
 public:
  // Row by row.
  DrawTable(std::size_t columns, std::vector<double> numbers, RowOrder order);
  std::size_t columns() const { return columns_; }
  std::uint64_t rows() const { return numbers_->size() / columns_; }
  RowOrder order() const { return order_; }
  std::span<const double> row(std::uint64_t index) const;
  std::span<const double> from_uniform(double u) const;

 private:
  std::size_t columns_;
  std::shared_ptr<const std::vector<double>> numbers_;
  RowOrder order_;
};

}  // namespace v0
}  // namespace polhode
