// SPDX-License-Identifier: MIT
// OrbitHistory: the elements of an orbit over ages, whatever they are made from.
//
// Equations   those of the table or the series.
// Units       those of the table or the series.
// Domain      that of the table; all times for a series.
// Accuracy    that of the table or the series.
// Cost        that of what it holds. Copies share.
#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <variant>

#include "polhode/secular/orbit_elements.hpp"

namespace polhode {
inline namespace v0 {

class OrbitHistory {
 public:
  explicit OrbitHistory(ElementTable table) : of_(std::make_shared<const Of>(std::move(table))) {}
  explicit OrbitHistory(ElementSeries series)
      : of_(std::make_shared<const Of>(std::move(series))) {}

  template <class T>
  BasicOrbitElements<T> at(const T& t) const {
    return std::visit([&](const auto& of) { return of.at(t); }, *of_);
  }
  OrbitPlane plane(double t) const {
    return std::visit([&](const auto& of) { return of.plane(t); }, *of_);
  }
  // Where it begins and ends; infinite for a series.
  double first_time() const { return table() ? table()->first_time() : -no_end; }
  double last_time() const { return table() ? table()->last_time() : no_end; }
  // Null for a series.
  const ElementTable* table() const { return std::get_if<ElementTable>(of_.get()); }
  // Null for a table.
  const ElementSeries* series() const { return std::get_if<ElementSeries>(of_.get()); }

 private:
  using Of = std::variant<ElementTable, ElementSeries>;
  static constexpr double no_end = std::numeric_limits<double>::infinity();

  std::shared_ptr<const Of> of_;
};

}  // namespace v0
}  // namespace polhode
