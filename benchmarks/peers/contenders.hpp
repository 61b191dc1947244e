// SPDX-License-Identifier: MIT
// What the programs of `make bench-peers` compare: the free rotation of one body by somebody's
// formulas. Plain numbers, so that peers are compiled with their own flags and see nothing of
// polhode.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace peers {

struct Start {
  std::array<double, 3> I, g;  // principal moments, momentum in body axes; the attitude is 1
};

using Quad = std::array<double, 4>;

class Motion {
 public:
  Motion() = default;
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;
  virtual ~Motion() = default;
  // Numbers in a row: a quaternion or a matrix (rows; body to inertial), then the angular velocity.
  virtual std::size_t width() const { return 7; }
  virtual void rows(std::span<const double> t, double* out) const = 0;
};

struct Maker {
  std::string who;
  std::unique_ptr<Motion> (*make)(const Start&);
  // Prepared and asked once for each body: the sum of the numbers, so that nothing is left out.
  double (*fresh)(std::span<const Start>, double t);
  // Sadov's action over G; the conversion of a state to all six variables. nullptr: not offered.
  double (*action)(const Start&) = nullptr;
};

// nullptr where a library is not there.
Maker boost_maker();
Maker boost_double_maker();
Maker geographic_maker();
Maker van_zon_maker();
Maker polhode_maker();
// Of many times of a body alone; by all lanes, or by those of AVX2.
Maker polhode_lanes_maker();
Maker polhode_avx2_maker();
// Of new bodies alone.
Maker polhode_bodies_maker();
Maker polhode_short_arc_maker();
Maker polhode_grid_maker();   // of even times alone
Maker polhode_sadov_maker();  // of nothing else
// Sadov's action over G, of many states of a body at a time.
void polhode_actions(std::span<const Start> of_one_body, double* actions);

// The quaternion (0, of a row) relative to the attitude at t = 0, from the textbook form at 50
// digits.
class Exact {
 public:
  explicit Exact(const Start& start);
  ~Exact();
  // The largest component of the difference between this row's attitude and the exact one; rows of
  // each maker are relative to its own row at t = 0.
  double error(double t, std::span<const double> row, std::span<const double> row_at_0) const;
  double action() const;  // over G

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace peers
