// SPDX-License-Identifier: MIT
// Values of series at points.
#include "polhode/series/compiled_series.hpp"

#include <algorithm>

#include "series/series_value.hpp"

namespace polhode::python {

namespace {

// A series made flat, and which of its symbols, the variables first, are in a term of it.
class PythonCompiled {
 public:
  explicit PythonCompiled(const PythonSeries& a) : PythonCompiled(a.doubles()) {}
  explicit PythonCompiled(const series::Series<double>& a) : symbols_(a.symbols()), flat_(a) {
    names_ = symbols_.variables();
    names_.insert(names_.end(), symbols_.angles().begin(), symbols_.angles().end());
    is_used_.resize(names_.size());
    const auto variables = static_cast<int>(symbols_.variables().size());
    for (const auto& term : a.terms())
      for (int i = 0; i < static_cast<int>(names_.size()); ++i)
        if ((i < variables ? series::exponent(symbols_, term.key, i)
                           : series::multiplier(symbols_, term.key, i - variables)) != 0)
          is_used_[static_cast<std::size_t>(i)] = 1;
  }
  const series::Symbols& symbols() const { return symbols_; }
  std::size_t size() const { return flat_.size(); }

  FloatArray at(const ArrayLike& points) const {
    const Numbers in(points, "points", {flat_.dimension()});
    return values(in.shape(), [&](std::size_t k, double* point) {
      std::copy_n(in.at(k), flat_.dimension(), point);
    });
  }
  FloatArray call(const nb::kwargs& given) const {
    const std::vector<nb::object> objects = in_order(given);
    std::vector<Numbers> in;
    for (std::size_t i = 0; i < names_.size(); ++i) in.emplace_back(objects[i], names_[i].c_str());
    const Shape shape = broadcast(in);
    return values(shape, [&](std::size_t k, double* point) {
      for (const Numbers& numbers : in) *point++ = numbers[k];
    });
  }

 private:
  static constexpr std::size_t together = 64;  // points

  // An object for every symbol; 0 for one that is not given and not needed.
  std::vector<nb::object> in_order(const nb::kwargs& given) const {
    std::vector<nb::object> objects;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (given.contains(names_[i].c_str()))
        objects.emplace_back(given[names_[i].c_str()]);
      else if (is_used_[i])
        throw DomainError("Series: no value of " + names_[i] + ", which it has; give one as " +
                          names_[i] + "=...");
      else
        objects.emplace_back(nb::float_(0.0));
    }
    for (const auto& [name, value] : given)
      if (const auto text = nb::cast<std::string>(name);
          !symbols_.has_variable(text) && !symbols_.has_angle(text))
        throw DomainError("Series: " + text + " is none of: " + symbols_.names());
    return objects;
  }

  template <class Fill>
  FloatArray values(const Shape& shape, Fill fill) const {
    Result result(shape);
    const std::size_t size = python::size_of(shape), width = flat_.dimension();
    for_each((size + together - 1) / together, [&](std::size_t block) {
      const std::size_t first = block * together, count = std::min(together, size - first);
      std::vector<double> points(count * width);
      for (std::size_t k = 0; k < count; ++k) fill(first + k, points.data() + k * width);
      const std::vector<double> found = flat_.at_each(points);
      std::copy(found.begin(), found.end(), result.at(first));
    });
    return result.take();
  }

  series::Symbols symbols_;
  series::CompiledSeries flat_;
  std::vector<std::string> names_;
  std::vector<char> is_used_;
};

}  // namespace

FloatArray value_of(const PythonSeries& a, const nb::kwargs& at) {
  return PythonCompiled(a).call(at);
}

void bind_compiled_series(nb::module_& m) {
  using C = PythonCompiled;
  nb::class_<C>(m, "CompiledSeries", R"(A series in floats, made flat for values at many points.

Parameters
----------
series : Series.)")
      .def(
          "__init__", [](C* self, const PythonSeries& series) { new (self) C(series); }, "series"_a)
      .def_prop_ro("symbols", &C::symbols, "Those of the series.")
      .def("__len__", &C::size)
      .def("at", &C::at, "points"_a,
           nb::sig("def at(self, points: numpy.typing.ArrayLike) -> float | "
                   "numpy.typing.NDArray[numpy.float64]"),
           R"((...): the values at points (..., n): the variables, then the angles, in the order of
the symbols. The same bits for a point alone and among others. Releases the GIL.)")
      .def("__call__", &C::call,
           nb::sig("def __call__(self, **values: numpy.typing.ArrayLike) -> float | "
                   "numpy.typing.NDArray[numpy.float64]"),
           "As Series has it: the value of each symbol by its name.");
}

}  // namespace polhode::python
