// SPDX-License-Identifier: MIT
// From one table [[ensemble.vary]] to its distribution.
#include "scenario/ensemble/vary.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>
#include <utility>

#include "polhode/tables/number_table.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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

// A number of the file in the unit that it has there.
double own_number(const Value& value, std::size_t index, const Units& units) {
  const Dimension dimension = value.key->dimension;
  const double core = value.numbers[index];
  if (value.units[index].empty()) return units.from_core(core, dimension);
  return core / units.to_core(1.0, value.units[index], dimension);
}

std::string count_text(std::size_t n, const char* what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

// "low 3 must be below high" of "Uniform: low 3 must be below high": a file has no class.
template <class Build>
Distribution without_class(const Build& build) {
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

// One table, its numbers and where messages about it point.
class Table {
 public:
  Table(const FileValues& at, std::string path, const VariedNumbers& numbers)
      : at_(at), path_(std::move(path)), numbers_(numbers) {}

  VariedTable made() const {
    const std::string& kind = word(at_.values, path_ + ".kind");
    if (kind == "normal") return normal();
    if (kind == "uniform") return between<Uniform>("uniform");
    if (kind == "log-uniform") return between<LogUniform>("log-uniform");
    if (kind == "joint-normal") return joint_normal();
    if (kind == "direction") return direction();
    if (kind == "attitude") return attitude();
    if (kind == "grid") return grid();
    return table();
  }

 private:
  std::string key(const char* name) const { return path_ + "." + name; }
  double number_at(const char* name) const { return number(at_.values, key(name)); }
  bool has_own(const char* name) const { return has(at_.values, key(name)); }
  [[noreturn]] void refuse_at(const char* name, const std::string& message) const {
    refuse(at_.values, key(name), at_.name, message);
  }
  // Of a distribution; what it refuses is said at one of the keys, without the name of its class.
  template <class Build>
  Distribution built_at(const char* name, const Build& build) const {
    return built(at_.values, key(name), at_.name,
                 [&] { return without_class([&] { return Distribution(build()); }); });
  }

  VariedTable one(std::string text, Distribution distribution) const {
    return {{std::move(text), numbers_.keys, numbers_.units}, std::move(distribution), {}};
  }

  VariedTable normal() const {
    require_range(at_.values, key("sigma"), at_.name);
    const double mean = has_own("mean") ? number_at("mean") : numbers_.values[0];
    const double sigma = number_at("sigma");
    std::string text = "normal, mean " + number_text(mean) + ", sigma " + number_text(sigma);
    if (!has_own("low") && !has_own("high"))
      return one(text, built_at("sigma", [&] { return Normal(mean, sigma); }));
    const double low = has_own("low") ? number_at("low") : -infinity;
    const double high = has_own("high") ? number_at("high") : infinity;
    if (has_own("low")) text += ", from " + number_text(low);
    if (has_own("high")) text += ", to " + number_text(high);
    return one(text, built_at(has_own("low") ? "low" : "high",
                              [&] { return TruncatedNormal(mean, sigma, low, high); }));
  }

  template <class Of>
  VariedTable between(const std::string& kind) const {
    const double low = number_at("low"), high = number_at("high");
    return one(kind + ", " + number_text(low) + " to " + number_text(high),
               built_at("low", [&] { return Of(low, high); }));
  }

  VariedTable joint_normal() const {
    const std::size_t n = numbers_.keys.size();
    const std::vector<double> means =
        has_own("means") ? value_at(at_.values, key("means")).numbers : numbers_.values;
    if (means.size() != n)
      refuse_at("means", "expected " + count_text(n, "number") + ", one for each of keys");
    const std::vector<double>& covariance = value_at(at_.values, key("covariance")).numbers;
    if (covariance.size() != n * n)
      refuse_at("covariance", "expected " + count_text(n, "row") + " of " +
                                  count_text(n, "number") + ", one for each of keys");
    return one("joint normal",
               built_at("covariance", [&] { return JointNormal(means, covariance); }));
  }

  void require_one_unit() const {
    if (std::any_of(numbers_.units.begin(), numbers_.units.end(),
                    [&](const std::string& unit) { return unit != numbers_.units[0]; }))
      refuse_at("keys", "expected keys whose numbers have one unit in this file");
  }

  VariedTable direction() const {
    const std::size_t n = numbers_.keys.size();
    const auto is_angle = [&](std::size_t i) {
      return value_at(at_.values, numbers_.places[i].path).key->dimension == Dimension::angle;
    };
    if (n == 2 && is_angle(0) && is_angle(1)) {
      if (!direction_angles(numbers_.keys))
        refuse_at(
            "keys",
            "expected a longitude, ra or node and a latitude, dec or inclination, whose names "
            "say which goes round and from where the other counts");
      require_one_unit();
      VariedTable made = one("direction, all alike", IsotropicDirection());
      made.varied.shape = EnsembleVaried::Shape::angles;
      made.varied.scale = at_.units.to_core(1.0, numbers_.units[0], Dimension::angle);
      return made;
    }
    if (n != 3)
      refuse_at("keys",
                "expected three components of a vector, or two angles: longitude and "
                "latitude, in either order; " +
                    count_text(n, "number"));
    require_one_unit();
    const auto& v = numbers_.values;
    VariedTable made = one("direction, all alike", IsotropicDirection());
    made.varied.shape = EnsembleVaried::Shape::vector;
    made.varied.scale = std::hypot(v[0], v[1], v[2]);
    if (!(made.varied.scale > 0.0))
      refuse_at("keys", "expected a vector whose length in the file is not 0");
    return made;
  }

  VariedTable attitude() const {
    if (numbers_.keys.size() != 4)
      refuse_at("keys", "expected the four components of a quaternion; " +
                            count_text(numbers_.keys.size(), "number"));
    return one("attitude, all alike", UniformAttitude());
  }

  VariedTable grid() const {
    const DrawAxis axis{number_at("from"), number_at("to"),
                        value_at(at_.values, key("count")).whole};
    static_cast<void>(built_at("count", [&] { return DrawGrid({axis}); }));
    return {{"grid, " + number_text(axis.from) + " to " + number_text(axis.to) + ", " +
                 std::to_string(axis.count) + " values",
             numbers_.keys, numbers_.units},
            {},
            axis};
  }

  VariedTable table() const {
    const std::size_t n = numbers_.keys.size();
    std::vector<std::string> columns;
    for (std::size_t i = 0; i < n; ++i) columns.push_back(std::to_string(i + 1));
    if (has_own("columns")) columns = value_at(at_.values, key("columns")).words;
    if (columns.size() != n)
      refuse_at("columns", "expected " + count_text(n, "column") + ", one for each of keys");
    const std::string& file = word(at_.values, key("file"));
    const RowOrder order =
        word(at_.values, key("order")) == "rows" ? RowOrder::in_order : RowOrder::with_replacement;
    return one("table " + file, built_at("file", [&] {
                 const std::filesystem::path path =
                     std::filesystem::path(at_.name).parent_path() / file;
                 const NumberTable read = read_number_table(path.string(), columns);
                 std::vector<double> rows;
                 rows.reserve(read.rows() * n);
                 for (std::size_t k = 0; k < read.rows(); ++k)
                   for (const std::vector<double>& column : read.columns) rows.push_back(column[k]);
                 return DrawTable(n, std::move(rows), order);
               }));
  }

  const FileValues& at_;
  std::string path_;
  const VariedNumbers& numbers_;
};

// "body.moments[1]"
std::string key_text(const Values& values, const NumberLocation& place) {
  const bool is_one = value_at(values, place.path).key->type == KeyType::number;
  return is_one ? place.path : place.path + "[" + std::to_string(place.index) + "]";
}

// Keys that are there and hold something else than a number, or are not the members' own.
void require_can_vary(const FileValues& at, const std::string& own, const std::string& key) {
  const auto found = at.values.find(key);
  if (key.starts_with("ensemble.") || key.starts_with("map.") || key == "schema")
    refuse(at.values, own, at.name,
           "expected a key that holds a number and belongs to the members: those of [ensemble] and "
           "[map], and schema, are of all of them together; " +
               key + " cannot vary");
  if (found == at.values.end() || found->second.key->type == KeyType::table ||
      is_number(found->second))
    return;
  refuse(at.values, own, at.name,
         "expected a key that holds a number which can be any; " + key +
             " cannot vary: make a file for each of its values");
}

}  // namespace

VariedNumbers varied_numbers(const FileValues& at, const std::string& path) {
  const Values& values = at.values;
  const bool several = has(values, path + ".keys");
  const std::string own = path + (several ? ".keys" : ".key");
  VariedNumbers all;
  for (const std::string& key : value_at(values, own).words) {
    require_can_vary(at, own, key);
    const std::vector<NumberLocation> places = number_locations(values, key);
    if (places.empty() || (!several && places.size() > 1)) {
      const std::vector<std::string> keys = number_keys(values, key);
      refuse(values, own, at.name,
             "expected " +
                 std::string(several ? "keys that hold numbers and stand"
                                     : "a key that "
                                       "holds a number and stands") +
                 " in this file or " + (several ? "have" : "has") +
                 " a fallback, such as "
                 "state.euler.theta or body.moments[1]" +
                 (several ? "; " + key + " is none" : "") +
                 did_you_mean(key, std::vector<std::string_view>(keys.begin(), keys.end())));
    }
    for (const NumberLocation& place : places) {
      const Value& value = value_at(values, place.path);
      if (place.path.starts_with("time."))
        refuse(values, own, at.name,
               "expected no key of [time]: all members have rows at the same times");
      const std::string& unit = value.units[place.index];
      all.keys.push_back(key_text(values, place));
      all.places.push_back(place);
      all.units.push_back(unit.empty() ? at.units.label(value.key->dimension) : unit);
      all.values.push_back(own_number(value, place.index, at.units));
    }
  }
  return all;
}

VariedTable varied_table(const FileValues& at, const std::string& path,
                         const VariedNumbers& numbers) {
  return Table(at, path, numbers).made();
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
