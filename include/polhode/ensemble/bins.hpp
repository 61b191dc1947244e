// SPDX-License-Identifier: MIT
// Bins: edges that numbers are counted between: even ones, ones of a fixed relative width, or any.
//
// Equations   edges e_0 < ... < e_n; bin k of n holds e_{k-1} <= x < e_k, the last one e_n too. 0
//             is what lies below e_0, n + 1 what lies above e_n. Logarithmic: e_{k+1} = e_k (1 +
//             a)/(1 - a), a the relative error of a number that is taken for the `middle` 2 e_k
//             e_{k+1}/(e_k + e_{k+1}) of its bin [masson2019].
// Units       those of the numbers.
// Domain      1 to 1e6 bins, finite edges. Copies share their edges.
// Accuracy    a number is compared with the edges themselves, so that its bin is exact; logarithmic
//             edges are products, the same on every machine.
// Errors      DomainError for edges that do not grow or are not finite, too many bins, a relative
//             error outside (0, 1), logarithmic edges of numbers that are not positive.
// Cost        benchmarks/statistics.cpp; 8 bytes an edge, shared.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

class Bins {
 public:
  static Bins linear(double lowest, double highest, int count);
  // Over the numbers given, as those of a first chunk, and `margin` of their range on either side;
  // those that are not finite are passed over. DomainError if none is left; one number alone gets a
  // range about itself.
  static Bins around(std::span<const double> numbers, double margin, int count);
  // From `smallest` to `largest` or just beyond.
  static Bins logarithmic(double relative_error, double smallest, double largest);
  // The same on either side of one bin from -smallest to smallest.
  static Bins signed_logarithmic(double relative_error, double smallest, double largest);
  static Bins of_edges(std::vector<double> edges);

  std::size_t count() const { return shared_->edges.size() - 1; }
  std::span<const double> edges() const { return shared_->edges; }
  // 0 to count() + 1; of NaN count() + 1.
  std::size_t index(double x) const;
  // What a number of bin 1 to count() is taken for.
  double middle(std::size_t bin) const;

  bool operator==(const Bins& other) const;

 private:
  enum class Widths { even, relative, any };
  struct Shared {
    std::vector<double> edges;
    Widths widths;
    double per_width;  // of even ones; of relative ones, of their logarithms
  };
  Bins(std::vector<double> edges, Widths widths);
  std::size_t near(double x) const;

  std::shared_ptr<const Shared> shared_;
};

}  // namespace v0
}  // namespace polhode
