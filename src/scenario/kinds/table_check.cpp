// SPDX-License-Identifier: MIT
#include "scenario/detail/table_check.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "polhode/scenario/schema.hpp"
#include "polhode/text/units.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/tables/state.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr double same_unit = 1e-12;
constexpr double same_epoch = 1e-3;  // s: headers have milliseconds

std::string in_quotes(std::string_view text) { return "\"" + printable(std::string(text)) + "\""; }

// The name that the file gives a column that was asked for by its number.
std::string name_of(const std::string& column, const std::vector<std::string>& names) {
  std::size_t number = 0;
  const char* const end = column.data() + column.size();
  const auto [stop, error] = std::from_chars(column.data(), end, number);
  const bool is_number = error == std::errc() && stop == end;
  return is_number && number >= 1 && number <= names.size() ? names[number - 1] : column;
}

ephemeris::Date date_of(const TableHeader::Note& said) {
  try {
    return epoch_date(said.text);
  } catch (const DomainError& error) {
    throw DomainError(said.at + in_quotes(said.text) + ": " + error.what());
  }
}

}  // namespace

TableCheck::TableCheck(const KeyValues& at, const NumberTable& file,
                       const std::vector<std::string>& columns)
    : at_(at), header_(header_of(file)) {
  for (const std::string& column : columns) names_.push_back(name_of(column, file.names));
}

// A unit of its own before that of its kind.
const TableHeader::Note* TableCheck::said_of(std::size_t column, Dimension dimension) const {
  const auto own = header_.columns.find(names_.at(column));
  if (own != header_.columns.end()) return &own->second;
  const auto stated = [](const std::optional<TableHeader::Note>& note) {
    return note ? &*note : nullptr;
  };
  if (dimension == Dimension::time) return stated(header_.time);
  if (dimension == Dimension::length) return stated(header_.length);
  return dimension == Dimension::speed ? stated(header_.speed) : nullptr;
}

void TableCheck::unit(std::size_t column, const Read& read) const {
  const TableHeader::Note* const said = said_of(column, read.dimension);
  if (said == nullptr) return;
  double right = read.unit;
  try {
    right = at_.units().to_core(1.0, said->text, read.dimension);
  } catch (const DomainError& error) {
    // A scenario without a unit of length or moment has nothing to compare with.
    const bool of_orbit = read.dimension == Dimension::length || read.dimension == Dimension::speed;
    if (read.dimension != Dimension::time &&
        (of_orbit ? at_.units().length() : at_.units().moment()) == "1")
      return;
    throw DomainError(said->at + "column " + printable(names_.at(column)) + ": " + error.what());
  }
  if (std::fabs(read.unit - right) > same_unit * right)
    throw DomainError(said->at + "column " + printable(names_.at(column)) + " is in " +
                      printable(said->text) + "; expected " + read.key + " = " +
                      in_quotes(said->text) + " with the file");
}

void TableCheck::axes(const std::string& used) const {
  if (!header_.axes || header_.axes->text == used) return;
  const std::string its = header_.axes->at + "its axes are " + printable(header_.axes->text) + "; ";
  if (!is_axes(header_.axes->text))
    throw DomainError(
        its +
        "expected \"inertial\", \"ecliptic-J2000\" or \"equator-J2000\": turn the "
        "table into one of them, or take the line out if it is one of them by another "
        "name");
  throw DomainError(its + "expected axes = " + in_quotes(header_.axes->text) +
                    " with the file or in [state], not " + in_quotes(used));
}

void TableCheck::torque_axes(const std::string& used) const {
  if (!header_.axes || header_.axes->text == used) return;
  if (used == "inertial") return axes(state_table(at_.file_values())->axes);
  throw DomainError(header_.axes->at + "its axes are " + printable(header_.axes->text) +
                    "; expected torques along " + in_quotes(header_.axes->text) +
                    ", not axes = " + in_quotes(used));
}

void TableCheck::epoch() const {
  if (!header_.epoch) return;
  const TableHeader::Note& said = *header_.epoch;
  const std::string counts = said.at + "t counts from " + printable(said.text);
  const std::optional<std::string> epoch = state_table(at_.file_values())->epoch;
  if (!epoch)
    throw DomainError(counts + "; expected epoch = " + in_quotes(said.text) + " in [state]");
  const Clock clock = clock_of(at_.file_values(), at_.key_path("file"));
  const double apart = ephemeris::seconds_between(clock.epoch, date_of(said), clock.dut1);
  if (std::fabs(apart) > same_epoch)
    throw DomainError(counts + ", " + polhode::detail::number_text(apart) + " s after epoch = " +
                      in_quotes(*epoch) + "; expected a table from that epoch on, or dates");
}

void TableCheck::scale(const std::string& used) const {
  const std::optional<std::string_view> said = scale_of_column(names_.at(0));
  if (!said || *said == used) return;
  throw DomainError("its column " + in_quotes(names_.at(0)) + " holds dates in " +
                    std::string(*said) + "; expected time_scale = " + in_quotes(*said) +
                    " with the file, not " + in_quotes(used));
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
