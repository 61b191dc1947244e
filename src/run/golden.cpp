// SPDX-License-Identifier: MIT
// Golden cases evaluated: the same series as FreeRotation's, summed in double-double and rounded
// once.
#include "polhode/run/golden.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "free/detail/assembly.hpp"
#include "free/detail/precession.hpp"
#include "free/detail/sorted_state.hpp"
#include "output/part_file.hpp"
#include "polhode/error.hpp"
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

BasicQuaternion<DD> widened(const Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

// FreeRotation in double-double from end to end.
class WideMotion {
 public:
  WideMotion(const Body& body, const RotorState& s0)
      : moments_(body.moments()),
        arc_(detail::primed_arc<DD>(body, s0.g)),
        steady_(arc_.curve.steady || !(arc_.curve.DC > DD(0.0))),
        q0_(normalized(widened(s0.q))) {
    if (steady_) return;
    series_ = detail::cayley_klein_series(arc_.curve);
    right_ = detail::quaternion_of<DD>(arc_.primed);
    left_ = q0_ * conj(right_) * conj(primed_attitude(arc_.u0));
    precession_ = detail::precession_of_axis1(arc_.curve);
  }

  // q and omega at t.
  WideState at(double t) const {
    if (steady_) return steady_state(t);
    const DD elapsed = DD(t) * std::ldexp(1.0, arc_.scale.rate());
    const BasicQuaternion<DD> p = primed_attitude(arc_.u0 + arc_.curve.n * elapsed);
    const BasicVec3<DD> g =
        arc_.curve.G * detail::restored(arc_.primed, momentum_direction(p, DD(1.0)));
    return {left_ * rotation_z(DD(precession_ * elapsed)) * p * right_, rate(g)};
  }

 private:
  BasicQuaternion<DD> primed_attitude(const DD& u) const {
    return normalized(detail::primed_attitude(arc_.curve, series_, u));
  }
  BasicVec3<DD> rate(const BasicVec3<DD>& g) const {
    const double unit = std::ldexp(1.0, arc_.scale.momentum);
    return {g.x / moments_.x * unit, g.y / moments_.y * unit, g.z / moments_.z * unit};
  }
  WideState steady_state(double t) const {
    const BasicVec3<DD> w = rate(arc_.g);
    const DD size = norm(w);
    if (size == DD(0.0)) return {q0_, w};
    const DD half = DD(0.5) * size * t;
    const DD s = sin(half) / size;
    return {q0_ * BasicQuaternion<DD>{cos(half), s * w.x, s * w.y, s * w.z}, w};
  }

  Vec3 moments_;
  detail::PrimedArc<DD> arc_;
  bool steady_;
  CayleyKleinSeries<DD> series_;
  BasicQuaternion<DD> q0_, left_, right_;
  DD precession_;  // of primed axis 1, scaled
};

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
  const WideMotion motion(body, s0);
  GoldenCase result{std::string(start.name),
                    std::string(start.description),
                    FreeRotation(body, s0).regime(),
                    start.moments,
                    start.q0,
                    start.omega0,
                    printed_bound,
                    {}};
  for (const double t : start.times) result.samples.push_back(rounded(t, motion.at(t)));
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
