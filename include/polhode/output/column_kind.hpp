// SPDX-License-Identifier: MIT
// ColumnKind: all that there is to say of one group of columns: their names and dimensions, what
// they are, what they need of a run, and the function of a row. [output] columns, events, maps,
// ensembles, the reference page and Python come from it; docs/extending/column.md adds one.
//
// Equations   none of its own.
// Units       core units; files have those of the scenario (polhode/text/units.hpp).
// Domain      1 to 16 columns. A state is along principal axes; vectors that refer to the axes of
//             the body's tensor are rotated by Body::q_FB.
// Accuracy    that of the functions.
// Errors      a column without a dimension does not compile, nor does a function of column_kind
//             that returns another number of numbers. Kinds::with checks the rest. A function is
//             called from any thread; what it throws ends the run.
// Cost        that of the function, once a row.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "polhode/free/free_rotation.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/output/detail/column_numbers.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "polhode/system/system.hpp"
#include "polhode/tables/chart_kind.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {

// The state of a row. A system with a damper is that at the rate of the row.
struct RowSample {
  const System& system;
  double initial_energy;  // at t = 0
  double t;
  RotorState state;
  Vec3 damper_rate = {};  // relative to the body, principal axes
  // Null unless the motion is free in inertial axes.
  const FreeRotation* motion = nullptr;
};

// The rows that have a column: those of a motion that changes the branch of a chart, or those whose
// inertial axes are, or are not, the axes of an equator.
enum class Shown { always, on_branch, equatorial, not_equatorial };

struct GroupColumn {
  std::string_view name;
  Dimension dimension;
  Shown shown;

  constexpr GroupColumn(std::string_view its_name, Dimension of, Shown in = Shown::always)
      : name(its_name), dimension(of), shown(in) {}
};

constexpr std::size_t most_columns = 16;  // of a group
using ColumnNumbers = std::array<double, most_columns>;

// Texts are constant data: they outlive every kind.
struct ColumnKind {
  std::string_view name;             // of the group, "omega"
  std::string_view help;             // one sentence: what the numbers are
  std::vector<GroupColumn> columns;  // as the numbers
  std::function<ColumnNumbers(const RowSample&)> numbers;
  bool needs_energy = false;  // every perturbation must have an energy
  bool needs_damper = false;
  bool is_constant = false;  // along a motion that is free in inertial axes
  bool is_date = false;      // the number is t: files show the date
  // For outputs, if the names do not say enough; and the branch of a motion along which it is
  // constant, "sadov: region LAM, lobe 1".
  std::string_view note = {};
  std::function<std::string(const FreeRotation&)> branch = {};
  std::vector<Citation> citations = {};
};

// A kind whose function returns a double, a Vec3, a Quaternion or an array of doubles.
template <std::size_t N, class F>
ColumnKind column_kind(std::string_view name, std::string_view help,
                       const GroupColumn (&columns)[N], F function) {
  using Returned = std::decay_t<std::invoke_result_t<const F&, const RowSample&>>;
  static_assert(N <= most_columns, "a group has 1 to 16 columns");
  static_assert(detail::column_count<Returned> == N,
                "the function of a group returns one number for each column");
  return {.name = name,
          .help = help,
          .columns = {columns, columns + N},
          .numbers = [function = std::move(function)](const RowSample& row) {
            ColumnNumbers numbers{};
            detail::put_columns(function(row), numbers);
            return numbers;
          }};
}

// The groups that there are, in the order of documents. Copies share.
class ColumnKinds {
 public:
  // The library's, with one for each chart that is in scenarios, and more behind them.
  explicit ColumnKinds(std::span<const ChartKind> charts, std::vector<ColumnKind> more = {});

  std::span<const ColumnKind> all() const { return *all_; }
  // Null if there is none of this name, or none with this column; date is no column of numbers.
  const ColumnKind* group(std::string_view name) const;
  const ColumnKind* of_column(std::string_view name) const;
  // The name is that of a group or of a column; false if it is unknown.
  bool needs_energy(std::string_view group_or_column) const;
  bool needs_damper(std::string_view group_or_column) const;

 private:
  std::shared_ptr<const std::vector<ColumnKind>> all_;
};

// Those of default_charts().
const ColumnKinds& default_columns();

// The names that [output] columns may list, and those of all their columns but for date, which is
// no number.
std::vector<std::string_view> column_group_names(const ColumnKinds& kinds = default_columns());
std::vector<std::string_view> column_names(const ColumnKinds& kinds = default_columns());
// DomainError for an unknown column.
Dimension column_dimension(std::string_view column, const ColumnKinds& kinds = default_columns());
// The list of docs/reference/files.md.
std::string markdown_columns(const ColumnKinds& kinds = default_columns());

}  // namespace v0
}  // namespace polhode
