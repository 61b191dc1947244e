// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "torque-table".
#include "polhode/perturb/torque_table.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/table_check.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"
#include "tables/number_table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

using Between = TorqueTable::Between;
using Outside = TorqueTable::Outside;
using Column = std::optional<std::vector<double>>;

struct Arguments {
  std::optional<std::vector<double>> times;
  Column torque_1, torque_2, torque_3;
  std::optional<std::string> file;
  std::optional<std::vector<std::string>> columns;
  std::optional<std::string> time_unit, torque_unit;
  Between between;
  Outside outside;
  TorqueAxes axes;
};

template <auto at>
consteval KindKey<Arguments> torque_key(std::string_view name, std::string_view help) {
  return quantity_key<at>(name, Dimension::torque, help).example("[0, 0.001, 0]");
}

constexpr KindKey<Arguments> keys[] = {
    quantity_key<&Arguments::times>("times", Dimension::time, "Times of the rows, increasing.")
        .alternative()
        .example("[0, 60, 61]"),
    torque_key<&Arguments::torque_1>("torque_1",
                                     "Torque about axis 1 in every row; left out, none."),
    torque_key<&Arguments::torque_2>("torque_2", "About axis 2."),
    torque_key<&Arguments::torque_3>("torque_3", "About axis 3.").shown(),
    file_key<&Arguments::file>("file",
                               "A file of such rows, CSV or separated by blanks, .gz or not; the "
                               "path is from the folder of this file.")
        .alternative()
        .example("\"thruster.csv\""),
    columns_key<&Arguments::columns>(
        "columns",
        "Its columns of time and torque about the three axes, by the names that the file gives "
        "them or by their numbers from 1; left out, the first four.")
        .example("[\"t\", \"x\", \"y\", \"z\"]"),
    unit_key<&Arguments::time_unit>(
        "time_unit", "Unit of its times, which count from t = 0; left out, `units.time`.")
        .example("\"s\""),
    unit_key<&Arguments::torque_unit>("torque_unit",
                                      "Unit of its torques; left out, that of the file's torques.")
        .example("\"N m\""),
    choice_key<&Arguments::between, Between::step, Between::linear, Between::cubic>(
        "between", "step|linear|cubic",
        "Between rows: the row before, a straight line, or a cubic that keeps the shape.")
        .otherwise("\"linear\""),
    choice_key<&Arguments::outside, Outside::zero, Outside::hold, Outside::refuse>(
        "outside", "zero|hold|error",
        "Before the first row and after the last: no torque, that of the row, or an error.")
        .otherwise("\"zero\""),
    torque_axes_key<&Arguments::axes>(),
};

// The columns of the table itself, side by side.
std::vector<TorqueRow> own_rows(const Arguments& a, const TermContext& at) {
  const std::vector<double>& t = *a.times;
  std::vector<TorqueRow> rows(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) rows[i].t = t[i];
  const Column* const columns[] = {&a.torque_1, &a.torque_2, &a.torque_3};
  const char* const names[] = {"torque_1", "torque_2", "torque_3"};
  for (int axis = 0; axis < 3; ++axis) {
    if (!*columns[axis]) continue;  // no torque about that axis
    const std::vector<double>& u = **columns[axis];
    if (u.size() != t.size())
      at.refuse(names[axis],
                "expected " + std::to_string(t.size()) + " numbers, as many as times has");
    for (std::size_t i = 0; i < t.size(); ++i) rows[i].torque[axis] = u[i];
  }
  return rows;
}

std::vector<TorqueRow> rows_of_file(const Arguments& a, const TermContext& at) {
  const std::vector<std::string> columns =
      a.columns.value_or(std::vector<std::string>{"1", "2", "3", "4"});
  if (columns.size() != 4) at.refuse("columns", "expected 4 columns: time and three torques");
  const double time = at.unit("time_unit", Dimension::time);
  const double torque = at.unit("torque_unit", Dimension::torque);
  const NumberTable table = at.built("file", [&] {
    NumberTable read = read_number_table(at.file_at("file"), columns);
    require_rising(read, 0, "time");
    const TableCheck check(at, read, columns);
    check.unit(0, {"time_unit", time, Dimension::time});
    for (std::size_t k = 1; k < columns.size(); ++k)
      check.unit(k, {"torque_unit", torque, Dimension::torque});
    check.epoch();
    check.torque_axes(at.word("axes"));
    return read;
  });
  std::vector<TorqueRow> rows;
  rows.reserve(table.rows());
  const auto& c = table.columns;
  for (std::size_t k = 0; k < table.rows(); ++k)
    rows.push_back({time * c[0][k], {torque * c[1][k], torque * c[2][k], torque * c[3][k]}});
  return rows;
}

// Keys that belong to the other way of giving rows.
void require_one_way(const Arguments& a, const TermContext& at) {
  for (const char* own : {"columns", "time_unit", "torque_unit"})
    if (!a.file && at.is_explicit(own)) at.refuse(own, "expected a key file as well");
  for (const char* own : {"torque_1", "torque_2", "torque_3"})
    if (a.file && at.is_explicit(own)) at.refuse(own, "expected a key times as well, not file");
}

// Its rows as columns of its own, all three of them.
Arguments principal(Arguments a, const TermContext& at) {
  require_one_way(a, at);
  std::vector<TorqueRow> rows = a.file ? rows_of_file(a, at) : own_rows(a, at);
  a.times.emplace();
  for (Column* const column : {&a.torque_1, &a.torque_2, &a.torque_3}) column->emplace();
  for (const TorqueRow& row : rows) {
    const Vec3 u = a.axes == TorqueAxes::body ? at.principal(row.torque) : row.torque;
    a.times->push_back(row.t);
    a.torque_1->push_back(u.x);
    a.torque_2->push_back(u.y);
    a.torque_3->push_back(u.z);
  }
  a.file = a.time_unit = a.torque_unit = std::nullopt;
  a.columns = std::nullopt;
  return a;
}

MadeTerms made(const Arguments& a, const TermContext& at) {
  return at.built(at.has("file") ? "file" : "times", [&]() -> AnyPerturbation {
    return {at.name("torque table"),
            TorqueTable(own_rows(a, at), {a.between, a.outside, space_axes(a.axes)})};
  });
}

}  // namespace

PerturbationKind torque_table_kind() {
  PerturbationKind kind = perturbation_kind<Arguments>(
      "torque-table", "A torque that is a table of time: thrusters, a control log.", keys, made,
      {{"fritsch1984",
        "Fritsch, F. N., Butland, J. (1984). A method for constructing local monotone piecewise "
        "cubic interpolants. SIAM Journal on Scientific and Statistical Computing 5, 300-304.",
        "torque tables by cubics"}},
      principal);
  kind.sets = "times|file";
  kind.equations =
      "Collocation, Adaptive and VariationOfConstants end a step wherever it is not smooth\n"
      "(`breakpoints`), so that no pulse is missed. Splitting rejects it.";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
