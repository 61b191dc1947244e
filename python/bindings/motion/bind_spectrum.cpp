// SPDX-License-Identifier: MIT
// Leading frequencies.
#include "interface/records.hpp"
#include "interface/signals.hpp"
#include "interface/value.hpp"
#include "polhode/analysis/spectrum.hpp"

namespace polhode::python {

namespace {

struct PythonSpectrum : Records<analysis::SpectralLine> {
  using Rows = Records<analysis::SpectralLine>;
  double mean;
  double residual;
  double size;
  double resolution;
};

// An array of NumPy itself, since others carry units or masks, or a list that begins so.
bool are_complex(const nb::object& values, const nb::module_& numpy) {
  if (values.type().is(numpy.attr("ndarray")))
    return nb::cast<std::string>(values.attr("dtype").attr("kind")) == "c";
  const bool is_list = PyList_Check(values.ptr()) != 0 || PyTuple_Check(values.ptr()) != 0;
  return is_list && nb::len(values) > 0 && PyComplex_Check(nb::object(values[0]).ptr()) != 0;
}

PythonSpectrum analysed(const ArrayLike& values, double interval, double start, int lines,
                        int window, double smallest) {
  const nb::module_ numpy = nb::module_::import_("numpy");
  const bool is_complex = are_complex(values, numpy);
  const analysis::SpectrumOptions options{lines == 0 ? std::nullopt : std::optional(lines), window,
                                          smallest};
  const Numbers real(is_complex ? nb::object(numpy.attr("real")(values)) : nb::object(values),
                     "values");
  if (real.shape().size() != 1)
    throw nb::value_error(
        ("values: got shape " + text_of(real.shape()) + "; expected (N,)").c_str());
  const std::size_t count = real.shape()[0];
  std::vector<double> x;
  for (std::size_t k = 0; k < count; ++k) x.push_back(real[k]);
  std::vector<std::complex<double>> z;
  if (is_complex) {
    const Numbers imaginary(nb::object(numpy.attr("imag")(values)), "values");
    for (std::size_t k = 0; k < count; ++k) z.emplace_back(x[k], imaginary[k]);
  }
  analysis::Spectrum found = [&] {
    const WithoutGil released;
    return is_complex ? analysis::spectrum(start, interval,
                                           std::span<const std::complex<double>>(z), options)
                      : analysis::spectrum(start, interval, std::span<const double>(x), options);
  }();
  if (const int close = analysis::unresolved(found); close > 0) {
    const std::string text = "spectrum: " + std::to_string(close) +
                             " lines are closer than 10 turns over the samples (" +
                             number_text(found.resolution) +
                             ") to another: see isolation; expected longer samples or fewer lines";
    if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw nb::python_error();
  }
  return {Records(std::move(found.lines)), found.mean, found.residual, found.size,
          found.resolution};
}

}  // namespace

void bind_spectrum(nb::module_& m) {
  using R = analysis::SpectralLine;
  using S = PythonSpectrum;
  nb::class_<S> c(m, "Spectrum", R"(The leading frequencies of evenly spaced samples.

Made by spectrum; columns (n,), the largest line first, are read-only views.)");
  def_records<R>(
      c,
      {{"frequency", [](const R& r) { return &r.frequency; }, "(n,): rad per unit of time."},
       {"amplitude", [](const R& r) { return &r.amplitude; }, "(n,): in the unit of the samples."},
       {"phase", [](const R& r) { return &r.phase; }, "(n,): at t = 0, rad, in (-pi, pi]."},
       {"frequency_error", [](const R& r) { return &r.frequency_error; },
        "(n,): what noise of the size of the residual would do to it."},
       {"amplitude_error", [](const R& r) { return &r.amplitude_error; }, "(n,): the same."},
       {"phase_error", [](const R& r) { return &r.phase_error; },
        "(n,): the same, at the middle of the samples."},
       {"isolation", [](const R& r) { return &r.isolation; },
        "(n,): how far the next line is, or of real samples its own mirror image."}});
  def_pickle(c, &S::mean, &S::residual, &S::size, &S::resolution);
  c.def_ro("mean", &S::mean, "Of real samples; 0 of complex ones, where it is a line.")
      .def_ro("residual", &S::residual, "Root mean square of what is left over.")
      .def_ro("size", &S::size, "Root mean square of the samples, of real ones about the mean.")
      .def_ro("resolution", &S::resolution,
              "10 turns over the samples: lines with less isolation are not free of each other.")
      .def("__repr__", [](const S& s) {
        return "<Spectrum: " + counted(s.rows().size(), "line") + ", residual " +
               number_text(s.residual) + ">";
      });
  m.def("spectrum", analysed, "values"_a, "interval"_a, "start"_a = 0.0, "lines"_a = 0,
        "window"_a = 1, "smallest"_a = 1e-10,
        R"(The leading frequencies of evenly spaced samples.

Laskar's frequency analysis, then all lines fitted together. Real values are a mean and a sum of
A cos(nu t + phi), complex ones a sum of A exp(i (nu t + phi)).

Parameters
----------
values : (N,), real or complex, finite; 8 or more.
interval : between two of them, positive.
start : the time of the first.
lines : how many at most; 0 stands for 20, or for as many as the samples allow.
window : order of Hann's, 0 to 5; a higher one keeps far lines apart better, and close ones worse.
smallest : lines below this fraction of the largest are left out.

Returns
-------
Spectrum
    With a RuntimeWarning for lines closer than 10 turns over the samples.

ValueError for values that are not finite or too few, and for arguments out of range. Releases the
GIL. (Laskar 1993))");
}

}  // namespace polhode::python
