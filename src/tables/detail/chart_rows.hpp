// SPDX-License-Identifier: MIT
// The charts of `convert`: a row of numbers to the hub and back.
#pragma once

#include <array>
#include <cstddef>

#include "polhode/rotor/rotor_state.hpp"
#include "polhode/tables/convert.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

constexpr std::size_t widest_chart = 13;  // with its optional columns
using ChartRow = std::array<double, widest_chart>;

struct ChartContext {
  const Body* body;  // null where no chart needs one
  double t;          // of the row; 0 without a column t
};

struct ChartMaps {
  TableChart chart;
  // Throws DomainError for numbers that are no state.
  RotorState (*hub)(const ChartRow&, const ChartContext&);
  ChartRow (*row)(const RotorState&, const ChartContext&);
};

// Throws DomainError with the option that named it and the nearest known name.
const ChartMaps& chart_maps(const std::string& name, const char* option);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
