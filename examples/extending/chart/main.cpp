// SPDX-License-Identifier: MIT
// spherical FROM TO < states.csv: `polhode convert` with one chart more. spherical: rows of a
// motion.
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "polhode/output/columns.hpp"
#include "polhode/tables/convert.hpp"
#include "spherical.hpp"

int main(int count, char** words) try {
  const auto charts = polhode::with_chart(polhode::default_charts(), spherical::chart);
  if (count == 3) {
    convert(
        {words[1], words[2], polhode::Body(1.0, 2.0, 2.5)}, "stdin",
        [](std::span<char> buffer) {
          std::cin.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
          return static_cast<std::size_t>(std::cin.gcount());
        },
        [](std::string_view bytes) { std::cout << bytes; }, charts);
    return 0;
  }
  const polhode::FreeRotation motion(polhode::Body(1.0, 2.0, 2.5),
                                     {{0.5, 0.5, 0.5, 0.5}, {0.1, 0.4, 2.0}});
  const std::vector<std::string> groups = {"spherical"};
  const polhode::RowLayout rows(groups, polhode::Units("s", "deg"), polhode::Branch::in_notes,
                                charts);
  for (const polhode::Column& column : rows.groups().back().columns)
    std::printf("%s [%s]\n", column.name.c_str(), column.unit.c_str());
  const std::vector<double> times = {0.0, 1.0};
  std::vector<double> numbers(times.size() * rows.width());
  rows.write_rows(motion, times, numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    std::printf("%.4f%s", numbers[i], (i + 1) % rows.width() == 0 ? "\n" : " ");
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 2;
}
