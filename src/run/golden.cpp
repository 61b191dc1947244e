// SPDX-License-Identifier: MIT
// Golden cases: the table of them, their evaluation in double-double, rounded once, and their text.
#include "polhode/run/golden.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "free/evaluate.hpp"
#include "free/prepare.hpp"
#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/version.hpp"
#include "text/json.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

// The numbers that a golden case starts from, and the times of its samples.
struct GoldenStart {
  std::string_view name;
  std::string_view description;
  Vec3 moments;
  Quaternion q0;
  Vec3 omega0;
  std::span<const double> times;
};

constexpr std::array<double, 9> tens_of_turns{0, 0.5, 1, 2, 5, 10, 20, 50, 100};
constexpr std::array<double, 9> million_turns{0, 1, 10, 100, 1e3, 1e4, 1e5, 1e6, 1e7};
constexpr std::array<double, 9> microseconds{0,      0x1p-13, 0x1p-12, 0x1p-11, 0x1p-10,
                                             0x1p-9, 0x1p-8,  0x1p-6,  0x1p-4};
constexpr std::array<double, 9> days{0, 3600, 7200, 21600, 43200, 86400, 259200, 604800, 1209600};

constexpr Vec3 triaxial{3, 4, 6}, oblate{3, 3, 5}, prolate{2, 5, 5}, flat{3, 4, 7};
constexpr Quaternion q1{1, 0, 0, 0}, q2{0.5, 0.5, 0.5, 0.5}, q3{0.8, 0, 0.6, 0},
    q4{0.1, 0.7, -0.5, 0.5}, q5{0.2, 0.4, -0.4, 0.8}, q6{0.7, 0.1, -0.7, 0.1};

