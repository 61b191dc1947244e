// SPDX-License-Identifier: MIT
// A run as a CCSDS Attitude Ephemeris Message (CCSDS 504.0-B, text form): version 1.0 (2008) or 2.0
// (2024), one segment, A inertial, B the body axes of the scenario. polhode/tables/aem.hpp reads
// them and says what their numbers mean. Dates are rounded to a nanosecond.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string_view>

#include "output/detail/attitude_interpolation.hpp"
#include "output/formats/formats.hpp"
#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/text/units.hpp"
#include "text/dates.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

enum class Form { quaternion, quaternion_rate, euler, spin };

// [output.aem]; an empty text is left to what the scenario says.
struct AemOptions {
  Form form = Form::quaternion;
  int version = 2;
  bool scalar_first = false;
  bool body_to_frame = false;  // ATTITUDE_DIR = B2A
  std::string object_name = {};
  std::string object_id = {};
  std::string originator = "POLHODE";
  std::string creation_date = {};
  std::string center = {};
  std::string frame_a = {};
  std::string frame_b = "SC_BODY_1";
};

constexpr KindKey<AemOptions> keys[] = {
    choice_key<&AemOptions::form, Form::quaternion, Form::quaternion_rate, Form::euler, Form::spin>(
        "form", "quaternion|quaternion-rate|euler|spin",
        "QUATERNION; with the angular velocity (QUATERNION/ANGVEL of version 2, needs "
        "the columns omega); EULER_ANGLE, the angles 3-1-3; or SPIN of body axis 3 (needs "
        "omega).")
        .otherwise("\"quaternion\""),
    integer_key<&AemOptions::version>(
        "version", "CCSDS_AEM_VERS: 2, of 2024, or 1, of 2008, which older programs read.")
        .one_of("1|2")
        .otherwise("2"),
    choice_key<&AemOptions::scalar_first, false, true>(
        "quaternion_type", "LAST|FIRST",
        "Where the scalar of a quaternion stands; version 2 has LAST alone.")
        .otherwise("\"LAST\""),
    choice_key<&AemOptions::body_to_frame, false, true>(
        "direction", "A2B|B2A",
        "ATTITUDE_DIR; B2A is the inverse rotation, of form quaternion and version 1 alone.")
        .otherwise("\"A2B\""),
    text_key<&AemOptions::object_name>(
        "object_name", "OBJECT_NAME; left out, the title, or else the name of the file.")
        .example("\"ENVISAT\""),
    text_key<&AemOptions::object_id>("object_id", "OBJECT_ID; left out, UNKNOWN.")
        .example("\"2002-009A\""),
    text_key<&AemOptions::originator>("originator", "ORIGINATOR.").otherwise("\"POLHODE\""),
    text_key<&AemOptions::creation_date>(
        "creation_date",
        "CREATION_DATE. Left out, 1970-01-01T00:00:00 with a comment: equal runs give equal "
        "files.")
        .example("\"2026-01-31T12:00:00\""),
    text_key<&AemOptions::center>("center", "CENTER_NAME; left out, none is written.")
        .example("\"EARTH\""),
    text_key<&AemOptions::frame_a>(
        "frame_a",
        "REF_FRAME_A, a name for state.axes. Left out, EME2000 (ecliptic-J2000 is turned "
        "into it), or INERTIAL.")
        .example("\"EME2000\""),
    text_key<&AemOptions::frame_b>("frame_b", "REF_FRAME_B, a name for the body axes.")
        .otherwise("\"SC_BODY_1\""),
};

constexpr std::size_t longest_line = 250;  // the standard allows 254 characters

