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

nb::object Taken<Table>::kept(const Table& x) {
  nb::list rows;
  for (const nb::handle row : x.numbers.attr("tolist")())
    rows.append(nb::isinstance<nb::list>(row) ? nb::object(nb::tuple(row)) : nb::borrow(row));
  return nb::tuple(rows);
}

Diagonal Taken<Diagonal>::read(nb::handle x, const char* name) {
  const Numbers any(x, name);
  if (any.shape().empty()) return {{any[0], any[0], any[0]}, true};
  return {vec3(x, name), false};
}

Tensor tensor_of(nb::handle value, const char* name) {
  const Numbers any(value, name);
  const Shape& shape = any.shape();
  if (shape == Shape{3, 3}) return {mat3(value, name), true};
  if (!shape.empty() && shape != Shape{3})
    throw nb::value_error(
        (std::string(name) + ": got shape " + text_of(shape) + "; expected (), (3,) or (3, 3)")
            .c_str());
  const Vec3 d = shape.empty() ? Vec3{any[0], any[0], any[0]} : vec3(value, name);
  return {{{{d.x, 0.0, 0.0}, {0.0, d.y, 0.0}, {0.0, 0.0, d.z}}}, false};
}

nb::object Taken<Tensor>::kept(const Tensor& x) {
  if (x.is_full) return rows_of(x.matrix);
  return tuple_of({x.matrix(0, 0), x.matrix(1, 1), x.matrix(2, 2)});
}

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
