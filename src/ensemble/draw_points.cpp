// SPDX-License-Identifier: MIT
#include "polhode/ensemble/draw_points.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::number_text;

constexpr double most_points = 0x1p53;

SaveAt points_of(const DrawAxis& axis, std::size_t index) {
  const std::string name = "DrawGrid: axis[" + std::to_string(index) + "]: ";
  for (const auto& [what, value] : {std::pair("from", axis.from), std::pair("to", axis.to)})
    if (!std::isfinite(value))
      throw DomainError(name + what + " " + number_text(value) + " must be finite");
  if (axis.count < 1)
    throw DomainError(name + "count " + std::to_string(axis.count) + " must be 1 or more");
  return SaveAt::count(axis.from, axis.count == 1 ? axis.from : axis.to, axis.count);
}

void require_inside(const char* function, std::uint64_t index, std::uint64_t size) {
  if (index >= size)
    throw DomainError(std::string(function) + ": index " + std::to_string(index) +
                      " must be below " + std::to_string(size));
}

}  // namespace

DrawGrid::DrawGrid(std::vector<DrawAxis> axes) : axes_(std::move(axes)) {
  if (axes_.empty()) throw DomainError("DrawGrid: 0 axes must be one or more");
  double points = 1.0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    points *= static_cast<double>(axes_[i].count);
    if (points > most_points)
      throw DomainError("DrawGrid: axis[" + std::to_string(i) + "]: count " +
                        std::to_string(axes_[i].count) +
                        " makes more points than 2^53, which must be the most");
    points_.push_back(points_of(axes_[i], i));
    size_ *= static_cast<std::uint64_t>(axes_[i].count);
  }
}

void DrawGrid::at(std::uint64_t index, std::span<double> x) const {
  require_inside("DrawGrid::at", index, size_);
  for (std::size_t i = axes_.size(); i-- > 0;) {
    const auto count = static_cast<std::uint64_t>(axes_[i].count);
    x[i] = points_[i][static_cast<std::int64_t>(index % count)];
    index /= count;
  }
}

DrawTable::DrawTable(std::size_t columns, std::vector<double> numbers, RowOrder order)
    : columns_(columns), order_(order) {
  if (columns == 0) throw DomainError("DrawTable: 0 columns must be one or more");
  if (numbers.empty()) throw DomainError("DrawTable: 0 rows must be one or more");
  if (numbers.size() % columns != 0)
    throw DomainError("DrawTable: " + std::to_string(numbers.size()) +
                      " numbers must be whole rows of " + std::to_string(columns));
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers[i]))
      throw DomainError("DrawTable: row " + std::to_string(i / columns) + ", column " +
                        std::to_string(i % columns) + ": " + number_text(numbers[i]) +
                        " must be finite");
  numbers_ = std::make_shared<const std::vector<double>>(std::move(numbers));
}

std::span<const double> DrawTable::row(std::uint64_t index) const {
  require_inside("DrawTable::row", index, rows());
  return std::span<const double>(*numbers_).subspan(index * columns_, columns_);
}

std::span<const double> DrawTable::from_uniform(double u) const {
  const auto row_of = static_cast<std::uint64_t>(u * static_cast<double>(rows()));
  return row(std::min(row_of, rows() - 1));  // the product may be rounded up
}

}  // namespace v0
}  // namespace polhode