// The table of golden cases. Moments and rates have few bits, so that I omega is exact; with
// moments 3, 4, 6 the separatrix is |3 omega1| = |6 omega3|, exactly.
constexpr std::array starts{
    GoldenStart{"sam", "short-axis mode", triaxial, q1, {0.5, 0.25, 1}, tens_of_turns},
    GoldenStart{
        "sam-reverse", "short-axis mode about -b3", triaxial, q4, {0.5, -0.75, -1}, tens_of_turns},
    GoldenStart{"sam-wide",
                "short-axis mode, a wide wobble",
                triaxial,
                q5,
                {1.25, -0.25, 0.75},
                tens_of_turns},
    GoldenStart{"sam-small",
                "momentum about 1e-6 off the short axis",
                triaxial,
                q3,
                {0x1p-20, -0x1p-21, 1},
                tens_of_turns},
    GoldenStart{"lam", "long-axis mode", triaxial, q1, {1, 0.25, 0.125}, tens_of_turns},
    GoldenStart{
        "lam-reverse", "long-axis mode about -b1", triaxial, q5, {-1, 0.5, 0.25}, tens_of_turns},
    GoldenStart{"lam-small",
                "momentum about 1e-6 off the long axis",
                triaxial,
                q6,
                {1, 0x1p-20, -0x1p-21},
                tens_of_turns},
    GoldenStart{"near-separatrix-sam-1e-3",
                "2TI2/G^2 about 1 - 1e-3",
                triaxial,
                q1,
                {2 - 0x1p-7, 0.5, 1},
                tens_of_turns},
    GoldenStart{"near-separatrix-lam-1e-3",
                "2TI2/G^2 about 1 + 1e-3",
                triaxial,
                q4,
                {2 + 0x1p-7, 0.5, -1},
                tens_of_turns},
    GoldenStart{"near-separatrix-sam-1e-8",
                "2TI2/G^2 about 1 - 1e-8",
                triaxial,
                q3,
                {2 - 0x1p-24, -0.5, 1},
                tens_of_turns},
    GoldenStart{"near-separatrix-lam-1e-8",
                "2TI2/G^2 about 1 + 1e-8",
                triaxial,
                q2,
                {-2 - 0x1p-24, 0.5, 1},
                tens_of_turns},
    GoldenStart{"near-separatrix-sam-1e-14",
                "2TI2/G^2 about 1 - 1e-14",
                triaxial,
                q5,
                {2 - 0x1p-44, 0.5, 1},
                tens_of_turns},
    GoldenStart{"near-separatrix-lam-1e-14",
                "2TI2/G^2 about 1 + 1e-14",
                triaxial,
                q6,
                {2 + 0x1p-44, 0.5, 1},
                tens_of_turns},
    GoldenStart{"separatrix",
                "2TI2/G^2 = 1 exactly: one flip, then spin about b2; unstable",
                triaxial,
                q1,
                {2, 0.5, 1},
                tens_of_turns},
    GoldenStart{"separatrix-other-branch",
                "the same with g1 < 0, g2 < 0; unstable",
                triaxial,
                q4,
                {-2, -0.5, 1},
                tens_of_turns},
    GoldenStart{"spin-b1", "spin about the long axis", triaxial, q2, {1.5, 0, 0}, tens_of_turns},
    GoldenStart{"spin-b2",
                "spin about the intermediate axis; unstable",
                triaxial,
                q3,
                {0, -1.25, 0},
                tens_of_turns},
    GoldenStart{"spin-b3", "spin about the short axis", triaxial, q5, {0, 0, 0.75}, tens_of_turns},
    GoldenStart{"near-b2",
                "momentum about 1e-6 off the intermediate axis: it flips",
                triaxial,
                q1,
                {0x1p-20, 1, 0x1p-20},
                tens_of_turns},
    GoldenStart{"rest", "no rotation", triaxial, q4, {0, 0, 0}, tens_of_turns},
    GoldenStart{"sphere", "three equal moments", {2, 2, 2}, q6, {0.5, -0.25, 1}, tens_of_turns},
    GoldenStart{"near-sphere",
                "moments equal to within 1e-6",
                {0x1p22, 0x1p22 + 1, 0x1p22 + 3},
                q3,
                {0.5, -0.25, 1},
                tens_of_turns},
    GoldenStart{"oblate", "two equal lesser moments", oblate, q1, {0.5, 0.25, 1}, tens_of_turns},
    GoldenStart{
        "oblate-reverse", "the same about -b3", oblate, q5, {-0.5, 0.25, -1}, tens_of_turns},
    GoldenStart{"oblate-across",
                "spin across the symmetry axis: steady",
                oblate,
                q2,
                {0.5, 1, 0},
                tens_of_turns},
    GoldenStart{"prolate", "two equal greater moments", prolate, q1, {1, 0.25, 0.5}, tens_of_turns},
    GoldenStart{"prolate-across",
                "spin across the symmetry axis: steady",
                prolate,
                q4,
                {0, 0.5, -1},
                tens_of_turns},
    GoldenStart{"near-oblate",
                "lesser moments equal to within 1e-6",
                {3, 3 + 0x1p-20, 5},
                q6,
                {0.5, 0.25, 1},
                tens_of_turns},
    GoldenStart{"near-prolate",
                "greater moments equal to within 1e-6",
                {2, 5, 5 + 0x1p-20},
                q3,
                {1, 0.25, 0.5},
                tens_of_turns},
    GoldenStart{"flat-sam",
                "flat body, I3 = I1 + I2, short-axis mode",
                flat,
                q2,
                {0.5, 0.25, 1},
                tens_of_turns},
    GoldenStart{"flat-lam",
                "flat body, I3 = I1 + I2, long-axis mode",
                flat,
                q1,
                {1, 0.25, 0.125},
                tens_of_turns},
    GoldenStart{"needle",
                "least moment a thousandth of the others",
                {0x1p-10, 1, 1 + 0x1p-11},
                q5,
                {2, 0.5, -0.25},
                tens_of_turns},
    GoldenStart{
        "order-364", "moments in the order 3, 6, 4", {3, 6, 4}, q1, {0.5, 1, 0.25}, tens_of_turns},
    GoldenStart{
        "order-436", "moments in the order 4, 3, 6", {4, 3, 6}, q4, {0.25, 0.5, -1}, tens_of_turns},
    GoldenStart{"order-463",
                "moments in the order 4, 6, 3",
                {4, 6, 3},
                q2,
                {0.25, 0.125, 1},
                tens_of_turns},
    GoldenStart{"order-634",
                "moments in the order 6, 3, 4",
                {6, 3, 4},
                q6,
                {0.125, -1, 0.25},
                tens_of_turns},
    GoldenStart{
        "order-643", "moments in the order 6, 4, 3", {6, 4, 3}, q3, {1, 0.25, 0.5}, tens_of_turns},
    GoldenStart{"long-sam",
                "more than a million turns, short-axis mode",
                triaxial,
                q5,
                {0.5, 0.25, 1},
                million_turns},
    GoldenStart{"long-lam",
                "more than a million turns, long-axis mode",
                triaxial,
                q4,
                {1, 0.25, 0.125},
                million_turns},
    GoldenStart{"long-near-separatrix",
                "more than a million turns, 2TI2/G^2 about 1 - 1e-3",
                triaxial,
                q1,
                {2 - 0x1p-7, 0.5, 1},
                million_turns},
    GoldenStart{"long-oblate",
                "more than a million turns, axisymmetric",
                oblate,
                q6,
                {0.5, 0.25, 1},
                million_turns},
    GoldenStart{"small-and-fast",
                "moments of some 1e-6, 900 rad per unit of time",
                {3 * 0x1p-20, 4 * 0x1p-20, 6 * 0x1p-20},
                q3,
                {128, 900, 32},
                microseconds},
    GoldenStart{"large-and-slow",
                "moments of some 1e18, about a turn a day in seconds",
                {3 * 0x1p60, 4 * 0x1p60, 6 * 0x1p60},
                q2,
                {0x1p-15, 0x1p-15, 0x1p-14},
                days},
};

}  // namespace
}  // namespace detail

