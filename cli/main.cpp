// SPDX-License-Identifier: MIT
#include "polhode/cli/command_line.hpp"

int main(int argc, char** argv) { return polhode::command_line(argc, argv); }
