// SPDX-License-Identifier: MIT
// What the interface of the explorer's core answers on this machine, as JSON: numbers in 17 digits,
// which are their bits; every golden case, its charts, curves and perturbed motion.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "polhode/math/instruction_set.hpp"
#include "polhode/run/golden.hpp"
#include "polhode_web.h"

namespace {

using Numbers = std::vector<double>;

void print(const char* name, const Numbers& values, const char* end = ",\n") {
  std::printf("\"%s\": [", name);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = values[i];
    std::printf(i == 0 ? "" : ", ");
    if (std::isfinite(x))
      std::printf("%.17g", x);
    else
      std::printf("\"%s\"", std::isnan(x) ? "NaN" : x < 0.0 ? "-Infinity" : "Infinity");
  }
  std::printf("]%s", end);
}

// What a function writes, or the empty row where it refuses.
template <class F>
Numbers answer(std::size_t size, const F& ask) {
  Numbers found(size);
  if (ask(found.data()) != 0) found.clear();
  return found;
}

void print_rows(const polhode_motion* motion, const Numbers& times) {
  const auto rows = [&](int kind, std::size_t size, const double* at, double start, double step,
                        std::size_t count) {
    const Numbers light{1.3, 1.0, 0.7, 1.0, 0.1, 0.2, 0.8, -0.5, 0.1};
    return answer(size * count, [&](double* to) {
      return polhode_motion_rows(motion, kind, at, start, step, static_cast<uint32_t>(count),
                                 light.data(), to);
    });
  };
  print("rows", rows(POLHODE_STATES, 7, times.data(), 0.0, 0.0, times.size()));
  print("grid", rows(POLHODE_STATES, 7, nullptr, 0.25, 0.375, 300));
  print("far_grid", rows(POLHODE_STATES, 7, nullptr, 1e9, 0.375, 70));
  print("body_rates", rows(POLHODE_BODY_RATES, 3, nullptr, 0.25, 0.375, 20));
  print("inertial_rates", rows(POLHODE_INERTIAL_RATES, 3, nullptr, 0.25, 0.375, 20));
  print("herpolhode", rows(POLHODE_HERPOLHODE, 3, nullptr, 0.25, 0.375, 20));
  print("andoyer", rows(POLHODE_ANDOYER_ROWS, 6, nullptr, 0.25, 0.375, 20));
  print("brightness", rows(POLHODE_BRIGHTNESS, 1, nullptr, 0.25, 0.375, 20));
}

void print_charts(const polhode_motion* motion, const double* moments, const double* state) {
  const auto chart = [&](int kind, std::size_t size) {
    Numbers found(9);
    found[6] = found[7] = -1.0;
    if (polhode_to_chart(kind, moments, state, found.data()) != 0) return Numbers{};
    found.resize(size);
    return found;
  };
  print("to_andoyer", chart(POLHODE_ANDOYER, 6));
  print("to_euler", chart(POLHODE_EULER, 6));
  print("to_euler_rates", chart(POLHODE_EULER_RATES, 6));
  print("to_poincare", chart(POLHODE_POINCARE, 8));
  print("to_roll_pitch_yaw", chart(POLHODE_ROLL_PITCH_YAW, 3));
  const auto of_motion = [&](int kind, std::size_t size) {
    return answer(size, [&](double* to) { return polhode_motion_chart(motion, kind, 0.5, to); });
  };
  print("serret", of_motion(POLHODE_SERRET, 8));
  print("sadov", of_motion(POLHODE_SADOV, 8));
  print("tumbler", of_motion(POLHODE_TUMBLER, 10));
}

void print_case(const polhode::GoldenCase& golden, bool is_last) {
  const polhode::Vec3& I = golden.moments;
  const polhode::Vec3& w = golden.omega0;
  const polhode::Quaternion& q = golden.q0;
  const Numbers moments{I.x, I.y, I.z}, q0{q.w, q.x, q.y, q.z}, omega{w.x, w.y, w.z};
  Numbers state(7), times, at, exact;
  polhode_state_of_rate(moments.data(), q0.data(), omega.data(), 0, state.data());
  polhode_motion* const motion = polhode_motion_of(moments.data(), state.data(), 0.0);
  for (const polhode::GoldenSample& s : golden.samples) {
    Numbers found(7);
    polhode_motion_at(motion, s.t, found.data());
    at.insert(at.end(), found.begin(), found.end());
    times.push_back(s.t);
    for (const double x : {s.q.w, s.q.x, s.q.y, s.q.z, s.omega.x, s.omega.y, s.omega.z})
      exact.push_back(x);
  }
  std::printf("{\"name\": \"%s\",\n", golden.name.c_str());
  print("moments", moments);
  print("q0", q0);
  print("omega0", omega);
  print("times", times);
  print("exact", exact);
  print("state", state);
  print("at", at);
  Numbers summary(19);
  polhode_motion_summary(motion, summary.data());
  print("summary", summary);
  print_rows(motion, times);
  print_charts(motion, moments.data(), state.data());
  Numbers curve(3 * 33);
  curve.resize(3 * polhode_motion_curve(motion, 33, curve.data()));
  print("curve", curve, is_last ? "}\n" : "},\n");
  polhode_motion_release(motion);
}

}  // namespace

int main() {
  const std::vector<polhode::GoldenCase> cases = polhode::golden_cases();
  std::printf(
      "{\"instructions\": \"%s\",\n\"cases\": [\n",
      std::string(polhode::instruction_set_name(polhode::widest_instruction_set())).c_str());
  for (const polhode::GoldenCase& golden : cases) print_case(golden, &golden == &cases.back());
  std::printf("],\n");
  // Envisat in its orbit, in a frame that precesses, damped
  const Numbers problem{17023.3, 124825.7, 129112.2, 0.9, 0.1,    -0.3,  0.2,
                        100.0,   6000.0,   900.0,    0.0, 6000.0, 1e-12, 3.986004418e14,
                        7.1e6,   0.001,    1.7,      0.3, 0.2,    0.1,   0.0,
                        1e-9,    0.0,      0.0,      0.0, 1.0,    2e-7,  2e5};
  Numbers rows(POLHODE_SAMPLE_SIZE * 25);
  const int made = polhode_integrate(problem.data(), 25, rows.data());
  rows.resize(static_cast<std::size_t>(made < 0 ? 0 : made) * POLHODE_SAMPLE_SIZE);
  print("problem", problem);
  print("perturbed", rows, "}\n");
}
