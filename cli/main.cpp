// SPDX-License-Identifier: MIT
#include "commands.hpp"

int main(int argc, char** argv) { return polhode::cli::command_line(argc, argv); }
