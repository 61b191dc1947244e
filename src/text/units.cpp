// SPDX-License-Identifier: MIT
// Units and dimensions, and numbers with their units as text.
#include "polhode/text/units.hpp"

#include <udunits2.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "polhode/error.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

namespace {

constexpr std::size_t longest_unit = 64;

constexpr KnownUnit units_table[] = {
    {"s", "second", 1.0, ""},
    {"min", "minute", 60.0, "s"},
    {"h", "hour", 60.0, "min"},
    {"d", "day", 24.0, "h"},
    {"yr", "Julian year", 365.25, "d"},
    {"kyr", "thousand years", 1e3, "yr"},
    {"Myr", "million years", 1e6, "yr"},
    {"Gyr", "billion years", 1e9, "yr"},
    {"ka", "thousand years", 1e3, "yr"},
    {"Ma", "million years", 1e6, "yr"},
    {"cy", "century", 100.0, "yr"},
    {"rad", "radian", 1.0, ""},
    {"deg", "degree", std::numbers::pi / 180.0, "rad"},
    {"arcmin", "arcminute", std::numbers::pi / 10800.0, "rad"},
    {"arcsec", "arcsecond", std::numbers::pi / 648e3, "rad"},
    {"mas", "milliarcsecond", std::numbers::pi / 648e6, "rad"},
    {"uas", "microarcsecond", std::numbers::pi / 648e9, "rad"},
    {"rev", "revolution", 2.0 * std::numbers::pi, "rad"},
    {"cycles", "revolutions", 2.0 * std::numbers::pi, "rad"},
    {"rpm", "revolution per minute", 1.0, "rev/min"},
    {"m", "metre", 1.0, ""},
    {"cm", "centimetre", 0.01, "m"},
    {"mm", "millimetre", 0.001, "m"},
    {"km", "kilometre", 1e3, "m"},
    {"au", "astronomical unit", 149597870700.0, "m"},
    {"R_e", "Earth radius", 6378136.6, "m"},
    {"kg", "kilogram", 1.0, ""},
    {"g", "gram", 0.001, "kg"},
    {"N", "newton", 1.0, "kg m/s2"},
    {"Pa", "pascal", 1.0, "N/m2"},
    {"GPa", "gigapascal", 1e9, "Pa"},
    {"J", "joule", 1.0, "N m"},
    {"W", "watt", 1.0, "J/s"},
    {"A", "ampere", 1.0, ""},
    {"T", "tesla", 1.0, "kg/(A s2)"},
    {"uT", "microtesla", 1e-6, "T"},
    {"nT", "nanotesla", 1e-9, "T"},
    {"S", "siemens", 1.0, "A2 s3/(kg m2)"},
};

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using UnitPointer = std::unique_ptr<ut_unit, FreeUnit>;

// UDUNITS is not for several threads: one at a time, all the way to where a unit is freed.
std::recursive_mutex& one_at_a_time() {
  static std::recursive_mutex mutex;
  return mutex;
}
using Alone = std::lock_guard<std::recursive_mutex>;

// UDUNITS prints its errors unless it is set otherwise; the caller's choice is put back.
class QuietScope {
 public:
  QuietScope() : before_(ut_set_error_message_handler(ut_ignore)) {}
  ~QuietScope() { ut_set_error_message_handler(before_); }
  QuietScope(const QuietScope&) = delete;
  QuietScope& operator=(const QuietScope&) = delete;

 private:
  ut_error_message_handler before_;
};

// The closed system: exactly the units of the table.
class UnitSystem {
 public:
  UnitSystem() : system_(ut_new_system()) {
    const QuietScope quiet;
    for (const KnownUnit& known : units_table) {
      const std::string symbol(known.symbol);
      const UnitPointer base(known.base.empty() ? ut_new_base_unit(system_)
                                                : parse(std::string(known.base)));
      const UnitPointer unit(ut_scale(known.factor, base.get()));
      if (!unit || ut_map_symbol_to_unit(symbol.c_str(), UT_ASCII, unit.get()) != UT_SUCCESS)
        throw std::logic_error("units: cannot register " + symbol);
    }
  }
  ~UnitSystem() { ut_free_system(system_); }
  UnitSystem(const UnitSystem&) = delete;
  UnitSystem& operator=(const UnitSystem&) = delete;

  ut_unit* parse(const std::string& text) const {
    return ut_parse(system_, text.c_str(), UT_ASCII);
  }

