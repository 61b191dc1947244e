// SPDX-License-Identifier: MIT
// From one table [[ensemble.vary]] to its distribution.
#include "scenario/ensemble/vary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "scenario/scenario_parts.hpp"
#include "tables/number_table.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr std::array keys_of_vary = {
    choice_key<&VaryTable::kind, VaryKind::normal, VaryKind::uniform, VaryKind::log_uniform,
               VaryKind::joint_normal, VaryKind::direction, VaryKind::attitude, VaryKind::grid,
               VaryKind::table>(
        "kind", "normal|uniform|log-uniform|joint-normal|direction|attitude|grid|table",
        "The distribution. All numbers of the table are in the units that the keys have in "
        "this file: their own, where they were written with one, or those of [units].")
        .required()
        .example("\"normal\""),
    text_key<&VaryTable::key>(
        "key",
        "A number of this file by its keys, also one with a fallback; perturbation[0] is the "
        "first of its tables, omega_body[2] the third number of an array, body.tensor[0][1] a "
        "product of inertia with its mirror.")
        .required()
        .example("\"state.attitude-rate.omega_body[2]\"")
        .of_kinds("normal|uniform|log-uniform|grid"),
    key_list_key<&VaryTable::keys>(
        "keys",
        "Several numbers, or an array by its name. body.tensor stands for the six numbers of its "
        "upper half, row by row. A direction has the three components of a "
        "vector, which keeps its length, or two angles in either order, which are known by their "
        "names: longitude, ra or node, and latitude, dec or inclination; an attitude the four "
        "components of a quaternion.")
        .required()
        .example("[\"state.attitude-rate.omega_body\"]")
        .of_kinds("joint-normal|direction|attitude|table"),
    quantity_key<&VaryTable::mean>("mean", Dimension::number,
                                   "Left out: the number that the file has.")
        .example("1")
        .of_kinds("normal"),
    quantity_key<&VaryTable::sigma>(
        "sigma", Dimension::number,
        "Standard deviation, before low and high cut; 0 is a fixed number, the mean.")
        .required()
        .example("0.1")
        .of_kinds("normal")
        .not_negative(),
    quantity_key<&VaryTable::low>(
        "low", Dimension::number,
        "Least number; a normal one may have a bound on one side, on both, or none.")
        .example("0")
        .of_kinds("normal|uniform|log-uniform")
        .needed_by("uniform|log-uniform"),
    quantity_key<&VaryTable::high>("high", Dimension::number, "Greatest number.")
        .example("1")
        .of_kinds("normal|uniform|log-uniform")
        .needed_by("uniform|log-uniform"),
    quantity_key<&VaryTable::means>("means", Dimension::number,
                                    "Left out: the numbers that the file has.")
        .example("[0.1, 0.2, 1]")
        .of_kinds("joint-normal"),
    quantity_key<&VaryTable::covariance>("covariance", Dimension::number,
                                         "Of the keys, row by row; what others fix may be there.")
        .required()
        .example("[[0.01, 0, 0], [0, 0.01, 0.005], [0, 0.005, 0.01]]")
        .of_kinds("joint-normal"),
    quantity_key<&VaryTable::from>(
        "from", Dimension::number,
        "First value of an even grid. Several tables of this kind make one grid of all their "
        "points, the last one the fastest, which begins again where it ends.")
        .required()
        .example("0")
        .of_kinds("grid"),
    quantity_key<&VaryTable::to>("to", Dimension::number, "Its last value.")
        .required()
        .example("1")
        .of_kinds("grid"),
    integer_key<&VaryTable::count>("count", "How many values, both ends included; 1 takes from.")
        .required()
        .example("11")
        .of_kinds("grid"),
    file_key<&VaryTable::file>(
        "file",
        "A file of draws, one row each, CSV or separated by blanks, .gz or not; the path is "
        "from the folder of this file.")
        .required()
        .example("\"clones.csv\"")
        .of_kinds("table"),
    columns_key<&VaryTable::columns>(
        "columns",
        "Its column for each number of keys, by name or by number from 1; left out, the first "
        "ones.")
        .example("[\"wx\", \"wy\", \"wz\"]")
        .of_kinds("table"),
    choice_key<&VaryTable::order, ensemble::RowOrder::in_order,
               ensemble::RowOrder::with_replacement>(
        "order", "rows|draws",
        "Whether member 0 has the first row and so on, or each member a row that is drawn.")
        .otherwise("\"rows\"")
        .of_kinds("table"),
};
constexpr KindText kinds_of_vary[] = {
    {"ensemble.vary[]", "normal", "A normal number, between two bounds where they are given."},
    {"ensemble.vary[]", "uniform", "Every number between two alike."},
    {"ensemble.vary[]", "log-uniform", "A positive number whose logarithm is uniform."},
    {"ensemble.vary[]", "joint-normal", "Several normal numbers with a covariance."},
    {"ensemble.vary[]", "direction", "A direction of the sky, all of them alike."},
    {"ensemble.vary[]", "attitude", "An attitude, all of them alike (Haar's measure)."},
    {"ensemble.vary[]", "grid", "Points at even distances."},
    {"ensemble.vary[]", "table", "The rows of a file: a posterior, clones of an orbit."},
};

}  // namespace

