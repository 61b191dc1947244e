// SPDX-License-Identifier: MIT
// An output format of one's own, columns of fixed width, and a program that runs scenarios with it:
//
//     fixed-width scenario.toml rows.txt
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "polhode/output/output_format.hpp"
#include "polhode/run/scenario_run.hpp"

namespace {

// [output.fixed], as constant data. A key without a text does not compile.
struct Options {
  int digits = 9;
};
constexpr polhode::io::KindKey<Options> keys[] = {
    polhode::io::integer_key<&Options::digits>("digits", "Digits of each number.")
        .one_of("6|9|17")
        .otherwise("9"),
};

constexpr polhode::io::CommentStyle comments{"! "};

// Where the file is from, then the names of the columns.
std::string head(const std::vector<polhode::io::ColumnGroup>& groups,
                 const polhode::io::Provenance& provenance) {
  std::string text;
  polhode::io::append_origin(text, comments, provenance);
  for (const polhode::io::ColumnGroup& group : groups)
    for (const polhode::io::Column& column : group.columns)
      text += (text.ends_with('\n') ? "" : " ") + column.name;
  return text + "\n";
}

polhode::io::OutputFormat fixed_width() {
  polhode::io::OutputFormat format(
      "fixed", ".txt", "How the columns of --out PATH.txt are written.",
      [](const polhode::io::SinkRequest& request) {
        const int digits = request.options<Options>().digits;
        const auto row = [digits](std::string& out, std::span<const double> numbers) {
          char cell[48];
          for (const double number : numbers)
            out.append(cell, std::snprintf(cell, sizeof cell, "%*.*g", digits + 8, digits, number));
          out += '\n';
        };
        return polhode::io::text_sink(request, head(request.groups, request.provenance), row);
      });
  format.take_options<Options>(keys);
  format.difference = [](const std::string& path,
                         const std::vector<polhode::io::ColumnGroup>& groups,
                         const polhode::io::Provenance& provenance) {
    return polhode::io::text_difference(path, comments, head(groups, provenance));
  };
  return format;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) throw polhode::DomainError("expected fixed-width SCENARIO PATH");
  const polhode::io::Kinds kinds = polhode::io::default_kinds().with(fixed_width());
  const polhode::io::Scenario scenario = polhode::io::read_scenario(argv[1], kinds);
  polhode::io::ScenarioRun run(scenario, {{argv[2]}}, {.begin = polhode::io::RunBegin::resume});
  std::printf("%d rows in %s\n", static_cast<int>(run.run().rows), argv[2]);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
