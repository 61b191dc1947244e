// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/tables/aem.hpp"
#include "tables/detail/gzip_file.hpp"
#include "tables/detail/kvn_reader.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::KvnLine;

constexpr std::size_t largest_file = std::size_t{1} << 30;
constexpr double degree = std::numbers::pi / 180.0;
constexpr double length_error = 0.01;  // of a quaternion written with few digits
constexpr std::string_view versions[] = {"1.0", "2.0"};

enum class Rates { none, derivative, angular_velocity, about_axis_3 };
enum class Angles { quaternion, euler, spin };

struct Layout {
  std::string_view type;
  Angles angles;
  Rates rates;
  std::string_view fields;
};
constexpr Layout layouts[] = {
    {"QUATERNION", Angles::quaternion, Rates::none, "date and 4 numbers"},
    {"QUATERNION/DERIVATIVE", Angles::quaternion, Rates::derivative, "date and 8 numbers"},
    {"QUATERNION/ANGVEL", Angles::quaternion, Rates::angular_velocity, "date and 7 numbers"},
    {"EULER_ANGLE", Angles::euler, Rates::none, "date and 3 numbers"},
    {"EULER_ANGLE/DERIVATIVE", Angles::euler, Rates::derivative, "date and 6 numbers"},
    {"EULER_ANGLE/ANGVEL", Angles::euler, Rates::angular_velocity, "date and 6 numbers"},
    {"SPIN", Angles::spin, Rates::about_axis_3, "date and 4 numbers"},
};

// Types of version 1 whose rates programs take for different things: the text of the standard calls
// them Euler rates, in the order of the rotations, and gives them a frame.
struct Ambiguous {
  std::string_view type;
  std::string_view readings;
};
constexpr Ambiguous ambiguous[] = {
    {"QUATERNION/RATE",
     "QUATERNION/ANGVEL if it is the angular velocity; rates of Euler angles are not read"},
    {"EULER_ANGLE/RATE",
     "EULER_ANGLE/ANGVEL if it is the angular velocity, EULER_ANGLE/DERIVATIVE if it is the rates "
     "of the angles"},
};

std::size_t width(const Layout& layout) {
  if (layout.angles == Angles::euler) return layout.rates == Rates::none ? 3 : 6;
  return layout.rates == Rates::derivative ? 8 : layout.rates == Rates::angular_velocity ? 7 : 4;
}

// The axis of a digit or letter of EULER_ROT_SEQ, 0 to 2.
std::optional<int> axis_of(char c) {
  if (c >= '1' && c <= '3') return c - '1';
  if (c >= 'X' && c <= 'Z') return c - 'X';
  return std::nullopt;
}

Quaternion about(int axis, double angle) {
  const double c = std::cos(0.5 * angle), s = std::sin(0.5 * angle);
  return {c, axis == 0 ? s : 0.0, axis == 1 ? s : 0.0, axis == 2 ? s : 0.0};
}

class AemReader {
 public:
  AemReader(std::string_view text, std::string name)
      : lines_(text, std::move(name), "AEM", versions) {}
  AttitudeEphemeris read();

 private:
  void read_meta();
  void read_rows();
  void read_row(const KvnLine& line, AemSegment& segment);
  void choose_layout();
  void choose_sequence();
  void add(const std::array<double, 8>& n, AemSegment& segment);
  Quaternion quaternion(const std::array<double, 8>& n, std::size_t first) const;
  Vec3 quaternion_velocity(const std::array<double, 8>& n, const Quaternion& q_AB) const;
  Vec3 euler_velocity(const std::array<double, 8>& n, const Quaternion& q) const;

  detail::KvnEphemerisReader lines_;
  AttitudeEphemeris result_;
  Layout layout_ = layouts[0];
  std::array<int, 3> sequence_{2, 0, 2};
  bool scalar_first_ = false;
  bool body_to_frame_ = false;
  bool rate_in_a_ = false;
};

