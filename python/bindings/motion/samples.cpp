// SPDX-License-Identifier: MIT
#include "motion/samples.hpp"

#include <nanobind/ndarray.h>

namespace polhode::python {

SaveAt save_at_of(nb::handle samples, const char* name) {
  if (nb::isinstance<SaveAt>(samples)) return nb::cast<SaveAt>(samples);
  const Numbers times(samples, name);
  if (times.shape().size() != 1)
    throw nb::value_error((std::string(name) + ": got shape " + text_of(times.shape()) +
                           "; expected a SaveAt or times of shape (N,)")
                              .c_str());
  return SaveAt::times({times.at(0), times.at(0) + times.shape()[0]});
}

FloatArray view_of(const double* first, std::size_t n, std::size_t stride, const Shape& inner,
                   nb::handle owner) {
  Shape shape{n};
  shape.insert(shape.end(), inner.begin(), inner.end());
  std::vector<std::int64_t> strides(shape.size());
  std::int64_t step = 1;
  for (std::size_t i = shape.size(); i-- > 1;) {
    strides[i] = step;
    step *= static_cast<std::int64_t>(shape[i]);
  }
  strides[0] = static_cast<std::int64_t>(stride / sizeof(double));
  return nb::cast(nb::ndarray<nb::numpy, const double>(first, shape.size(), shape.data(), owner,
                                                       strides.data()));
}

std::string counted(std::size_t n, const char* what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

}  // namespace polhode::python