 private:
  ut_system* system_;
};

const UnitSystem& unit_system() {
  static const UnitSystem system;
  return system;
}

bool is_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string lower(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

struct Prefix {
  std::string_view letter;
  std::string_view name;
};
constexpr Prefix prefixes[] = {{"p", "pico"},  {"n", "nano"}, {"u", "micro"}, {"m", "milli"},
                               {"c", "centi"}, {"d", "deci"}, {"h", "hecto"}, {"k", "kilo"},
                               {"K", "kilo"},  {"M", "mega"}, {"G", "giga"},  {"T", "tera"}};
constexpr int one_letter = 2;  // between two words, as edit_distance counts

const KnownUnit* unit_of_symbol(std::string_view symbol) {
  for (const KnownUnit& unit : units_table)
    if (unit.symbol == symbol) return &unit;
  return nullptr;
}

bool is_called(const KnownUnit& unit, const std::string& word, int slip) {
  return lower(unit.symbol) == word || detail::edit_distance(unit.name, word) <= slip;
}

// "um", "micrometre": a multiple that is not in the table is no slip of one that is: no symbol.
// "nTesla", "centimeter" are ways to write one that is.
struct Multiple {
  bool is_one = false;
  std::string symbol;
};
Multiple multiple(std::string_view text) {
  const std::string word = lower(text);
  for (const Prefix& prefix : prefixes) {
    if (!word.starts_with(prefix.name)) continue;
    for (const KnownUnit& unit : units_table)
      if (unit.name.starts_with(prefix.name) && is_called(unit, word, one_letter))
        return {true, std::string(unit.symbol)};
    for (const KnownUnit& unit : units_table)
      if (is_called(unit, word.substr(prefix.name.size()), one_letter)) return {true, {}};
  }
  for (const Prefix& prefix : prefixes)
    for (const KnownUnit& unit : units_table) {
      if (!text.starts_with(prefix.letter) || !is_called(unit, word.substr(1), 0)) continue;
      const std::string symbol =
          std::string(prefix.letter == "K" ? "k" : prefix.letter) + std::string(unit.symbol);
      return {true, unit_of_symbol(symbol) != nullptr ? symbol : ""};
    }
  return {};
}

// "Nm" as "N m".
std::string product(std::string_view word) {
  for (const KnownUnit& left : units_table)
    for (const KnownUnit& right : units_table)
      if (word.size() == left.symbol.size() + right.symbol.size() &&
          word.starts_with(left.symbol) && word.ends_with(right.symbol))
        return std::string(left.symbol) + " " + std::string(right.symbol);
  return {};
}

std::string nearest_unit(std::string_view word) {
  if (const Multiple found = multiple(word); found.is_one) return found.symbol;
  if (std::string found = product(word); !found.empty()) return found;
  std::vector<std::string_view> words;
  for (const KnownUnit& unit : units_table) {
    words.push_back(unit.symbol);
    words.push_back(unit.name);
  }
  std::string_view best = detail::nearest(word, words);
  if (best.empty() && word.size() > 1 && word.back() == 's')  // hours, degrees
    best = detail::nearest(word.substr(0, word.size() - 1), words);
  for (const KnownUnit& unit : units_table)
    if (best == unit.symbol || best == unit.name) return std::string(unit.symbol);
  return {};
}

void require_known(std::string_view word) {
  if (unit_of_symbol(word) != nullptr) return;
  std::string message = "unknown unit \"" + std::string(word) + "\"";
  const std::string near = nearest_unit(word);
  message += near.empty() ? "; expected s, min, h, d, yr, rad, deg, kg, m, ... or their products"
                          : "; did you mean " + near + "?";
  throw DomainError(message);
}

// Only words of the table, whole exponents and the 1 of "1/h" get as far as the UDUNITS parser, so
// that its offsets ("since"), logarithms and stray factors cannot.
void require_plain(std::string_view text) {
  if (text.size() > longest_unit) throw DomainError("a unit of more than 64 characters");
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    if (is_word(text[i])) {
      while (end < text.size() && is_word(text[end])) ++end;
      require_known(text.substr(i, end - i));
    } else if (is_digit(text[i])) {
      while (end < text.size() && is_digit(text[end])) ++end;
      const char before = i == 0 ? ' ' : text[i - 1];
      const bool exponent = is_word(before) || before == '^' || before == '-' || before == '*';
      if (!exponent && text.substr(i, end - i) != "1")
        throw DomainError("a number inside the unit \"" + std::string(text) + "\"");
    } else if (std::string_view(" *^/.-()").find(text[i]) == std::string_view::npos) {
      throw DomainError("a unit with characters that no unit has");
    }
    i = end;
  }
}

UnitPointer parsed_unit(std::string_view text) {
  require_plain(text);
  const QuietScope quiet;
  UnitPointer unit(unit_system().parse(std::string(text)));
  if (!unit) throw DomainError("\"" + std::string(text) + "\" is not a unit");
  return unit;
}

// value of `from` in `to`, or NaN when the dimensions differ. UDUNITS also converts between
// reciprocals and across offsets: a map that is not a plain factor is refused.
double converted(double value, const ut_unit* from, const ut_unit* to) {
  const QuietScope quiet;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  if (!ut_are_convertible(from, to)) return unknown;
  using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;
  const Converter forward(ut_get_converter(const_cast<ut_unit*>(from), const_cast<ut_unit*>(to)),
                          &cv_free);
  const Converter backward(ut_get_converter(const_cast<ut_unit*>(to), const_cast<ut_unit*>(from)),
                           &cv_free);
  if (!forward || !backward) return unknown;
  const double factor = cv_convert_double(forward.get(), 1.0);
  const double inverse = cv_convert_double(backward.get(), 1.0);
  const bool linear = cv_convert_double(forward.get(), 0.0) == 0.0 &&
                      cv_convert_double(forward.get(), 2.0) == 2.0 * factor;
  if (!linear || !(factor > 0.0) || !std::isfinite(factor)) return unknown;
  // the same unit, up to the rounding of its factors: no two units of the table are so near
  if (std::fabs(factor - 1.0) <= 8.0 * std::numeric_limits<double>::epsilon()) return value;
  if (inverse > 1.0 && inverse == std::floor(inverse)) return value / inverse;  // 30 min: 30/60 h
  return value * factor;
}

// What a dimension is made of: powers of the core units of moment, length, time and current. The
// radians may stand in a unit of it, or not.
struct DimensionSpec {
  Dimension dimension;
  std::string_view name;
  int moment = 0;
  int length = 0;
  int time = 0;
  int current = 0;
  int radians = 0;
};

constexpr DimensionSpec dimensions_table[] = {
    {Dimension::number, "a pure number"},
    {.dimension = Dimension::time, .name = "a time", .time = 1},
    {.dimension = Dimension::angle, .name = "an angle", .radians = 1},
    {.dimension = Dimension::rate, .name = "an angular rate", .time = -1, .radians = 1},
    {.dimension = Dimension::moment, .name = "a moment of inertia", .moment = 1},
    {.dimension = Dimension::momentum,
     .name = "an angular momentum",
     .moment = 1,
     .time = -1,
     .radians = 1},
    {.dimension = Dimension::energy, .name = "an energy", .moment = 1, .time = -2, .radians = 2},
    {.dimension = Dimension::length, .name = "a length", .length = 1},
    {.dimension = Dimension::gm, .name = "a gravitational parameter", .length = 3, .time = -2},
    {.dimension = Dimension::torque, .name = "a torque", .moment = 1, .time = -2, .radians = 2},
    {.dimension = Dimension::damping,
     .name = "a damping coefficient",
     .moment = 1,
     .time = -1,
     .radians = -1},
    {.dimension = Dimension::mass, .name = "a mass", .moment = 1, .length = -2},
    {.dimension = Dimension::area, .name = "an area", .length = 2},
    {.dimension = Dimension::speed, .name = "a speed", .length = 1, .time = -1},
    {.dimension = Dimension::density, .name = "a density", .moment = 1, .length = -5},
    {.dimension = Dimension::pressure, .name = "a pressure", .moment = 1, .length = -3, .time = -2},
    {.dimension = Dimension::magnetic_field,
     .name = "a magnetic field",
     .moment = 1,
     .length = -2,
     .time = -2,
     .current = -1},
    {.dimension = Dimension::magnetic_moment,
     .name = "a magnetic moment",
     .length = 2,
     .current = 1},
    {.dimension = Dimension::magnetic_tensor,
     .name = "a magnetic tensor",
     .moment = -1,
     .length = 4,
     .time = 3,
     .current = 2},
    {.dimension = Dimension::moment3,
     .name = "a third-degree moment of mass",
     .moment = 1,
     .length = 1},
    {.dimension = Dimension::moment4,
     .name = "a fourth-degree moment of mass",
     .moment = 1,
     .length = 2},
    {.dimension = Dimension::root_momentum,  // of what stands under the root
     .name = "a root of an angular momentum",
     .moment = 1,
     .time = -1,
     .radians = 1},
    {.dimension = Dimension::growth, .name = "a rate of change", .time = -1},
};

const DimensionSpec& spec_of(Dimension dimension) {
  for (const DimensionSpec& spec : dimensions_table)
    if (spec.dimension == dimension) return spec;
  throw std::logic_error("units: a dimension without a row");
}

// What products of kg, m, s and A are usually called.
struct SiName {
  Dimension dimension;
  std::string_view unit;
};
constexpr SiName si_names[] = {{Dimension::mass, "kg"},
                               {Dimension::density, "kg/m3"},
                               {Dimension::pressure, "N/m2"},
                               {Dimension::magnetic_field, "T"},
                               {Dimension::magnetic_tensor, "S m4"}};

// The core unit of a dimension, as text; `radians` says whether rad stands in it where it may.
std::string core_unit(const Units& units, Dimension dimension, bool radians) {
  if (dimension == Dimension::angle) return "rad";
  const DimensionSpec& spec = spec_of(dimension);
  std::string text;
  const auto add = [&text](const std::string& unit, int power) {
    if (power != 0) text += (text.empty() ? "(" : " (") + unit + ")^" + std::to_string(power);
  };
  add(units.moment(), spec.moment);
  add(units.length(), spec.length);
  add(units.time(), spec.time);
  add("A", spec.current);
  if (radians || dimension == Dimension::rate) add("rad", spec.radians);
  return text.empty() ? "1" : text;
}

// "kg m2/s2": what stands above the line, then what stands below.
std::string label_of(const Units& units, const DimensionSpec& spec) {
  std::string above, below;
  const auto add = [&](const std::string& unit, int power) {
    if (power == 0 || unit == "1") return;
    const bool composed = unit.find_first_of("/ ") != std::string::npos;
    const int size = std::abs(power);
    const bool wrapped = unit.find('/') != std::string::npos || (composed && size > 1);
    std::string& side = power > 0 ? above : below;
    side += (side.empty() ? "" : " ") + (wrapped ? "(" + unit + ")" : unit) +
            (size == 1 ? "" : (wrapped ? "^" : "") + std::to_string(size));
  };
  add(units.moment(), spec.moment);
  add("A", spec.current);
  add(units.length(), spec.length);
  add(units.time(), spec.time);
  if (below.empty()) return above.empty() ? "1" : above;
  const bool several = below.find(' ') != std::string::npos;
  return (above.empty() ? "1" : above) + "/" + (several ? "(" + below + ")" : below);
}

// "; set units.moment = ..." where that is what keeps a unit from being one of this dimension.
std::string missing_units(const Units& units, std::string_view unit, Dimension dimension) {
  const bool moment = units.moment() == "1", length = units.length() == "1";
  if (!moment && !length) return {};
  const Units physical(units.time(), units.angle(), moment ? "kg m2" : units.moment(),
                       length ? "m" : units.length());
  try {
    physical.to_core(1.0, unit, dimension);
  } catch (const DomainError&) {
    return {};
  }
  const DimensionSpec& spec = spec_of(dimension);
  std::string text;
  if (moment && spec.moment != 0) text = "units.moment = \"kg m2\"";
  if (length && spec.length != 0)
    text += std::string(text.empty() ? "" : " and ") + "units.length = \"m\"";
  return text.empty() ? text : "; set " + text;
}

constexpr std::string_view root_of = "sqrt(";

// "kg m2/s" of "sqrt(kg m2/s)"; empty of what is no root.
std::string_view under_root(std::string_view unit) {
  const bool wrapped = unit.starts_with(root_of) && unit.ends_with(')');
  return wrapped ? unit.substr(root_of.size(), unit.size() - root_of.size() - 1) : "";
}

void require_name(std::string_view what, std::string_view unit, std::string_view like) {
  parsed_unit(unit);
  for (const char c : unit)
    if (!is_word(c))
      throw DomainError(std::string(what) + ": \"" + std::string(unit) +
                        "\" is not a single unit such as " + std::string(like));
}

}  // namespace

