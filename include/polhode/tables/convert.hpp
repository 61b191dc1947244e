// SPDX-License-Identifier: MIT
// A table of states from one chart to another: CSV in, CSV out, row by row, in constant memory.
//
// Equations   those of the charts; every conversion goes through the hub.
// Units       angles in radians, all else in any consistent units.
// Domain      the first line that is not a comment names the columns; those of the chart are found
//             by name, all others pass through as they are. Comma separated; lines that start with
//             # pass through, blank lines are dropped, CR LF is read as LF, a quoted field may hold
//             commas but no line break. Lines of at most 1 MiB. A column that the new chart has
//             too is replaced. A column may also have the name that rows of `polhode run` give it
//             (ChartVariable::column).
// Accuracy    that of the charts; numbers are written as the shortest that reads back the same.
// Errors      DomainError "NAME:LINE: ..." for the first bad row or header; all rows before it have
//             been written. What the sink throws passes through.
// Cost        below a microsecond per row between body-free charts; serret and sadov prepare a
//             motion per row.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/rotor/body.hpp"
#include "polhode/tables/chart_kind.hpp"

namespace polhode {
inline namespace v0 {

struct Conversion {
  std::string from;
  std::string to;
  std::optional<Body> body;
};

// Fills the span and returns how much of it; 0 at the end.
using ByteSource = std::function<std::size_t(std::span<char>)>;
using ByteSink = std::function<void(std::string_view)>;

// The bytes of a file, unpacked if gzip has packed them.
ByteSource file_source(const std::string& path);

// `name` stands for the input in messages. The conversion names two of the charts.
void convert(const Conversion& conversion, const std::string& name, const ByteSource& source,
             const ByteSink& sink, std::span<const ChartKind> charts = default_charts());

}  // namespace v0
}  // namespace polhode