namespace {

using DD = DoubleDouble;
using WideState = BasicRotorState<DD>;

// The double nearest to a number of 17 digits is the number rounded once more: 2^-53 and half a
// unit of the 17th digit, relative, in every component; and 1e-24 of the sum itself.
constexpr double printed_bound = 2e-16;

// q and omega at t.
WideState state_at(const Body& body, const BasicFreeKernel<DD>& motion, double t) {
  const BasicRotorState<DD> s = evaluate(motion, DD(t));
  const Vec3& I = body.moments();
  return {s.q, {s.g.x / I.x, s.g.y / I.y, s.g.z / I.z}};
}

// What is left of a zero in double-double is not written; -0 is 0.
constexpr double no_digits = 1e-26;
double meant(double x, double least) { return std::abs(x) < least ? 0.0 : x + 0.0; }

// q and -q are one attitude.
GoldenSample rounded(double t, const WideState& s) {
  const double sign = s.q.w.hi < 0.0 ? -1.0 : 1.0;
  const auto number = [sign](const DD& x) { return meant(sign * x.hi, no_digits); };
  const double least = no_digits * norm(s.g).hi;
  return {t,
          {number(s.q.w), number(s.q.x), number(s.q.y), number(s.q.z)},
          {meant(s.g.x.hi, least), meant(s.g.y.hi, least), meant(s.g.z.hi, least)}};
}

GoldenCase evaluated_case(const detail::GoldenStart& start) {
  const Body body(start.moments.x, start.moments.y, start.moments.z);
  const RotorState s0{start.q0,
                      {start.moments.x * start.omega0.x, start.moments.y * start.omega0.y,
                       start.moments.z * start.omega0.z}};
  const BasicFreeKernel<DD> motion = prepare<DD>(body, s0);
  GoldenCase result{std::string(start.name),
                    std::string(start.description),
                    FreeRotation(body, s0).regime(),
                    start.moments,
                    start.q0,
                    start.omega0,
                    printed_bound,
                    {}};
  for (const double t : start.times)
    result.samples.push_back(rounded(t, state_at(body, motion, t)));
  return result;
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const bool made = std::filesystem::is_directory(folder);
  if (made) return;
  const std::string why = error ? error.message() : "there is a file of that name";
  throw DomainError(detail::printable(folder, 500) + ": cannot be a folder: " + why);
}

}  // namespace

std::vector<GoldenCase> golden_cases() {
  std::vector<GoldenCase> cases;
  for (const detail::GoldenStart& start : detail::starts) cases.push_back(evaluated_case(start));
  return cases;
}

void write_golden(const std::string& folder, const std::vector<GoldenCase>& cases) {
  make_folder(folder);
  const std::filesystem::path path(folder);
  detail::PartFile json((path / "golden.json").string()), csv((path / "golden.csv").string());
  json.write(golden_json(cases));
  csv.write(golden_csv(cases));
  json.commit();
  csv.commit();
}

