// SPDX-License-Identifier: MIT
// The columns of a row of output: t, then the column groups that a scenario asks for
// (polhode/output/column_kind.hpp).
//
// Equations   those of the charts. Attitudes and elements are those in the reference frame S; omega
//             and omega_inertial are the inertial angular velocity I^-1 g + v(terms), omega_rel the
//             one relative to S; convective is v, the frame's part included; damper is
//             the rate of a Kane damper's sphere relative to the body; *_osc are the elements
//             of g_osc = I w_SB [SA (104)-(107), (124)]; dE is E - E(0); roll, pitch and yaw as
//             polhode/rotor/roll_pitch_yaw.hpp says; mode is 1 in short-axis, -1 in long-axis mode,
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
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/dynamics/problem.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/system/system.hpp"
#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode
