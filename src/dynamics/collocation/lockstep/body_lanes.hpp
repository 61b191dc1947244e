// SPDX-License-Identifier: MIT
// The steps of several rotors, side by side: a lane for each body, a line of lanes for each stage.
#pragma once

#include <array>
#include <vector>

#include "dynamics/collocation/rotor_step.hpp"
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline constexpr std::size_t body_lanes = stage_lanes;

// One number of every body.
struct BodyLine : AlignedRow<body_lanes> {};

// What RotorStep and RotorConstants are for one body.
class BodyLanes {
 public:
  explicit BodyLanes(std::size_t stages)
      : stages_(stages), lines_(rows * stages), at_stages_(stages * stages) {}

  std::array<BodyLine, 7> y{}, carry{}, end{}, end_carry{};
  std::array<BodyLine, 3> half_inverse{}, half_inverse_rest{}, euler{}, moments{};
  BodyLine inverse_momentum{};
  BodyLine change{};  // by the first pass of the sweep made last
  bool has_rate = false;
  bool has_frame = false;

  std::size_t stages() const { return stages_; }
  // From one row to the next: a row is a line for each stage.
  std::size_t stride() const { return stages_ * body_lanes; }

  double* Y(std::size_t n) { return row(n); }
  double* v(std::size_t n) { return row(7 + n); }
  double* u(std::size_t n) { return row(10 + n); }
  double* F(std::size_t n) { return row(13 + n); }
  double* L(std::size_t n) { return row(20 + n); }
  // The effects that F was made of: u, then v.
  double* drive(std::size_t n) { return row(27 + n); }
  double* mu_S(std::size_t n) { return row(33 + n); }
  double* hb() { return row(36); }
  // The polynomial of the last step, and then the F of each body at its last sweep, and `drive`.
  double* kept(std::size_t n) { return row(37 + n); }
  double* kept_drive(std::size_t n) { return row(44 + n); }
  // A number of each body: what degree j of its last polynomial is worth at stage i.
  double* at_stages(std::size_t j, std::size_t i) { return at_stages_[j * stages_ + i].data(); }

 private:
  static constexpr std::size_t rows = 50;
  // The lines of a row as the plain numbers that they are.
  double* row(std::size_t n) {
    return static_cast<double*>(static_cast<void*>(lines_.data() + n * stages_));
  }

  std::size_t stages_;
  std::vector<BodyLine> lines_;
  std::vector<BodyLine> at_stages_;
};

// For each lane what RotorLanes do for one body, with the same bits.
struct BodyKernels {
  // Y from the polynomial of the last step.
  void (*place)(const GaussScheme&, BodyLanes&);
  // F from Y and the effects, and Y from F.
  void (*sweep)(const GaussScheme&, BodyLanes&);
  // F and `drive` of the bodies whose mark is not 0.
  void (*keep)(const BodyLine& mark, BodyLanes&);
  // The end of the step by what was kept, and its polynomials, in F and in `drive`.
  void (*finish)(const GaussScheme&, BodyLanes&);
};
BodyKernels body_kernels(std::size_t stages, InstructionSet set);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
