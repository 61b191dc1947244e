// SPDX-License-Identifier: MIT
// EnsemblePlan: the table [ensemble] of a scenario, which wraps whatever the scenario describes:
// many runs of it, its members, with some of its numbers drawn.
//
// Equations   those of Draws (polhode/ensemble/draws.hpp). A direction of three keys is the unit
//             vector times the length that the file has; of two, its longitude in [0, a turn) and
//             its latitude.
// Units       every number in the unit that its key has in the file.
// Domain      1 to 1e12 members, as many as a table in order has rows; members from 0 on.
// Accuracy    that of Draws.
// Errors      none; what is no ensemble is refused when the file is read.
// Cost        that of Draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "polhode/ensemble/bins.hpp"
#include "polhode/ensemble/draws.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

enum class EnsembleKeep { statistics, final, rows };

// What one table [[ensemble.vary]] draws; all grids together are one.
struct EnsembleVaried {
  enum class Shape { numbers, vector, angles };
  std::string text;                // "normal, mean 263, sigma 6"
  std::vector<std::string> keys;   // of single numbers: "body.moments[1]"
  std::vector<std::string> units;  // of each, as outputs name it
  Shape shape = Shape::numbers;
  double scale = 1.0;  // the length of a vector; the unit of angles in radians
};

// What one table [[ensemble.fraction]] asks: low <= x < high, an angle modulo a turn where it has
// both bounds.
struct EnsembleFraction {
  std::string name;
  std::string column;  // of the rows of a member
  std::optional<double> low, high;
};

// Columns of the rows of a member that its run does not have
// (polhode/analysis/chaos_indicator.hpp).
enum class EnsembleIndicator { mean_megno, lyapunov };

// One table [[ensemble.histogram]].
struct EnsembleHistogram {
  struct Axis {
    std::string column;  // of the rows of a member, or a key that varies
    std::int64_t bins;
    std::optional<ensemble::Bounds> bounds;  // none: taken from the members
  };
  std::string name;
  std::vector<Axis> axes;  // one or two
  bool at_all_times;       // or at the last one alone
};

struct EnsemblePlan {
  std::int64_t size;
  std::uint64_t seed;
  ensemble::DrawSource source;
  EnsembleKeep keep;
  std::int64_t chunk;
  std::vector<double> quantiles;
  std::int64_t bins;
  std::vector<EnsembleFraction> fractions;
  std::vector<EnsembleIndicator> indicators;
  std::vector<EnsembleHistogram> histograms;
  std::vector<EnsembleVaried> varied;  // as the keys of `draws`
  ensemble::Draws draws;

  // Of all tables, one after the other.
  std::vector<std::string> keys() const;
  std::vector<std::string> units() const;
  // The numbers of a member at those keys.
  std::vector<double> numbers(std::int64_t member) const;
};

}  // namespace io
}  // namespace v0
}  // namespace polhode
