// SPDX-License-Identifier: MIT
// A run as a CCSDS Attitude Ephemeris Message.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "output/comments.hpp"
#include "output/part_file.hpp"
#include "output/sinks.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/turned_kepler_orbit.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/text/units.hpp"
#include "text/civil_time.hpp"
#include "text/number_text.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using Form = AemOptions::Form;

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr std::string_view no_date = "1970-01-01T00:00:00";

std::string type_of(const AemOptions& options) {
  switch (options.form) {
    case Form::quaternion:
      return "QUATERNION";
    case Form::quaternion_rate:
      return options.version == 1 ? "QUATERNION/RATE" : "QUATERNION/ANGVEL";
    case Form::euler:
      return "EULER_ANGLE";
    case Form::spin:
      return "SPIN";
  }
  return {};
}

double turn_below(double angle) {
  const double inside = angle - 360.0 * std::floor(angle / 360.0);
  return inside < 360.0 ? inside : 0.0;
}

// The first column of a group, in a row.
std::optional<std::size_t> place_of(const std::vector<ColumnGroup>& groups, std::string_view name) {
  std::size_t place = 0;
  for (const ColumnGroup& group : groups) {
    if (group.name == name) return place;
    place += group.columns.size();
  }
  return std::nullopt;
}

class AemSink : public Sink {
 public:
  AemSink(const std::string& path, const std::vector<ColumnGroup>& groups,
          const Provenance& provenance, const std::optional<SinkPosition>& from);
  void push(std::span<const double> rows) override;
  std::optional<SinkPosition> position() override;
  void finish() override;

 private:
  void choose_columns(const std::string& path, const std::vector<ColumnGroup>& groups);
  CivilTime time_of(double t) const;
  std::string head(const Provenance& provenance);
  std::string meta();
  void append_row(const double* row);
  void append(double number);

  AemOutput output_;
  AemOptions options_;
  std::string scale_;
  CivilTime epoch_;
  Quaternion q_AI_{};  // of the axes of the file, seen from frame A
  std::size_t width_ = 0;
  std::size_t q_ = 0;
  std::size_t w_ = 0;
  double rate_ = 1.0;  // deg/s in the unit of the column
  std::string text_;
  std::int64_t stop_place_ = 0;
  std::string stop_;
  std::optional<CivilTime> latest_;
  std::optional<PartFile> file_;
  std::int64_t rows_ = 0;
};

AemSink::AemSink(const std::string& path, const std::vector<ColumnGroup>& groups,
                 const Provenance& provenance, const std::optional<SinkPosition>& from)
    : output_(provenance.aem), options_(provenance.aem.options) {
  const std::string shown = printable(path, path.size()) + ": ";
  if (part_path(path) == path) throw DomainError(shown + "is not a regular file; an AEM needs one");
  if (output_.epoch.empty())
    throw DomainError(shown + "an AEM has dates; expected epoch in [state]");
  scale_ = scale_of_epoch(output_.epoch);
  if (scale_ == "UT1")
    throw DomainError(shown +
                      "the epoch is in UT1, which does not run evenly; expected UTC, TAI, "
                      "TT or TDB");
  if (!output_.rising)
    throw DomainError(shown + "the dates of an AEM rise; expected times in [time] that rise");
  choose_columns(shown, groups);
  if (output_.axes == "ecliptic-J2000" &&
      (options_.frame_a.empty() || options_.frame_a == "EME2000"))
    q_AI_ = rotation_x(obliquity_J2000);
  std::string text;
  try {
    epoch_ = time_of_epoch(output_.epoch);
    stop_ = civil_text(time_of(output_.last));
    text = head(provenance);
    stop_place_ = static_cast<std::int64_t>(text.find("\nSTOP_TIME = ") + 13);
  } catch (const DomainError& error) {
    throw DomainError(shown + error.what());
  }
  if (!from) {
    file_.emplace(path);
    file_->write(text);
    return;
  }
  // the date behind it may be that of a run that had ended
  const std::string before_stop = text.substr(0, static_cast<std::size_t>(stop_place_));
  file_.emplace(path, std::optional(PartState{from->bytes, before_stop}));
  file_->overwrite(stop_place_, stop_);
  rows_ = from->rows;
}

void AemSink::choose_columns(const std::string& shown, const std::vector<ColumnGroup>& groups) {
  for (const ColumnGroup& group : groups) width_ += group.columns.size();
  const std::string_view attitude = output_.moving_frame ? "q_inertial" : "q";
  const auto place = [&](std::string_view name) {
    const std::optional<std::size_t> found = place_of(groups, name);
    if (!found)
      throw DomainError(shown + "expected \"" + std::string(name) +
                        "\" among the columns of [output]");
    return *found;
  };
  q_ = place(attitude);
  if (options_.form != Form::quaternion_rate && options_.form != Form::spin) return;
  w_ = place("omega");
  for (const ColumnGroup& group : groups)
    if (group.name == "omega")
      rate_ = degrees * Units("s").to_core(1.0, group.columns.front().unit, Dimension::rate);
}

