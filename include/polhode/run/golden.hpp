// SPDX-License-Identifier: MIT
// Golden cases: exact torque-free rotations over every regime, for the tests of other people's
// engines and simulators.
//
// Equations   those of FreeRotation, evaluated in double-double (src/run/golden.cpp).
// Units       any consistent set; angular velocities in radians per unit of time.
// Domain      moments and omega0 are doubles of few bits: each product I omega is exact, so that
//             the case is the same whether one starts from omega or from the momentum. q0 means
//             q0/|q0|.
// Accuracy    GoldenCase::bound holds for the printed decimals; tests/unit/run/golden_test.cpp
//             checks each against 76-digit integration.
// Errors      write_golden: DomainError for a folder that cannot be one, OutputError when writing
//             fails. PATH.part is renamed to PATH when it is complete.
// Cost        milliseconds for all.
#pragma once

#include <string>
#include <vector>

#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

struct GoldenSample {
  double t;
  Quaternion q;  // w >= 0
  Vec3 omega;    // body axes
};

struct GoldenCase {
  std::string name;
  std::string description;
  Regime regime;
  Vec3 moments;  // about the body axes, in any order
  Quaternion q0;
  Vec3 omega0;
  // |q - exact| for one of the two signs of q, and |omega - exact| / |omega|, of every sample as
  // printed with 17 digits and as the double nearest to that.
  double bound;
  std::vector<GoldenSample> samples;
};

std::vector<GoldenCase> golden_cases();

// "short_axis", the name of the enumerator.
std::string regime_name(Regime regime);

std::string golden_json(const std::vector<GoldenCase>& cases);
// One row per sample; each repeats its case, so that a row is a test of its own.
std::string golden_csv(const std::vector<GoldenCase>& cases);

// Writes golden.json and golden.csv into the folder, which is made if it is not there.
void write_golden(const std::string& folder, const std::vector<GoldenCase>& cases);

}  // namespace io
}  // namespace v0
}  // namespace polhode
