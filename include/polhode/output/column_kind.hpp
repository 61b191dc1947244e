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

#include "polhode/dynamics/problem.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/output/detail/column_numbers.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "polhode/system/system.hpp"
#include "polhode/tables/convert.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

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

// The columns of a row of output: t, then the column groups that a scenario asks for
// (polhode/output/column_kind.hpp).
//
// Equations   those of the charts. Attitudes and elements are those in the reference frame S; omega
//             and omega_inertial are the inertial angular velocity I^-1 g + v(terms), omega_rel the
//             one relative to S; convective is v, the frame's part included; damper is
//             the rate of a Kane damper's sphere relative to the body; *_osc are the elements
//             of g_osc = I w_SB [SA (104)-(107), (124)]; dE is E - E(0); roll, pitch and yaw as
//             polhode/rotor/attitude.hpp says; mode is 1 in short-axis, -1 in long-axis mode,
//             else 0.
// Units       each column in the units of the scenario (polhode/text/units.hpp); names and units in
//             groups().
// Domain      one symbol, one number: a column that two groups share (h, G, H of andoyer and
//             serret) is in the first of them only. With a full tensor q, g, axis1 to axis3, roll,
//             pitch, yaw and the body components of vectors refer to its axes, everything else to
//             principal axes. sadov, serret and tumbler are of the free motion through the state of
//             the row. date is a text: its number in a row is t, and files show the date.
//             Other numbers of a chart have another name in its column: sigma_0_pi.
// Accuracy    that of the motion and of the charts.
// Errors      DomainError for an unknown or repeated group; energy of a system that has none.
// Cost        one evaluation of the motion per row, and one conversion per chart; sadov,
//             serret and tumbler of a motion that is not free prepare a FreeRotation per row.

struct Column {
  std::string name;
  std::string unit;
  bool is_date = false;  // the number is t, the unit a time scale: files show the date
};
struct ColumnGroup {
  std::string name;
  std::vector<Column> columns;
};

// Numbers in one row.
inline std::size_t row_width(std::span<const ColumnGroup> groups) {
  std::size_t width = 0;
  for (const ColumnGroup& group : groups) width += group.columns.size();
  return width;
}

// What every row of a motion shares.
struct RowOrigin {
  const System& system;
  double initial_energy = 0.0;  // at t = 0; for dE
};

// One column as a function of a sample, in core units.
struct ScalarColumn {
  Dimension dimension;
  std::function<double(const Sample&)> value;
};
ScalarColumn scalar_column(std::string_view name, const System& system, double initial_energy,
                           const ColumnKinds& kinds = default_columns());

// Sadov's and Serret's sets have a branch (region, lobe, signs), the options of a chart. It is
// constant along a free motion, and a note of the output says it; another motion changes it, and
// then it has columns.
enum class Branch { in_notes, in_columns };

// What columns are called after: whether the inertial axes are those of an equator, where the pole
// is pole_ra, pole_dec instead of pole_lon, pole_lat; and the scale of the epoch, without which
// there is no date.
struct RowReference {
  bool is_equatorial = false;
  std::string time_scale = {};
};

class RowLayout {
 public:
  RowLayout(std::span<const std::string> groups, const Units& units,
            Branch branch = Branch::in_notes, const ColumnKinds& kinds = default_columns(),
            const RowReference& reference = {});

  // "t" first, then as asked for, without columns that an earlier group has.
  const std::vector<ColumnGroup>& groups() const { return groups_; }
  std::size_t width() const { return width_; }
  // Writes width() numbers per sample of a free motion to out, in inertial axes. Serret's elements,
  // constants of the motion, are those at the epoch in every row: t0 does not jump by a period.
  void write_rows(const FreeRotation& motion, std::span<const Sample> samples,
                  std::span<double> out) const;
  // The same at these times.
  void write_rows(const FreeRotation& motion, std::span<const double> times,
                  std::span<double> out) const;
  // The same for samples of any motion.
  void write_rows(const RowOrigin& origin, std::span<const Sample> samples,
                  std::span<double> out) const;

 private:
  // `constants`: numbers, by group, of those that are constant along the motion, or none.
  void write_row(const RowSample& sample, std::span<const ColumnNumbers> constants,
                 std::span<double> out) const;

  struct Cell {
    std::size_t group;  // among all kinds
    std::size_t place;  // among its numbers
    Dimension dimension;
  };
  ColumnKinds kinds_;
  std::vector<ColumnGroup> groups_;
  std::vector<Cell> cells_;
  std::size_t width_ = 0;
  Units units_;
};

}  // namespace io
}  // namespace v0
}  // namespace polhode
