// SPDX-License-Identifier: MIT
#include "terms/term_argument.hpp"

namespace polhode::python {

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

}  // namespace polhode::python