constexpr Table<VaryTable> vary_description = {
    {.path = "ensemble.vary[]",
     .presence = Presence::required,
     .help = "What the members differ in. What is drawn for a key depends on the seed, the keys of "
             "its table and the index of the member, not on the other tables."},
    keys_of_vary,
    {},
    kinds_of_vary};

namespace {

constexpr std::string_view around[] = {"longitude", "ra", "node", "phi", "precession"};
constexpr std::string_view from_equator[] = {"latitude", "dec"};
constexpr std::string_view from_pole[] = {"inclination", "theta", "obliquity"};

// "latitude" of "state.tumbler.pole.latitude".
std::string_view end_of(std::string_view key) { return key.substr(key.rfind('.') + 1); }

bool is_one(std::span<const std::string_view> names, std::string_view key) {
  return std::ranges::find(names, end_of(key)) != names.end();
}

}  // namespace

std::optional<DirectionAngles> direction_angles(std::span<const std::string> keys) {
  if (keys.size() != 2) return std::nullopt;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string& tilt = keys[1 - i];
    if (!is_one(around, keys[i])) continue;
    if (is_one(from_equator, tilt)) return DirectionAngles{i, false};
    if (is_one(from_pole, tilt)) return DirectionAngles{i, true};
  }
  return std::nullopt;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string count_text(std::size_t n, const char* what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

// "low 3 must be below high" of "Uniform: low 3 must be below high": a file has no class.
template <class Build>
ensemble::Distribution without_class(const Build& build) {
  try {
    return build();
  } catch (const DomainError& error) {
    std::string said = error.what();
    for (const std::string_view name : {"TruncatedNormal: ", "Normal: ", "Uniform: ",
                                        "LogUniform: ", "JointNormal: ", "DrawGrid: axis[0]: "})
      if (said.starts_with(name)) throw DomainError(said.substr(name.size()));
    throw;
  }
}

// One table and the numbers that it varies.
class Drawn {
 public:
  Drawn(const Placed<VaryTable>& from, const VariedNumbers& numbers)
      : from_(from), numbers_(numbers) {}

  VariedTable made() const {
    switch (from_->kind) {
      case VaryKind::normal:
        return normal();
      case VaryKind::uniform:
        return between<ensemble::Uniform>("uniform");
      case VaryKind::log_uniform:
        return between<ensemble::LogUniform>("log-uniform");
      case VaryKind::joint_normal:
        return joint_normal();
      case VaryKind::direction:
        return direction();
      case VaryKind::attitude:
        require_keys(4, "the four components of a quaternion");
        return one("attitude, all alike", ensemble::UniformAttitude());
      case VaryKind::grid:
        return grid();
      case VaryKind::table:
        return table();
    }
    throw std::logic_error("ensemble.vary: a kind without a distribution");
  }

 private:
  // Reports a DomainError of the distribution at the key of the member, without its class name.
  template <auto member, class Build>
  VariedTable one(std::string text, const Build& build) const {
    return one(std::move(text), from_.built<member>([&] {
      return without_class([&] { return ensemble::Distribution(build()); });
    }));
  }
  VariedTable one(std::string text, ensemble::Distribution distribution) const {
    return {{std::move(text), numbers_.keys, numbers_.units}, std::move(distribution)};
  }

  VariedTable normal() const {
    const double mean = from_->mean.value_or(numbers_.values[0]), sigma = from_->sigma;
    std::string text = "normal, mean " + polhode::detail::number_text(mean) + ", sigma " +
                       polhode::detail::number_text(sigma);
    if (!from_->low && !from_->high)
      return one<&VaryTable::sigma>(text, [&] { return ensemble::Normal(mean, sigma); });
    if (from_->low) text += ", from " + polhode::detail::number_text(*from_->low);
    if (from_->high) text += ", to " + polhode::detail::number_text(*from_->high);
    const auto cut = [&] {
      return ensemble::TruncatedNormal(mean, sigma, from_->low.value_or(-infinity),
                                       from_->high.value_or(infinity));
    };
    return from_->low ? one<&VaryTable::low>(text, cut) : one<&VaryTable::high>(text, cut);
  }

  template <class Of>
  VariedTable between(const std::string& kind) const {
    const double low = *from_->low, high = *from_->high;
    return one<&VaryTable::low>(kind + ", " + polhode::detail::number_text(low) + " to " +
                                    polhode::detail::number_text(high),
                                [&] { return Of(low, high); });
  }

  VariedTable joint_normal() const {
    const std::size_t n = numbers_.keys.size();
    const std::vector<double> means = from_->means.value_or(numbers_.values);
    if (means.size() != n)
      from_.refuse<&VaryTable::means>("expected " + count_text(n, "number") +
                                      ", one for each of keys");
    if (from_->covariance.size != n)
      from_.refuse<&VaryTable::covariance>("expected " + count_text(n, "row") + " of " +
                                           count_text(n, "number") + ", one for each of keys");
    return one<&VaryTable::covariance>(
        "joint normal", [&] { return ensemble::JointNormal(means, from_->covariance.elements); });
  }

  void require_keys(std::size_t n, const std::string& words) const {
    if (numbers_.keys.size() != n)
      from_.refuse<&VaryTable::keys>("expected " + words + "; " +
                                     count_text(numbers_.keys.size(), "number"));
  }
  void require_one_unit() const {
    if (std::ranges::any_of(numbers_.units,
                            [&](const std::string& unit) { return unit != numbers_.units[0]; }))
      from_.refuse<&VaryTable::keys>("expected keys whose numbers have one unit in this file");
  }

  VariedTable direction() const {
    using Shape = EnsembleVaried::Shape;
    const auto is_angle = [&](const NumberLocation& place) {
      return value_at(from_.at().values(), place.path).key->dimension == Dimension::angle;
    };
    VariedTable made = one("direction, all alike", ensemble::IsotropicDirection());
    if (numbers_.keys.size() == 2 && std::ranges::all_of(numbers_.places, is_angle)) {
      if (!direction_angles(numbers_.keys))
        from_.refuse<&VaryTable::keys>(
            "expected a longitude, ra or node and a latitude, dec or inclination, whose names "
            "say which goes round and from where the other counts");
      require_one_unit();
      made.varied.shape = Shape::angles;
      made.varied.scale = from_.at().units().to_core(1.0, numbers_.units[0], Dimension::angle);
      return made;
    }
    require_keys(3,
                 "three components of a vector, or two angles: longitude and latitude, in "
                 "either order");
    require_one_unit();
    const std::vector<double>& v = numbers_.values;
    made.varied.shape = Shape::vector;
    made.varied.scale = std::hypot(v[0], v[1], v[2]);
    if (!(made.varied.scale > 0.0))
      from_.refuse<&VaryTable::keys>("expected a vector whose length in the file is not 0");
    return made;
  }

  VariedTable grid() const {
    const ensemble::DrawAxis axis{from_->from, from_->to, from_->count};
    return one<&VaryTable::count>("grid, " + polhode::detail::number_text(axis.from) + " to " +
                                      polhode::detail::number_text(axis.to) + ", " +
                                      std::to_string(axis.count) + " values",
                                  [&] { return ensemble::DrawGrid({axis}); });
  }

  VariedTable table() const {
    const std::size_t n = numbers_.keys.size();
    std::vector<std::string> columns = from_->columns.value_or(std::vector<std::string>());
    if (!from_->columns)
      for (std::size_t i = 0; i < n; ++i) columns.push_back(std::to_string(i + 1));
    if (columns.size() != n)
      from_.refuse<&VaryTable::columns>("expected " + count_text(n, "column") +
                                        ", one for each of keys");
    return one<&VaryTable::file>("table " + from_->file, [&] {
      const NumberTable read = read_number_table(from_.file_at<&VaryTable::file>(), columns);
      std::vector<double> rows;
      rows.reserve(read.rows() * n);
      for (std::size_t k = 0; k < read.rows(); ++k)
        for (const std::vector<double>& column : read.columns) rows.push_back(column[k]);
      return ensemble::DrawTable(n, std::move(rows), from_->order);
    });
  }

  const Placed<VaryTable>& from_;
  const VariedNumbers& numbers_;
};

// Keys that are there and hold something else than a number, or are not the members' own.
void require_can_vary(const KeyValues& table, std::string_view name, const std::string& key) {
  const auto found = table.values().find(key);
  if (key.starts_with("ensemble.") || key.starts_with("map.") || key == "schema")
    table.refuse(name,
                 "expected a key that holds a number and belongs to the members: those of "
                 "[ensemble] and [map], and schema, are of all of them together; " +
                     key + " cannot vary");
  if (found == table.values().end() || found->second.key->type == KeyType::table ||
      is_number(found->second))
    return;
  table.refuse(name, "expected a key that holds a number which can be any; " + key +
                         " cannot vary: make a file for each of its values");
}

}  // namespace

