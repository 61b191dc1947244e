// SPDX-License-Identifier: MIT
// Golden cases evaluated: prepared and evaluated in double-double, and rounded once.
#include "polhode/run/golden.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/free/evaluate.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/prepare.hpp"
#include "run/detail/golden_table.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
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
  for (const detail::GoldenStart& start : detail::golden_starts())
    cases.push_back(evaluated_case(start));
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

}  // namespace v0
}  // namespace polhode