CivilTime AemSink::time_of(double t) const {
  const CivilTime time = after(scale_, epoch_, t * output_.seconds);
  if (!has_text(time)) throw DomainError("a date outside the years 0 to 9999");
  return time;
}

std::string AemSink::head(const Provenance& provenance) {
  std::string out = "CCSDS_AEM_VERS = " + std::string(options_.version == 1 ? "1.0" : "2.0") + "\n";
  append_origin(out, aem_comments, provenance);
  const bool dated = !options_.creation_date.empty();
  if (!dated)
    append_comment(out, aem_comments, "",
                   "CREATION_DATE is not when this was made: equal runs give equal files");
  out += "CREATION_DATE = " + (dated ? options_.creation_date : std::string(no_date)) + "\n";
  out += "ORIGINATOR = " + options_.originator + "\n\nMETA_START\n";
  return out + meta() + "META_STOP\n\nDATA_START\n";
}

std::string AemSink::meta() {
  const bool first = options_.version == 1;
  const bool inertial = output_.axes == "inertial";
  const std::string frame_a =
      options_.frame_a.empty() ? (inertial ? "INERTIAL" : "EME2000") : options_.frame_a;
  std::string out;
  append_comment(out, aem_comments, "",
                 "REF_FRAME_B: the body axes of the scenario; REF_FRAME_A: its axes " +
                     output_.axes + (q_AI_ == Quaternion{} ? "" : ", turned into EME2000"));
  if (options_.form == Form::euler)
    append_comment(out, aem_comments, "",
                   "the angles stand in the order of their rotations, about axes 3, 1, 3");
  if (options_.form == Form::spin)
    append_comment(out, aem_comments, "",
                   "the spin axis is body axis 3; SPIN_ANGLE_VEL is the angular velocity along it");
  out += "OBJECT_NAME = " +
         printable(options_.object_name.empty() ? output_.name : options_.object_name, 125) + "\n";
  out += "OBJECT_ID = " + (options_.object_id.empty() ? "UNKNOWN" : options_.object_id) + "\n";
  if (!options_.center.empty()) out += "CENTER_NAME = " + options_.center + "\n";
  out += "REF_FRAME_A = " + frame_a + "\nREF_FRAME_B = " + options_.frame_b + "\n";
  if (first) out += "ATTITUDE_DIR = " + std::string(options_.body_to_frame ? "B2A" : "A2B") + "\n";
  out += "TIME_SYSTEM = " + scale_ + "\n";
  out += "START_TIME = " + civil_text(time_of(output_.first)) + "\n";
  out += "STOP_TIME = " + stop_ + "\n";
  out += "ATTITUDE_TYPE = " + type_of(options_) + "\n";
  const bool quaternion =
      options_.form == Form::quaternion || options_.form == Form::quaternion_rate;
  if (quaternion && first)
    out += "QUATERNION_TYPE = " + std::string(options_.scalar_first ? "FIRST" : "LAST") + "\n";
  if (options_.form == Form::euler)
    out += "EULER_ROT_SEQ = " + std::string(first ? "313" : "ZXZ") + "\n";
  if (options_.form == Form::quaternion_rate)
    out += first ? "RATE_FRAME = REF_FRAME_B\n" : "ANGVEL_FRAME = " + options_.frame_b + "\n";
  return out;
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
  const double* const w = row + w_;
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
  } else {
    const Quaternion q = options_.body_to_frame ? conj(q_AB) : q_AB;
    if (options_.scalar_first) append(q.w);
    for (const double part : {q.x, q.y, q.z}) append(part);
    if (!options_.scalar_first) append(q.w);
    if (options_.form == Form::quaternion_rate)
      for (int i = 0; i < 3; ++i) append(rate_ * w[i]);
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

// A run that an event has stopped ends before the STOP_TIME that it set out for.
void AemSink::finish() {
  if (latest_ && civil_text(*latest_) != stop_) file_->overwrite(stop_place_, civil_text(*latest_));
  file_->write("DATA_STOP\n");
  file_->commit();
}

}  // namespace

std::unique_ptr<Sink> aem_sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                               const Provenance& provenance,
                               const std::optional<SinkPosition>& from) {
  return std::make_unique<AemSink>(path, groups, provenance, from);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