AttitudeEphemeris AemReader::read() {
  detail::KvnHeader header = lines_.read_header();
  result_.version = std::move(header.version);
  result_.creation_date = std::move(header.creation_date);
  result_.originator = std::move(header.originator);
  result_.comments = std::move(header.comments);
  for (;;) {
    read_meta();
    read_rows();
    std::optional<KvnLine> line = lines_.next();
    while (line && line->kind == KvnLine::Kind::comment) line = lines_.next();
    if (!line) return std::move(result_);
    if (line->key != "META_START")
      lines_.unexpected(*line, "behind the data", "META_START of another segment, or the end");
  }
}

void AemReader::read_meta() {
  lines_.read_metadata();
  choose_layout();
  result_.segments.push_back({.object_name = lines_.needed("OBJECT_NAME"),
                              .object_id = lines_.needed("OBJECT_ID"),
                              .center = lines_.optional("CENTER_NAME"),
                              .frame_a = lines_.needed("REF_FRAME_A"),
                              .frame_b = lines_.needed("REF_FRAME_B"),
                              .time_system = lines_.read_time_system(),
                              .attitude_type = std::string(layout_.type),
                              .start = lines_.needed("START_TIME"),
                              .stop = lines_.needed("STOP_TIME"),
                              .epochs = {},
                              .t = {},
                              .q_AB = {},
                              .w_AB_B = {},
                              .w3 = {}});
}

void AemReader::choose_layout() {
  std::string type = lines_.needed("ATTITUDE_TYPE");
  std::replace(type.begin(), type.end(), ' ', '_');  // Orekit writes EULER ANGLE
  const auto* const found = std::find_if(std::begin(layouts), std::end(layouts),
                                         [&](const Layout& layout) { return layout.type == type; });
  for (const Ambiguous& old : ambiguous)
    if (type == old.type)
      lines_.fail("ATTITUDE_TYPE: got \"" + type +
                  "\", whose rates programs read in two ways; expected its name of version "
                  "2: " +
                  std::string(old.readings));
  if (found == std::end(layouts)) {
    std::vector<std::string_view> known;
    for (const Layout& layout : layouts) known.push_back(layout.type);
    lines_.fail("ATTITUDE_TYPE: got \"" + detail::printable(type) + "\"; read are " +
                detail::one_of(known));
  }
  layout_ = *found;
  const std::string direction = lines_.optional("ATTITUDE_DIR");
  if (!direction.empty() && direction != "A2B" && direction != "B2A")
    lines_.refuse("ATTITUDE_DIR", direction, "A2B or B2A");
  body_to_frame_ = direction == "B2A";
  const std::string order = lines_.optional("QUATERNION_TYPE");
  if (!order.empty() && order != "FIRST" && order != "LAST")
    lines_.refuse("QUATERNION_TYPE", order, "FIRST or LAST");
  if (order.empty() && result_.version == "1.0" && layout_.angles == Angles::quaternion)
    lines_.fail("the metadata above have no QUATERNION_TYPE, FIRST or LAST");
  scalar_first_ = order == "FIRST";
  const std::string a = lines_.optional("REF_FRAME_A");
  const std::string frame = lines_.optional("RATE_FRAME") + lines_.optional("ANGVEL_FRAME");
  rate_in_a_ = frame == "REF_FRAME_A" || (frame == a && frame != lines_.optional("REF_FRAME_B"));
  const bool is_named =
      rate_in_a_ || frame == "REF_FRAME_B" || frame == lines_.optional("REF_FRAME_B");
  if (layout_.rates == Rates::angular_velocity && !is_named)
    lines_.refuse("the frame of the angular velocity", frame,
                  "REF_FRAME_A, REF_FRAME_B or the name of either");
  const bool is_velocity =
      layout_.rates == Rates::angular_velocity || layout_.rates == Rates::about_axis_3;
  if (is_velocity && body_to_frame_)
    lines_.fail("ATTITUDE_DIR: got B2A with " + std::string(layout_.type) +
                ", whose rates do not tell which of the two frames rotates relative to the other; "
                "expected A2B");
  if (layout_.angles == Angles::euler) choose_sequence();
}