bool is_ascii_word(const std::string& text) {
  return !text.empty() && text.size() <= longest_line / 2 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

void check_options(const AemOptions& options, const KeyValues& at) {
  for (const char* const key :
       {"object_name", "object_id", "originator", "creation_date", "center", "frame_a", "frame_b"})
    if (at.has(key) && !is_ascii_word(at.word(key)))
      at.refuse(key, "expected 1 to 125 printable ASCII characters");
  if (!options.creation_date.empty() && !civil_time(options.creation_date, true))
    at.refuse("creation_date", "expected a date such as 2026-01-31T12:00:00");
  if (options.form == Form::quaternion_rate && options.version == 1)
    at.refuse("version",
              "expected 2 with form quaternion-rate: programs take the rates of QUATERNION/RATE, "
              "of version 1, for different things");
  if (options.scalar_first && options.version == 2)
    at.refuse("quaternion_type", "expected \"LAST\" in version 2");
  if (options.body_to_frame && (options.version == 2 || options.form != Form::quaternion))
    at.refuse("direction", "expected \"A2B\": B2A is of form quaternion and version 1 alone");
}

bool needs_rates(const AemOptions& options) {
  return options.form == Form::quaternion_rate || options.form == Form::spin;
}

// The standard allows 254 characters in a line.
constexpr CommentStyle comments{"COMMENT ", 230, true, "META_START"};

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr std::string_view no_date = "1970-01-01T00:00:00";

std::string type_of(const AemOptions& options) {
  switch (options.form) {
    case Form::quaternion:
      return "QUATERNION";
    case Form::quaternion_rate:
      return "QUATERNION/ANGVEL";
    case Form::euler:
      return "EULER_ANGLE";
    case Form::spin:
      return "SPIN";
  }
  return {};
}

const Interpolation& interpolation_of(const AemOptions& options) {
  if (options.form == Form::quaternion) return lagrange_quaternions;
  return options.form == Form::quaternion_rate ? hermite_quaternions : linear_angles;
}

double turn_below(double angle) {
  const double inside = angle - 360.0 * std::floor(angle / 360.0);
  return inside < 360.0 ? inside : 0.0;
}

std::string_view attitude_columns(const RunFacts& run) {
  return run.moving_frame ? "q_inertial" : "q";
}

// The first column of a group that is there, in a row.
std::size_t place_of(const std::vector<ColumnGroup>& groups, std::string_view name) {
  std::size_t place = 0;
  for (const ColumnGroup& group : groups) {
    if (group.name == name) break;
    place += group.columns.size();
  }
  return place;
}

class AemSink : public Sink {
 public:
  explicit AemSink(const SinkRequest& request);
  void push(std::span<const double> rows) override;
  std::optional<SinkPosition> position() override;
  void finish() override;
  std::vector<std::string> warnings() const override;

 private:
  void choose_columns(const std::vector<ColumnGroup>& groups);
  CivilTime time_of(double t) const;
  std::string head(const Provenance& provenance);
  std::string meta();
  double rate_of(const double* row) const;
  void append_row(const double* row);
  void append(double number);

  RunFacts run_;
  AemOptions options_;
  std::string scale_;
  CivilTime epoch_;
  Quaternion q_AI_{};  // of the axes of the file, seen from frame A
  std::size_t width_ = 0;
  std::size_t q_ = 0;
  std::optional<std::size_t> w_;
  double rate_ = 1.0;  // deg/s in the unit of the column
  std::string text_;
  std::int64_t stop_place_ = 0;
  std::int64_t degree_place_ = 0;
  std::string stop_;
  std::optional<CivilTime> latest_;
  std::optional<PartFile> file_;
  std::int64_t rows_ = 0;
  InterpolationError error_;
};

AemSink::AemSink(const SinkRequest& request)
    : run_(request.provenance.run),
      options_(request.options<AemOptions>()),
      scale_(scale_of_epoch(run_.epoch)),
      error_(interpolation_of(options_)) {
  choose_columns(request.groups);
  if (run_.axes == "ecliptic-J2000" && (options_.frame_a.empty() || options_.frame_a == "EME2000"))
    q_AI_ = rotation_x(obliquity_J2000);
  std::string text;
  try {
    epoch_ = time_of_epoch(run_.epoch);
    stop_ = civil_text(time_of(run_.last));
    text = head(request.provenance);
    const auto place_of_value = [&](std::string_view key) {
      return static_cast<std::int64_t>(text.rfind(key) + key.size());
    };
    stop_place_ = place_of_value("\nSTOP_TIME = ");
    degree_place_ = place_of_value("\nINTERPOLATION_DEGREE = ");
  } catch (const DomainError& error) {
    throw DomainError(printable(request.path, request.path.size()) + ": " + error.what());
  }
  if (!request.from) {
    file_.emplace(request.path);
    file_->write(text);
    return;
  }
  // the date behind it may be that of a run that had ended
  const std::string before_stop = text.substr(0, static_cast<std::size_t>(stop_place_));
  file_.emplace(request.path, std::optional(PartState{request.from->bytes, before_stop}));
  file_->overwrite(stop_place_, stop_);
  rows_ = request.from->rows;
}

void AemSink::choose_columns(const std::vector<ColumnGroup>& groups) {
  for (const ColumnGroup& group : groups) width_ += group.columns.size();
  q_ = place_of(groups, attitude_columns(run_));
  for (const ColumnGroup& group : groups)
    if (group.name == "omega") {
      w_ = place_of(groups, "omega");
      rate_ = degrees * Units("s").to_core(1.0, group.columns.front().unit, Dimension::rate);
    }
}

// In radians per unit of time; without the columns omega, that of the initial state.
double AemSink::rate_of(const double* row) const {
  if (!w_) return run_.rate;
  const double* const w = row + *w_;
  return rate_ / degrees * run_.seconds * std::hypot(w[0], w[1], w[2]);
}

CivilTime AemSink::time_of(double t) const {
  const CivilTime time = after(scale_, epoch_, t * run_.seconds);
  if (!has_text(time)) throw DomainError("a date outside the years 0 to 9999");
  return time;
}

std::string AemSink::head(const Provenance& provenance) {
  std::string out = "CCSDS_AEM_VERS = " + std::string(options_.version == 1 ? "1.0" : "2.0") + "\n";
  append_origin(out, comments, provenance);
  const bool dated = !options_.creation_date.empty();
  if (!dated)
    append_comment(out, comments, "",
                   "CREATION_DATE is not when this was made: equal runs give equal files");
  out += "CREATION_DATE = " + (dated ? options_.creation_date : std::string(no_date)) + "\n";
  out += "ORIGINATOR = " + options_.originator + "\n\nMETA_START\n";
  return out + meta() + "META_STOP\n\nDATA_START\n";
}

std::string AemSink::meta() {
  const bool first = options_.version == 1;
  const bool inertial = run_.axes == "inertial";
  const std::string frame_a =
      options_.frame_a.empty() ? (inertial ? "INERTIAL" : "EME2000") : options_.frame_a;
  std::string out;
  append_comment(out, comments, "",
                 "REF_FRAME_B: the body axes of the scenario; REF_FRAME_A: its axes " + run_.axes +
                     (q_AI_ == Quaternion{} ? "" : ", turned into EME2000"));
  if (options_.form == Form::euler)
    append_comment(out, comments, "",
                   "the angles stand in the order of their rotations, about axes 3, 1, 3");
  if (options_.form == Form::spin)
    append_comment(out, comments, "",
                   "the spin axis is body axis 3; SPIN_ANGLE_VEL is the angular velocity along it");
  out += "OBJECT_NAME = " +
         printable(options_.object_name.empty() ? run_.name : options_.object_name, 125) + "\n";
  out += "OBJECT_ID = " + (options_.object_id.empty() ? "UNKNOWN" : options_.object_id) + "\n";
  if (!options_.center.empty()) out += "CENTER_NAME = " + options_.center + "\n";
  out += "REF_FRAME_A = " + frame_a + "\nREF_FRAME_B = " + options_.frame_b + "\n";
  if (first) out += "ATTITUDE_DIR = " + std::string(options_.body_to_frame ? "B2A" : "A2B") + "\n";
  out += "TIME_SYSTEM = " + scale_ + "\n";
  out += "START_TIME = " + civil_text(time_of(run_.first)) + "\n";
  out += "STOP_TIME = " + stop_ + "\n";
  out += "ATTITUDE_TYPE = " + type_of(options_) + "\n";
  const bool quaternion =
      options_.form == Form::quaternion || options_.form == Form::quaternion_rate;
  if (quaternion && first)
    out += "QUATERNION_TYPE = " + std::string(options_.scalar_first ? "FIRST" : "LAST") + "\n";
  if (options_.form == Form::euler)
    out += "EULER_ROT_SEQ = " + std::string(first ? "313" : "ZXZ") + "\n";
  if (options_.form == Form::quaternion_rate) out += "ANGVEL_FRAME = " + options_.frame_b + "\n";
  const Interpolation& way = interpolation_of(options_);
  return out + "INTERPOLATION_METHOD = " + std::string(way.method) +
         "\nINTERPOLATION_DEGREE = " + std::to_string(way.degree) + "\n";
}

void AemSink::append(double number) {
  char text[longest_number + 1] = {' '};
  text_.append(text, write_number(text + 1, number));
}

void AemSink::append_row(const double* row) {
  const CivilTime time = time_of(row[0]);
  if (latest_ && !(time > *latest_))
    throw OutputError("two rows of an AEM less than a nanosecond apart, at " + civil_text(time));
  latest_ = time;
  text_ += civil_text(time);
  const double* const c = row + q_;
  const Quaternion q_AB = q_AI_ * Quaternion{c[0], c[1], c[2], c[3]};
  const double* const w = row + w_.value_or(0);
  const double rate = rate_of(row);
  if (options_.form == Form::euler || options_.form == Form::spin) {
    const EulerAngles e = euler_angles(q_AB);
    const double phi = turn_below(degrees * e.phi), theta = degrees * e.theta;
    if (options_.form == Form::euler) {
      append(phi);
      append(theta);
      append(turn_below(degrees * e.psi));
    } else {
      append(turn_below(phi - 90.0));
      append(90.0 - theta);
      append(turn_below(degrees * e.psi));
      append(rate_ * w[2]);
    }
    error_.add({row[0], {phi, theta, degrees * e.psi, 0.0}, {}, q_AB, rate});
  } else {
    const Quaternion q = options_.body_to_frame ? conj(q_AB) : q_AB;
    if (options_.scalar_first) append(q.w);
    for (const double part : {q.x, q.y, q.z}) append(part);
    if (!options_.scalar_first) append(q.w);
    if (options_.form == Form::quaternion_rate)
      for (int i = 0; i < 3; ++i) append(rate_ * w[i]);
    InterpolationError::Row known{row[0], {q_AB.w, q_AB.x, q_AB.y, q_AB.z}, {}, q_AB, rate};
    if (options_.form == Form::quaternion_rate) {
      const double half = 0.5 * rate_ / degrees * run_.seconds;  // in radians per unit of time
      const Quaternion dot = q_AB * Quaternion{0.0, half * w[0], half * w[1], half * w[2]};
      known.slope = {dot.w, dot.x, dot.y, dot.z};
    }
    error_.add(known);
  }
  text_ += '\n';
}

void AemSink::push(std::span<const double> rows) {
  text_.clear();
  for (std::size_t i = 0; i < rows.size(); i += width_) append_row(rows.data() + i);
  file_->write(text_);
  rows_ += static_cast<std::int64_t>(rows.size() / width_);
}

std::optional<SinkPosition> AemSink::position() {
  const std::optional<std::int64_t> bytes = file_->synced_bytes();
  return bytes ? std::optional(SinkPosition{*bytes, rows_}) : std::nullopt;
}

// A run that an event has stopped ends before the STOP_TIME that it set out for, and its rows may
// be too few for the degree.
void AemSink::finish() {
  file_->overwrite(degree_place_, std::to_string(interpolation_of(options_).degree_of(rows_)));
  if (latest_ && civil_text(*latest_) != stop_) file_->overwrite(stop_place_, civil_text(*latest_));
  file_->write("DATA_STOP\n");
  file_->commit();
}

std::string two_digits(double x) {
  std::array<char, 32> text{};
  const int length = std::snprintf(text.data(), text.size(), "%.2g", x);
  return {text.data(), static_cast<std::size_t>(length)};
}

std::vector<std::string> AemSink::warnings() const {
  const double error = error_.estimate(rows_);
  if (!(error > interpolation_limit)) return {};
  const Interpolation& way = interpolation_of(options_);
  return {"between rows a reader that interpolates as INTERPOLATION_METHOD = " +
          std::string(way.method) + " says is off by about " + two_digits(degrees * error) +
          " deg; expected a shorter [time] step"};
}

}  // namespace

OutputFormat aem_format() {
  OutputFormat format(
      "aem", ".aem",
      "What a CCSDS Attitude Ephemeris Message, --out PATH.aem, says and how. It needs state.epoch "
      "and the columns q (q_inertial where the frame moves).",
      [](const SinkRequest& request) { return std::make_unique<AemSink>(request); });
  format.label = "an AEM";
  format.needs = {.file = true, .dates = true, .rising = true};
  format.columns = [](const SinkRequest& request) {
    std::vector<std::string> groups{std::string(attitude_columns(request.provenance.run))};
    if (needs_rates(request.options<AemOptions>())) groups.emplace_back("omega");
    return groups;
  };
  format.take_options<AemOptions>(keys, check_options);
  format.difference = [](const std::string& path, const std::vector<ColumnGroup>&,
                         const Provenance& provenance) {
    std::string head;
    append_origin(head, comments, provenance);
    return text_difference(path, comments, head);
  };
  format.citations = {
      {"ccsds504",
       "Consultative Committee for Space Data Systems (2024). Attitude Data Messages. Recommended "
       "Standard CCSDS 504.0-B-2.",
       "files of attitudes"}};
  return format;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