namespace {

using Numbers = std::vector<double>;

// Of computed numbers; given ones have their shortest form, which is exact.
std::string digits17(double value) {
  char text[detail::longest_number];
  return std::string(text, std::to_chars(text, text + detail::longest_number, value,
                                         std::chars_format::general, 17)
                               .ptr);
}

Numbers numbers(const Vec3& v) { return {v.x, v.y, v.z}; }
Numbers numbers(const Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

std::string joined(const Numbers& values, std::string_view comma,
                   std::string (*text)(double) = polhode::detail::number_text) {
  std::string line;
  for (const double value : values) {
    if (!line.empty()) line += comma;
    line += text(value);
  }
  return line;
}

std::string array(const Numbers& values,
                  std::string (*text)(double) = polhode::detail::number_text) {
  return "[" + joined(values, ", ", text) + "]";
}

constexpr const char* q_meaning =
    "[w, x, y, z], Hamilton's product, body to inertial: v_inertial = q v_body q*; q and -q are "
    "one attitude, w >= 0 is written";
constexpr const char* omega_meaning = "body axes, radians per unit of time";
constexpr const char* bound_meaning =
    "|q - exact| <= bound and |omega - exact| <= bound |omega|, for moments, q0/|q0| and "
    "omega0_body exactly as written";

}  // namespace

std::string regime_name(Regime regime) {
  switch (regime) {
    case Regime::rest:
      return "rest";
    case Regime::steady:
      return "steady";
    case Regime::short_axis:
      return "short_axis";
    case Regime::long_axis:
      return "long_axis";
    case Regime::separatrix:
      return "separatrix";
  }
  return {};
}

std::string golden_json(const std::vector<GoldenCase>& cases) {
  detail::JsonWriter json;
  json.begin_object().key("title").value("Exact torque-free rotations of rigid bodies");
  json.key("polhode").value(version());
  json.key("meaning").begin_object();
  json.key("moments").value("principal moments of inertia about body axes 1, 2, 3");
  json.key("q").value(q_meaning).key("omega").value(omega_meaning);
  json.key("bound").value(bound_meaning).end_object();
  json.key("cases").begin_array();
  for (const GoldenCase& c : cases) {
    json.begin_object().key("name").value(c.name).key("description").value(c.description);
    json.key("regime").value(regime_name(c.regime));
    json.key("moments").raw(array(numbers(c.moments)));
    json.key("q0").raw(array(numbers(c.q0)));
    json.key("omega0_body").raw(array(numbers(c.omega0)));
    json.key("bound").value(c.bound);
    std::string rows;
    for (const GoldenSample& s : c.samples)
      rows += (rows.empty() ? "" : ",") + std::string("\n      {\"t\": ") +
              polhode::detail::number_text(s.t) + ", \"q\": " + array(numbers(s.q), digits17) +
              ", \"omega\": " + array(numbers(s.omega), digits17) + "}";
    json.key("samples").raw("[" + rows + "\n    ]").end_object();
  }
  json.end_array().end_object();
  return json.text();
}

std::string golden_csv(const std::vector<GoldenCase>& cases) {
  std::string csv = "# Exact torque-free rotations of rigid bodies. polhode ";
  csv += version();
  csv += "\n# moments: principal moments of inertia about body axes 1, 2, 3\n";
  for (const auto& [name, meaning] :
       {std::pair{"q", q_meaning}, {"omega", omega_meaning}, {"bound", bound_meaning}})
    csv += std::string("# ") + name + ": " + meaning + "\n";
  csv += "case,regime,I1,I2,I3,qw0,qx0,qy0,qz0,w10,w20,w30,bound,t,qw,qx,qy,qz,w1,w2,w3\n";
  for (const GoldenCase& c : cases) {
    const std::string start = c.name + "," + regime_name(c.regime) + "," +
                              joined(numbers(c.moments), ",") + "," + joined(numbers(c.q0), ",") +
                              "," + joined(numbers(c.omega0), ",") + "," +
                              polhode::detail::number_text(c.bound) + ",";
    for (const GoldenSample& s : c.samples)
      csv += start + polhode::detail::number_text(s.t) + "," + joined(numbers(s.q), ",", digits17) +
             "," + joined(numbers(s.omega), ",", digits17) + "\n";
  }
  return csv;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
