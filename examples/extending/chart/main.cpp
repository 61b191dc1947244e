// SPDX-License-Identifier: MIT
// The program `polhode` with a chart of its own, "spherical".
#include "polhode/cli/command_line.hpp"
#include "spherical.hpp"

int main(int argc, char** argv) {
  return polhode::command_line(argc, argv, polhode::io::default_kinds().with(spherical::chart));
}
