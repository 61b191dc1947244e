// SPDX-License-Identifier: MIT
// Tables whose columns and units a scenario declares.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "polhode/tables/number_table.hpp"
#include "scenario/detail/history_keys.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "text/word_list.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::string_view unread = "-";

const ColumnRole* role_of(std::span<const ColumnRole> roles, std::string_view name) {
  const auto found = std::find_if(roles.begin(), roles.end(),
                                  [&](const ColumnRole& one) { return one.name == name; });
  return found == roles.end() ? nullptr : &*found;
}

void require_words(const KeyValues& at, std::span<const ColumnRole> roles) {
  const std::vector<std::string>& columns = at.words("columns");
  if (at.words("units").size() != columns.size())
    at.refuse("units", "expected " + std::to_string(columns.size()) +
                           " units, one for each of columns; \"1\" for numbers and for columns "
                           "that are not read");
  std::vector<std::string_view> known;
  for (const ColumnRole& role : roles) known.push_back(role.name);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == unread) continue;
    if (role_of(roles, columns[i]) == nullptr)
      at.refuse("columns", "expected words out of " + one_of(known, "\"") +
                               ", and \"-\" for a column that is not read; got \"" + columns[i] +
                               "\"");
    if (std::find(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(i), columns[i]) !=
        columns.begin() + static_cast<std::ptrdiff_t>(i))
      at.refuse("columns", "expected each word once; got \"" + columns[i] + "\" twice");
  }
}

}  // namespace

DeclaredColumns::DeclaredColumns(const KeyValues& at, std::string_view file,
                                 std::span<const ColumnRole> roles)
    : columns_(roles.size()), units_(roles.size(), 1.0) {
  require_words(at, roles);
  const std::vector<std::string>&words = at.words("columns"), &units = at.words("units");
  const std::string path = at.file_at(file);
  const std::vector<std::string> own = table_columns(path);
  const bool by_name = std::all_of(words.begin(), words.end(), [&](const std::string& word) {
    return word == unread || std::find(own.begin(), own.end(), word) != own.end();
  });
  std::vector<std::string> wanted;
  std::vector<std::pair<const ColumnRole*, double>> read;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const ColumnRole* const role = role_of(roles, words[i]);
    if (role == nullptr || !role->is_read) continue;
    const double unit =
        at.built("units", [&] { return at.units().to_core(1.0, units[i], role->dimension); });
    wanted.push_back(by_name ? words[i] : std::to_string(i + 1));
    read.emplace_back(role, unit);
  }
  NumberTable table = read_number_table(path, wanted);
  for (std::size_t i = 0; i < read.size(); ++i) {
    for (double& x : table.columns[i]) x *= read[i].second;
    const auto place = static_cast<std::size_t>(read[i].first - roles.data());
    columns_[place] = std::move(table.columns[i]);
    units_[place] = read[i].second;
  }
  if (table.lines.empty()) at.refuse(file, "expected a table with rows; this file has none");
  file_ = std::move(table.file);
  lines_ = std::move(table.lines);
}

std::string DeclaredColumns::place(std::size_t row) const {
  return file_ + ":" + std::to_string(lines_.at(row)) + ": ";
}

bool may_be_radians(std::span<const double> angles, double degree) {
  constexpr std::size_t few = 8;  // of which nothing is said
  if (angles.size() < few) return false;
  const auto [least, most] = std::minmax_element(angles.begin(), angles.end());
  const double turn = 2.0 * std::numbers::pi * degree;
  return *least >= -turn && *most <= turn && *most - *least > 0.5 * turn;
}

Quaternion ecliptic_from(std::string_view axes) {
  const auto about = [](int axis, double angle) {
    const double c = std::cos(0.5 * angle), s = std::sin(0.5 * angle);
    return axis == 1 ? Quaternion{c, s, 0.0, 0.0} : Quaternion{c, 0.0, 0.0, s};
  };
  if (axes == "equator-J2000") return about(1, -obliquity_J2000);
  // of the solar system: Souami & Souchay (2012). Axis 1 is its ascending node on the ecliptic.
  constexpr double degree = std::numbers::pi / 180.0;
  if (axes == "invariable-plane")
    return about(3, 107.582273 * degree) * about(1, 1.578703 * degree);
  return {};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
