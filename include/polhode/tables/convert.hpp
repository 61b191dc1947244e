// SPDX-License-Identifier: MIT
// In this header: chart_kind, convert.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/free/free_rotation.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// ChartKind: all that there is to say of one chart of states: its numbers, how they become a state
// of the hub and come back, what they rest on. Tables to convert, [state.CHART] of a scenario, the
// columns of its rows, their pages and templates, and citations come from it.
//
// Equations   none of its own; the charts have theirs (polhode/rotor/, polhode/free/).
// Units       angles in radians, all else in any consistent units.
// Domain      a chart refers to data that live as long as the program: constants, beside its
//             functions. At most most_chart_numbers numbers, options included.
// Accuracy    that of the charts.
// Errors      a number without a dimension or a sentence does not compile. to_hub throws a
//             DomainError for numbers that are no state; with_chart for a chart that cannot be one.
// Cost        that of the charts.

// One number of a chart.
struct ChartVariable {
  std::string_view name;
  Dimension dimension;
  std::string_view help;     // one sentence
  std::string_view example;  // as TOML
  // In rows, where another chart has a number of this name that is not the same.
  std::string_view column;
  // What [state.CHART] may leave out: "0", or the name of a variable that has the same number then.
  std::string_view otherwise;

  consteval ChartVariable(std::string_view own, Dimension of, std::string_view sentence,
                          std::string_view toml, std::string_view in_rows = {},
                          std::string_view left_out = {})
      : name(own),
        dimension(of),
        help(sentence),
        example(toml),
        column(in_rows),
        otherwise(left_out) {
    if (own.empty()) throw "a number of a chart needs a name";
    if (!sentence.ends_with('.')) throw "a number of a chart needs a sentence that says what it is";
    if (toml.empty()) throw "a number of a chart needs an example";
    if (in_rows.empty()) column = own;
  }
};

// What tells states apart that have the same numbers: one of some words, such as "1|-1" or
// "SAM|LAM". As a number: 1 or -1, or the place of the word from 0; NaN where it is left out.
struct ChartOption {
  std::string_view name;
  std::string_view words;
  std::string_view fallback;  // empty: found by ChartKind::completed
  std::string_view help;
  std::string_view example;

  consteval ChartOption(std::string_view own, std::string_view any_of, std::string_view otherwise,
                        std::string_view sentence, std::string_view one)
      : name(own), words(any_of), fallback(otherwise), help(sentence), example(one) {
    if (own.empty() || any_of.empty()) throw "an option of a chart needs a name and words";
    if (!sentence.ends_with('.'))
      throw "an option of a chart needs a sentence that says what it is";
  }
};

// The numbers of a chart in the order of its variables, then its options.
constexpr std::size_t most_chart_numbers = 16;
using ChartNumbers = std::array<double, most_chart_numbers>;

// Where a state stands. The body is null for a chart that needs none.
struct ChartPlace {
  const Body* body;
  double t = 0.0;
};

// A field of the class of states that is the same in all states of a chart: {"pole_J", "zero"}.
struct ChartField {
  std::string_view name;
  std::string_view word;
};

struct ChartKind {
  std::string_view name;  // "andoyer"
  std::string_view help;  // one sentence
  std::span<const ChartVariable> variables;
  RotorState (*to_hub)(const ChartNumbers&, const ChartPlace&);
  ChartNumbers (*from_hub)(const RotorState&, const ChartPlace&);
  bool needs_body = false;
  // Whether scenarios know it: [state.NAME], and a group of columns of this name.
  bool in_scenarios = false;
  std::span<const ChartOption> options = {};
  // Gives options that were left out and have no fallback.
  ChartNumbers (*completed)(const ChartNumbers&, const ChartPlace&) = nullptr;

  // A chart of motions: the numbers at a time, and the motion that they give where that is more
  // than the one through to_hub. They are constants of free rotation, one of them an instant: then
  // a table needs the time of its rows, and the rows of a free motion have the numbers at t = 0.
  ChartNumbers (*from_motion)(const FreeRotation&, double t) = nullptr;
  FreeRotation (*to_motion)(const Body&, const ChartNumbers&) = nullptr;
  bool is_constant = false;

  // The order of the variables as columns of rows, where it is another one.
  std::span<const std::size_t> column_order = {};
  // The options as columns, where these are others: their names, and what they say.
  std::span<const std::string_view> branch_columns = {};
  ChartNumbers (*to_columns)(const ChartNumbers&) = nullptr;
  ChartNumbers (*from_columns)(const ChartNumbers&) = nullptr;

  // The class of its states, "AndoyerState", and what of it does not vary.
  std::string_view state_class = {};
  std::span<const ChartField> state_fields = {};
  std::span<const Citation> sources = {};
};

// A state in a chart.
struct ChartState {
  ChartKind chart;
  ChartNumbers numbers;
};

// Ours, in the order of documents, and with one more after them.
const std::vector<ChartKind>& default_charts();
std::vector<ChartKind> with_chart(std::span<const ChartKind> charts, const ChartKind& chart);
// Null where there is none of this name.
const ChartKind* chart_named(std::string_view name,
                             std::span<const ChartKind> charts = default_charts());

// The names of the columns behind those of the variables.
std::vector<std::string_view> branch_columns(const ChartKind& chart);
// A word of an option as a number, and back; NaN for what is none.
double option_number(const ChartOption& option, std::string_view word);
std::string_view option_word(const ChartOption& option, double number);
// With the options that were left out. DomainError for a number that is no word of its option.
ChartNumbers completed(const ChartKind& chart, const ChartNumbers& numbers,
                       const ChartPlace& place);
// The numbers with the columns of the branch in the place of options, and back.
ChartNumbers to_columns(const ChartKind& chart, const ChartNumbers& numbers);
ChartNumbers from_columns(const ChartKind& chart, const ChartNumbers& columns);

// The free motion through a state.
FreeRotation free_rotation(const Body& body, const ChartState& state);

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

}  // namespace io
}  // namespace v0
}  // namespace polhode
