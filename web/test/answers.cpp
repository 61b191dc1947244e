// SPDX-License-Identifier: MIT
// What the interface of the explorer's core answers on this machine, as JSON: numbers in 17 digits,
// which are their bits; every golden case, its charts, curves and perturbed motion.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "polhode/math/instruction_set.hpp"
#include "polhode/run/golden.hpp"
#include "polhode_web.h"

namespace {

using Numbers = std::vector<double>;

void print(const std::string& name, const Numbers& values, const char* end = ",\n") {
  std::printf("\"%s\": [", name.c_str());
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

// The chart, empty where there is none, and the state that is made of its numbers.
void print_chart(const char* name, int kind, std::size_t size, const double* moments,
                 const double* state) {
  const Numbers chart = answer(size, [&](double* to) {
    if (kind == POLHODE_POINCARE) to[6] = to[7] = -1.0;
    return polhode_to_chart(kind, moments, state, to);
  });
  const bool is_attitude = kind >= POLHODE_ROLL_PITCH_YAW;
  print((kind == POLHODE_MATRIX ? "" : "to_") + std::string(name), chart);
  print("from_" + std::string(name),
        chart.empty() ? chart : answer(is_attitude ? 4 : 7, [&](double* to) {
          Numbers back(7);
          const int is_refused = polhode_from_chart(kind, moments, chart.data(), back.data());
          std::copy_n(back.begin(), is_attitude ? 4 : 7, to);
          return is_refused;
        }));
}

void print_motion_chart(const char* name, int kind, std::size_t size, const double* moments,
                        const polhode_motion* motion) {
  const Numbers chart =
      answer(size, [&](double* to) { return polhode_motion_chart(motion, kind, 0.5, to); });
  const double t = kind == POLHODE_SERRET ? 0.5 : 0.0;
  print(name, chart);
  print("from_" + std::string(name), chart.empty() ? chart : answer(7, [&](double* to) {
          return polhode_from_motion_chart(kind, moments, chart.data(), t, to);
        }));
}

void print_charts(const polhode_motion* motion, const double* moments, const double* state) {
  print_chart("andoyer", POLHODE_ANDOYER, 6, moments, state);
  print_chart("euler", POLHODE_EULER, 6, moments, state);
  print_chart("euler_rates", POLHODE_EULER_RATES, 6, moments, state);
  print_chart("poincare", POLHODE_POINCARE, 8, moments, state);
  print_chart("roll_pitch_yaw", POLHODE_ROLL_PITCH_YAW, 3, moments, state);
  print_chart("euler_angles", POLHODE_EULER_ANGLES, 3, moments, state);
  print_chart("matrix", POLHODE_MATRIX, 9, moments, state);
  print_motion_chart("serret", POLHODE_SERRET, 8, moments, motion);
  print_motion_chart("sadov", POLHODE_SADOV, 8, moments, motion);
  print_motion_chart("tumbler", POLHODE_TUMBLER, 10, moments, motion);
  print("derived", answer(10, [&](double* to) {
          polhode_derived(moments, state, to);
          return 0;
        }));
  print("semi_axes", answer(3, [&](double* to) {
          polhode_semi_axes(moments, 1.0, to);
          return 0;
        }));
  print("tensor", answer(7, [&](double* to) {
          Numbers R(9), tensor;
          polhode_to_chart(POLHODE_MATRIX, moments, state, R.data());
          for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
              tensor.push_back(R[i] * moments[0] * R[j] + R[3 + i] * moments[1] * R[3 + j] +
                               R[6 + i] * moments[2] * R[6 + j]);
          return polhode_body_of_tensor(tensor.data(), to);
        }));
  const Numbers direction{0.3, -0.2, 0.9};
  print("along",
        answer(7, [&](double* to) { return polhode_momentum_along(state, direction.data(), to); }));
}

void print_flips(const polhode_motion* motion) {
  Numbers flips(20);
  double interval = 0.0;
  const int count = polhode_motion_flips(motion, 0.0, 100.0, 20, flips.data(), &interval);
  flips.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
  if (count >= 0) flips.push_back(interval);
  print("flips", flips);
  print("sensitivity", {polhode_motion_sensitivity(motion, 1000.0)});
}

// Energies and points of the curves that the body has.
template <class F>
Numbers curves(uint32_t points, const F& twice_energy) {
  Numbers found;
  for (int side = 0; side < 4; ++side) {
    Numbers rows(3 * points);
    const double twice = twice_energy(side, rows.data());
    if (std::isnan(twice)) continue;
    found.push_back(twice / 2.0);
    found.insert(found.end(), rows.begin(), rows.end());
  }
  return found;
}

void print_curves(const polhode_motion* motion, const double* moments, const char* end) {
  Numbers summary(19), curve(3 * 33), plane(2 * 33);
  polhode_motion_summary(motion, summary.data());
  print("summary", summary);
  const double G = summary[1];
  print("curves", curves(17, [&](int k, double* rows) {
          return polhode_curve(moments, G, k < 2, k % 2 == 0 ? 1 : -1, std::numbers::pi / 2 * 0.5,
                               17, rows);
        }));
  print("separatrix", curves(9, [&](int k, double* rows) {
          return polhode_half_separatrix(moments, G, k % 2 == 0 ? 1 : -1, k < 2 ? 1 : -1, 9, rows);
        }));
  const uint32_t count = polhode_motion_curve(motion, 33, curve.data());
  curve.resize(3 * std::size_t{count});
  plane.resize(2 * std::size_t{count});
  polhode_andoyer_plane(curve.data(), count, plane.data());
  print("plane", plane);
  print("curve", curve, end);
}

void print_case(const polhode::io::GoldenCase& golden, bool is_last) {
  const polhode::Vec3& I = golden.moments;
  const polhode::Vec3& w = golden.omega0;
  const polhode::Quaternion& q = golden.q0;
  const Numbers moments{I.x, I.y, I.z}, q0{q.w, q.x, q.y, q.z}, omega{w.x, w.y, w.z};
  Numbers state(7), times, at, exact;
  polhode_state_of_rate(moments.data(), q0.data(), omega.data(), 0, state.data());
  polhode_motion* const motion = polhode_motion_of(moments.data(), state.data(), 0.0);
  for (const polhode::io::GoldenSample& s : golden.samples) {
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
  print_rows(motion, times);
  print_charts(motion, moments.data(), state.data());
  print_flips(motion);
  print_curves(motion, moments.data(), is_last ? "}\n" : "},\n");
  polhode_motion_release(motion);
}

}  // namespace

int main() {
  const std::vector<polhode::io::GoldenCase> cases = polhode::io::golden_cases();
  std::printf(
      "{\"instructions\": \"%s\",\n\"cases\": [\n",
      std::string(polhode::instruction_set_name(polhode::widest_instruction_set())).c_str());
  for (const polhode::io::GoldenCase& golden : cases) print_case(golden, &golden == &cases.back());
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
