// SPDX-License-Identifier: MIT
#include "terms/term_class.hpp"

#include <sstream>

namespace polhode::python {

namespace {

std::string name_of(const char* type, nb::handle name, nb::handle function) {
  if (nb::isinstance<nb::str>(name)) return nb::cast<std::string>(name);
  if (!name.is_none())
    throw nb::type_error(
        (std::string(type) + ": name: got " + class_name(name) + "; expected a str").c_str());
  if (function.is_valid() && nb::hasattr(function, "__name__"))
    return nb::cast<std::string>(nb::str(nb::object(function.attr("__name__"))));
  return type;
}

// Lines of at most 100 columns, all but the first indented.
std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string lines, line, word;
  while (words >> word) {
    if (!line.empty() && line.size() + 1 + word.size() > 100) {
      lines += line + "\n";
      line = "   ";
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + line;
}

}  // namespace

Making making(const char* type, nb::handle name, nb::handle function) {
  const std::string called = name_of(type, name, function);
  return {called, std::string(type) + " \"" + called + "\""};
}

std::string docstring(const char* summary, std::span<const std::pair<const char*, const char*>> of,
                      const char* notes) {
  std::string text = std::string(summary) + "\n\nParameters\n----------";
  for (const auto& [name, what] : of) text += "\n" + wrapped(std::string(name) + " : " + what);
  return notes[0] == '\0' ? text : text + "\n\n" + notes;
}

}  // namespace polhode::python
