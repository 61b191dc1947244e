// SPDX-License-Identifier: MIT
// How far attitudes are from the textbook form at 50 digits, for contenders of other languages.
// Arguments: three moments and three components of the momentum in body axes, the attitude at t = 0
// being 1. Lines of standard input: a time and the seven numbers of a row, the first for t = 0.
// Prints the largest error.
#include <array>
#include <cstdio>
#include <cstdlib>

#include "contenders.hpp"
#include "worst.hpp"

namespace {

bool read(std::array<double, 8>& numbers) {
  for (double& x : numbers)
    if (std::scanf("%lf", &x) != 1) return false;
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 7) return 2;
  peers::Start start{};
  for (std::size_t k = 0; k < 3; ++k) {
    start.I[k] = std::strtod(argv[1 + k], nullptr);
    start.g[k] = std::strtod(argv[4 + k], nullptr);
  }
  const peers::Exact exact(start);
  std::array<double, 8> first{}, row{};
  if (!read(first)) return 2;
  polhode::test::Worst worst;
  while (read(row)) worst.add(exact.error(row[0], {&row[1], 7}, {&first[1], 7}));
  std::printf("%.3g\n", worst.value());
}