void AemReader::choose_sequence() {
  const std::string text = lines_.needed("EULER_ROT_SEQ");
  bool good = text.size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    const std::optional<int> axis = axis_of(text[i]);
    good = axis.has_value();
    if (good) sequence_.at(i) = *axis;
  }
  if (!good || sequence_[0] == sequence_[1] || sequence_[1] == sequence_[2])
    lines_.refuse("EULER_ROT_SEQ", text, "three axes such as 313 or ZXZ");
}

void AemReader::read_rows() {
  AemSegment& segment = result_.segments.back();
  bool started = false;
  for (;;) {
    const std::optional<KvnLine> line = lines_.next();
    if (!line) lines_.fail("the file ends before DATA_STOP");
    if (line->kind == KvnLine::Kind::comment) continue;
    if (!started) {
      if (line->key != "DATA_START") lines_.fail("expected DATA_START behind the metadata");
      started = true;
    } else if (line->key == "DATA_STOP") {
      break;
    } else if (line->kind == KvnLine::Kind::data) {
      read_row(*line, segment);
    } else {
      lines_.unexpected(*line, "among the data", "a row or DATA_STOP");
    }
  }
  if (segment.t.empty()) lines_.fail("a segment without rows");
}

void AemReader::read_row(const KvnLine& line, AemSegment& segment) {
  const std::vector<std::string_view> fields = lines_.fields(line);
  const std::size_t count = width(layout_);
  if (fields.size() != count + 1)
    lines_.fail("got " + std::to_string(fields.size()) + " fields; expected those of " +
                std::string(layout_.type) + ": " + std::string(layout_.fields));
  const double t = lines_.read_seconds(fields[0]);
  std::array<double, 8> numbers{};
  for (std::size_t i = 0; i < count; ++i)
    numbers.at(i) = lines_.number(fields[i + 1], layout_.type);
  segment.epochs.emplace_back(fields[0]);
  segment.t.push_back(t);
  add(numbers, segment);
}

Quaternion AemReader::quaternion(const std::array<double, 8>& n, std::size_t first) const {
  const std::size_t i = first;
  if (scalar_first_) return {n.at(i), n.at(i + 1), n.at(i + 2), n.at(i + 3)};
  return {n.at(i + 3), n.at(i), n.at(i + 1), n.at(i + 2)};
}

void AemReader::add(const std::array<double, 8>& n, AemSegment& segment) {
  Quaternion q{};
  std::size_t used = 4;
  if (layout_.angles == Angles::quaternion) {
    q = quaternion(n, 0);
    const double length = std::hypot(std::hypot(q.w, q.x), std::hypot(q.y, q.z));
    if (!(std::fabs(length - 1.0) < length_error))
      lines_.fail("a quaternion of length " + polhode::detail::number_text(length) +
                  "; expected 1");
  } else if (layout_.angles == Angles::euler) {
    // three turns of the axes, one after the other, each about an axis already turned
    q = about(sequence_[0], degree * n[0]) * about(sequence_[1], degree * n[1]) *
        about(sequence_[2], degree * n[2]);
    used = 3;
  } else {
    q = about(2, degree * (n[0] + 90.0)) * about(0, degree * (90.0 - n[1])) *
        about(2, degree * n[2]);
  }
  const Quaternion q_AB = body_to_frame_ ? conj(q) : q;
  segment.q_AB.push_back(q_AB);
  if (layout_.rates == Rates::about_axis_3) segment.w3.push_back(degree * n[3]);
  if (layout_.rates == Rates::derivative)
    segment.w_AB_B.push_back(layout_.angles == Angles::euler ? euler_velocity(n, q)
                                                             : quaternion_velocity(n, q_AB));
  if (layout_.rates != Rates::angular_velocity) return;
  const Vec3 w{degree * n.at(used), degree * n.at(used + 1), degree * n.at(used + 2)};
  segment.w_AB_B.push_back(rate_in_a_ ? rotate(conj(normalized(q_AB)), w) : w);
}