std::span<const KnownUnit> known_units() { return units_table; }

std::string_view dimension_name(Dimension dimension) { return spec_of(dimension).name; }

Units::Units(std::string_view time, std::string_view angle, std::string_view moment,
             std::string_view length)
    : time_(time), angle_(angle), moment_(moment), length_(length) {
  const Alone alone(one_at_a_time());
  require_name("time", time, "s, h or d");
  require_name("angle", angle, "rad or deg");
  const UnitPointer second = parsed_unit("s"), radian = parsed_unit("rad");
  if (std::isnan(converted(1.0, parsed_unit(time).get(), second.get())))
    throw DomainError("time: \"" + time_ + "\" is not a unit of time");
  const UnitPointer angle_unit = parsed_unit(angle);
  angle_in_rad_ = converted(1.0, angle_unit.get(), radian.get());
  if (std::isnan(angle_in_rad_))
    throw DomainError("angle: \"" + angle_ + "\" is not a unit of angle");
  rad_in_angle_ = converted(1.0, radian.get(), angle_unit.get());
  const UnitPointer moment_unit = parsed_unit(moment);
  const UnitPointer scale_free = parsed_unit("1"), physical = parsed_unit("kg m2");
  if (std::isnan(converted(1.0, moment_unit.get(), scale_free.get())) &&
      std::isnan(converted(1.0, moment_unit.get(), physical.get())))
    throw DomainError("moment: \"" + moment_ + "\" is not 1 (scale-free) or a unit like kg m2");
  if (length_ == "1") return;
  require_name("length", length, "km, m or au");
  const UnitPointer length_unit = parsed_unit(length);
  if (std::isnan(converted(1.0, length_unit.get(), parsed_unit("m").get())))
    throw DomainError("length: \"" + length_ + "\" is not 1 (scale-free) or a unit like km");
}

