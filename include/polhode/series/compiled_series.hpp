// SPDX-License-Identifier: MIT
// A series in doubles, made flat for evaluation at many points.
//
// Equations   a^n by products of a or of 1/a, cos and sin of k phi by turning on by phi, each
//             once a point; then one product of cosines and sines a combination of angles, one
//             product of powers a monomial, and one product a term. Points have the variables
//             themselves; powers of those with a value (symbols.hpp) are taken of displacements.
// Units       those of the symbols; angles in radians.
// Domain      finite points; a = 0 with a negative exponent gives an infinity or NaN.
// Accuracy    rounding: of sum |C a^n| times some (|n| + |k| + number of symbols) eps, and eps
//             times the size of the angle. A point has the same bits alone and among others.
// Errors      DomainError for points that are not rows of all variables and angles.
// Cost        some ns a term and point (benchmarks/series.cpp). Terms, powers and combinations are
//             stored; evaluation makes one scratch array a call.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {
namespace series {

class CompiledSeries {
 public:
  explicit CompiledSeries(const Series<double>& series);

  // How many numbers a point has: the variables, then the angles, in the order of the symbols.
  std::size_t dimension() const { return variables_.size() + angles_.size(); }
  std::size_t size() const { return terms_.size(); }

  double at(std::span<const double> point) const;
  // Of points one after the other: dimension() numbers each.
  std::vector<double> at_each(std::span<const double> points) const;

 private:
  // Table entries of one symbol: powers or multiples from `least` to `largest`, 0 among them.
  struct Range {
    int least = 0, largest = 0;
    std::size_t start = 0;
    double origin = 0.0;  // of powers
  };
  // A product of table entries: factors_[first] up to factors_[last].
  struct Product {
    std::size_t first, last;
  };
  struct FlatTerm {
    double c;
    std::size_t wave;  // place of its cosine or sine
  };
  // Terms with one monomial: terms_[first] up to terms_[last].
  struct Group {
    Product monomial;
    std::size_t first, last;
  };

  Product monomial_of(const Symbols& symbols, const TermKey& key);
  Product wave_of(const Symbols& symbols, const TermKey& key);

  template <std::size_t lanes>
  void evaluate(const double* points, double* scratch, double* values) const;
  template <std::size_t lanes>
  void fill_powers(const double* points, double* scratch) const;
  template <std::size_t lanes>
  void fill_waves(const double* points, double* scratch) const;

  std::vector<Range> variables_, angles_;
  std::vector<std::size_t> factors_;
  std::vector<Product> waves_;
  std::vector<Group> groups_;
  std::vector<FlatTerm> terms_;
  std::size_t wave_start_ = 0, scratch_ = 0;
};

}  // namespace series
}  // namespace v0
}  // namespace polhode
