// SPDX-License-Identifier: MIT
// The program `polhode`, for the command that a wheel installs (python/polhode/_command.py).
#include "polhode/cli/command_line.hpp"

#include "io/io_parts.hpp"

namespace polhode::python {

void bind_command_line(nb::module_& m) {
  m.def(
      "_command_line",
      [](const std::vector<nb::bytes>& words) {
        std::vector<const char*> argv;
        for (const nb::bytes& word : words) argv.push_back(word.c_str());
        argv.push_back(nullptr);
        const nb::gil_scoped_release released;
        return command_line(static_cast<int>(words.size()), argv.data());
      },
      "words"_a);
}

}  // namespace polhode::python
