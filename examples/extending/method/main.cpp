// SPDX-License-Identifier: MIT
// The program `polhode` with a kind of [method] of its own, "lie-midpoint".
#include <span>

#include "lie_midpoint.hpp"
#include "polhode/cli/command_line.hpp"

namespace {

using polhode::io::Dimension;
using polhode::io::KindKey;

struct Arguments {
  double step;
};

constexpr KindKey<Arguments> keys[] = {
    polhode::io::quantity_key<&Arguments::step>("step", Dimension::time, "The step.")
        .required()
        .example("0.01")
        .positive(),
};

polhode::Method made(const Arguments& a, const polhode::io::KeyValues&) {
  return polhode::custom_method({"lie-midpoint", a.step, lie_midpoint});
}

polhode::io::MethodKind lie_midpoint_kind() {
  return polhode::io::method_kind<Arguments>(
      "lie-midpoint", "The explicit midpoint rule on the rotation group.", keys, made,
      [](const polhode::Method&) -> std::vector<polhode::io::Citation> {
        return {{"author2026", "A. Author (2026). On midpoints. Journal of Examples 1, 3-4.",
                 "the midpoint rule"}};
      });
}

}  // namespace

int main(int argc, char** argv) {
  return polhode::command_line(argc, argv, polhode::io::default_kinds().with(lie_midpoint_kind()));
}