double Units::to_core(double value, Dimension dimension) const {
  const bool turns = dimension == Dimension::angle || dimension == Dimension::rate;
  return turns ? value * angle_in_rad_ : value;
}

double Units::to_core(double value, std::string_view unit, Dimension dimension) const {
  const Alone alone(one_at_a_time());
  const bool is_root = dimension == Dimension::root_momentum;
  const std::string_view inside = is_root ? under_root(unit) : unit;
  const bool none = is_root && inside.empty();
  const UnitPointer own = parsed_unit(none ? unit : inside);
  if (!std::isfinite(value)) throw DomainError("numbers must be finite");
  for (const bool radians : {false, true}) {
    if (none) break;
    const double result = converted(is_root ? 1.0 : value, own.get(),
                                    parsed_unit(core_unit(*this, dimension, radians)).get());
    if (!std::isnan(result)) return is_root ? value * std::sqrt(result) : result;
  }
  std::string expected = "\"" + std::string(unit) + "\" is not a unit of ";
  expected +=
      std::string(dimension_name(dimension).substr(dimension_name(dimension).find(' ') + 1));
  throw DomainError(expected + " here; expected one like " + label(dimension) +
                    missing_units(*this, unit, dimension));
}

double Units::from_core(double value, Dimension dimension) const {
  const bool turns = dimension == Dimension::angle || dimension == Dimension::rate;
  return turns ? value * rad_in_angle_ : value;
}

std::string Units::label(Dimension dimension) const {
  if (dimension == Dimension::angle) return angle_;
  if (dimension == Dimension::rate) return angle_ + "/" + time_;
  if (dimension == Dimension::root_momentum)
    return std::string(root_of) + label(Dimension::momentum) + ")";
  if (moment_ == "kg m2" && length_ == "m" && time_ == "s")
    for (const SiName& si : si_names)
      if (si.dimension == dimension) return std::string(si.unit);
  return label_of(*this, spec_of(dimension));
}

Quantity quantity_from_text(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  std::string_view number = text;
  if (number.starts_with('+') && !number.starts_with("+-")) number.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error == std::errc::result_out_of_range) throw DomainError("a number beyond double range");
  if (error != std::errc() || !std::isfinite(value))
    throw DomainError("no number at the start of the text");
  std::string_view unit(end, static_cast<std::size_t>(number.data() + number.size() - end));
  while (!unit.empty() && blank(unit.front())) unit.remove_prefix(1);
  if (unit.empty()) throw DomainError("a number without its unit; a bare number needs no quotes");
  return {value, std::string(unit)};
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