VariedNumbers varied_numbers(const KeyValues& table, std::string_view name) {
  const Values& values = table.values();
  const bool several = value_at(values, table.key_path(name)).key->type == KeyType::key_list;
  VariedNumbers all;
  for (const std::string& key : table.words(name)) {
    require_can_vary(table, name, key);
    const std::vector<NumberLocation> places = number_locations(values, key);
    if (places.empty() || (!several && places.size() > 1)) {
      const std::vector<std::string> keys = number_keys(values, key);
      const std::string near =
          did_you_mean(key, std::vector<std::string_view>(keys.begin(), keys.end()));
      table.refuse(
          name,
          (several ? "expected keys that hold numbers and stand in this file or have a fallback, "
                     "such as state.euler.theta or body.moments[1]; " +
                         key + " is none"
                   : "expected a key that holds a number and stands in this file or has a "
                     "fallback, such as state.euler.theta or body.moments[1]") +
              near);
    }
    for (const NumberLocation& place : places) {
      const Value& value = value_at(values, place.path);
      if (place.path.starts_with("time."))
        table.refuse(name, "expected no key of [time]: all members have rows at the same times");
      all.keys.push_back(key_text(values, place));
      all.places.push_back(place);
      all.units.push_back(unit_in_file(value, place.index, table.units()));
      all.values.push_back(number_in_file(value, place.index, table.units()));
    }
  }
  return all;
}

VariedTable varied_table(const Placed<VaryTable>& table, const VariedNumbers& numbers) {
  return Drawn(table, numbers).made();
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