// w = 2 q* dq/dt
Vec3 AemReader::quaternion_velocity(const std::array<double, 8>& n, const Quaternion& q_AB) const {
  const Quaternion dot = quaternion(n, 4);
  const Quaternion w = conj(q_AB) * (body_to_frame_ ? conj(dot) : dot);
  return {2.0 * w.x, 2.0 * w.y, 2.0 * w.z};
}

// The rates of three angles about their axes, as the velocity of the rotation q = q1 q2 q3 that
// they make; that of its inverse for B2A.
Vec3 AemReader::euler_velocity(const std::array<double, 8>& n, const Quaternion& q) const {
  const auto along = [&](std::size_t k) {
    const int axis = sequence_.at(k);
    const double rate = degree * n.at(3 + k);
    return Vec3{axis == 0 ? rate : 0.0, axis == 1 ? rate : 0.0, axis == 2 ? rate : 0.0};
  };
  const Quaternion third = about(sequence_[2], degree * n[2]);
  const Quaternion second = about(sequence_[1], degree * n[1]) * third;
  const Vec3 w = rotate(conj(second), along(0)) + rotate(conj(third), along(1)) + along(2);
  return body_to_frame_ ? -rotate(q, w) : w;
}

// A table has one object and one pair of axes.
void require_same(const AemSegment& head, const AemSegment& other, std::size_t number) {
  const auto words = [](const AemSegment& s) {
    return detail::printable(s.object_name) + " (" + detail::printable(s.object_id) + ", " +
           detail::printable(s.frame_b) + " to " + detail::printable(s.frame_a) + ")";
  };
  if (words(head) != words(other))
    throw DomainError(
        "convert: segment " + std::to_string(number) + " is of " + words(other) +
        ", the first of " + words(head) +
        "; expected one object and one pair of frames: read_aem of the Python package "
        "tells segments apart");
}

}  // namespace

AttitudeEphemeris aem_from_text(std::string_view text, const std::string& name) {
  return AemReader(text, detail::printable(name, name.size())).read();
}

AttitudeEphemeris read_aem(const std::string& path) {
  return aem_from_text(detail::text_of_file(path, largest_file), path == "-" ? "<stdin>" : path);
}

std::string aem_csv(const AttitudeEphemeris& ephemeris) {
  const std::vector<AemSegment>& segments = ephemeris.segments;
  const bool several = segments.size() > 1;
  const AemSegment& head = segments.front();
  for (std::size_t i = 1; i < segments.size(); ++i) require_same(head, segments[i], i + 1);
  const auto any = [&](auto has) { return std::any_of(segments.begin(), segments.end(), has); };
  const bool rates = any([](const AemSegment& s) { return !s.w_AB_B.empty(); });
  const bool third = rates || any([](const AemSegment& s) { return !s.w3.empty(); });
  std::string out = "# t counts from " + detail::printable(head.epochs.front()) + " " +
                    head.time_system + "\n# q: components along " +
                    detail::printable(head.frame_b) + " to those along " +
                    detail::printable(head.frame_a) + "\n# units: t [s]";
  out += rates ? ", w1 [rad/s], w2 [rad/s]" : "";
  out += third ? ", w3 [rad/s]\n" : "\n";
  out += "t,qw,qx,qy,qz" + std::string(rates ? ",w1,w2" : "") + (third ? ",w3" : "") +
         (several ? ",segment\n" : "\n");
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t k = 0; k < segments[i].t.size(); ++k) {
      const AemSegment& s = segments[i];
      const Quaternion& q = s.q_AB[k];
      out += polhode::detail::number_text(s.t[k]);
      for (const double x : {q.w, q.x, q.y, q.z}) out += "," + polhode::detail::number_text(x);
      // a rate that this segment has not is an empty field
      const bool known = !s.w_AB_B.empty();
      for (int j = 0; rates && j < 2; ++j)
        out += "," + (known ? polhode::detail::number_text(s.w_AB_B[k][j]) : "");
      if (third)
        out += "," + (known          ? polhode::detail::number_text(s.w_AB_B[k].z)
                      : s.w3.empty() ? ""
                                     : polhode::detail::number_text(s.w3[k]));
      out += several ? "," + std::to_string(i + 1) + "\n" : "\n";
    }
  return out;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
