// SPDX-License-Identifier: MIT
// The monomials of a polynomial in `count` variables up to a degree, in ascending degree, and where
// their products are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

template <int count, int degree>
struct TaylorLayout {
  static_assert(count >= 1 && count <= 4 && degree >= 1 && degree <= 8);

  // Of degree n at most: binomial(count + n, count).
  static constexpr std::size_t size_to(int n) {
    if (n < 0) return 0;
    std::size_t product = 1;
    for (int k = 1; k <= count; ++k)
      product = product * static_cast<std::size_t>(n + k) / static_cast<std::size_t>(k);
    return product;
  }
  static constexpr std::size_t size = size_to(degree);

  using Exponents = std::array<int, static_cast<std::size_t>(count)>;
  std::array<Exponents, size> exponents{};
  std::array<int, size> order{};
  // Places of the products; those beyond the degree are 0 and not read.
  std::array<std::array<std::uint16_t, size>, size> product{};
  std::array<std::array<std::uint16_t, size>, static_cast<std::size_t>(count)> raised{};

  TaylorLayout() {
    std::size_t next = 0;
    for (int n = 0; n <= degree; ++n)
      for (int number = 0; number < all_numbers(); ++number) {
        const Exponents powers = digits(number);
        if (total(powers) != n) continue;
        exponents[next] = powers;
        order[next++] = n;
      }
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j) {
        if (order[i] + order[j] > degree) continue;
        product[i][j] = place(sum(exponents[i], exponents[j]));
      }
      for (std::size_t v = 0; v < static_cast<std::size_t>(count) && order[i] < degree; ++v) {
        Exponents unit{};
        unit[v] = 1;
        raised[v][i] = place(sum(exponents[i], unit));
      }
    }
  }

 private:
  // Rows of exponents as numbers with `count` digits.
  static constexpr int all_numbers() {
    int product = 1;
    for (int v = 0; v < count; ++v) product *= degree + 1;
    return product;
  }
  static Exponents digits(int number) {
    Exponents powers{};
    for (int& n : powers) {
      n = number % (degree + 1);
      number /= degree + 1;
    }
    return powers;
  }
  static int total(const Exponents& powers) {
    int sum = 0;
    for (const int n : powers) sum += n;
    return sum;
  }
  static Exponents sum(Exponents a, const Exponents& b) {
    for (std::size_t v = 0; v < a.size(); ++v) a[v] += b[v];
    return a;
  }
  std::uint16_t place(const Exponents& of) const {
    std::size_t i = 0;
    while (exponents[i] != of) ++i;
    return static_cast<std::uint16_t>(i);
  }
};

template <int count, int degree>
inline const TaylorLayout<count, degree> taylor_layout{};

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
