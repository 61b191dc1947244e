// SPDX-License-Identifier: MIT
// The spin axes of many bodies on one orbit.
#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <utility>

#include "interface/arrays.hpp"
#include "interface/records.hpp"
#include "interface/signals.hpp"
#include "interface/value.hpp"
#include "motion/dynamics_values.hpp"
#include "polhode/error.hpp"
#include "polhode/secular/spin_precession.hpp"

namespace polhode::python {

namespace {

struct SpinHistories {
  FloatArray t;
  FloatArray s;
  Typed<"dict[int | tuple[int, ...], Outcome]"> failures;
  std::string method;
  FloatArray orbit;  // (M, 4): k, h, q, p at the times
};

// One number of every axis, in (..., M).
FloatArray numbers_of(const SpinHistories& of, double secular::SpinAngles::*member) {
  Numbers axes(of.s, "s", {3}), orbit(of.orbit, "orbit", {4});
  const Shape shape = axes.shape();
  axes.broadcast(shape);
  orbit.broadcast(shape);  // to the last axis, that of the times
  Result result(shape);
  for_each(size_of(shape), [&](std::size_t k) {
    const double *const s = axes.at(k), *const o = orbit.at(k);
    *result.at(k) = secular::spin_angles({{s[0], s[1], s[2]}}, {o[0], o[1], o[2], o[3]}).*member;
  });
  return result.take();
}

struct ManyRates {
  Shape shape;
  std::vector<secular::PrecessionRates> all;
};

ManyRates rates_of(nb::handle rates) {
  if (nb::isinstance<secular::PrecessionRates>(rates))
    return {{}, {nb::cast<secular::PrecessionRates>(rates)}};
  const bool list = PyList_Check(rates.ptr()) || PyTuple_Check(rates.ptr());
  if (list && nb::len(rates) == 0) return {{0}, {}};
  if (list && nb::isinstance<secular::PrecessionRates>(rates[0])) {
    ManyRates many{{nb::len(rates)}, {}};
    for (const nb::handle one : rates) {
      if (!nb::isinstance<secular::PrecessionRates>(one))
        throw nb::type_error(("rates: got a " + class_name(one) +
                              "; expected PrecessionRates (at index " +
                              std::to_string(many.all.size()) + ")")
                                 .c_str());
      many.all.push_back(nb::cast<secular::PrecessionRates>(one));
    }
    return many;
  }
  if (!nb::hasattr(rates, "__len__") && !nb::hasattr(rates, "__array__"))
    throw nb::type_error(("rates: got a " + class_name(rates) +
                          "; expected PrecessionRates, a list of them or numbers (..., 4)")
                             .c_str());
  Numbers numbers(rates, "rates", {4});
  ManyRates many{numbers.shape(), {}};
  numbers.broadcast(many.shape);
  for (std::size_t k = 0; k < size_of(many.shape); ++k) {
    const double* const x = numbers.at(k);
    many.all.push_back({x[0], x[1], x[2], x[3]});
  }
  return many;
}

// Where a body is among all: a number where they are in a row.
nb::object index_of(std::size_t k, const Shape& shape) {
  if (shape.size() == 1) return nb::int_(k);
  Shape index(shape.size());
  for (std::size_t i = shape.size(); i-- > 0; k /= shape[i]) index[i] = k % shape[i];
  return shape_tuple(index);
}

nb::dict failures_of(const std::vector<secular::LostSpin>& lost, const Shape& shape) {
  nb::dict failures;
  for (const secular::LostSpin& one : lost)
    failures[index_of(one.index, shape)] = nb::cast(one.outcome);
  if (lost.empty()) return failures;
  const std::string first = nb::cast<std::string>(nb::str(index_of(lost[0].index, shape)));
  warn_of(lost[0].outcome, ("spin_histories: index " + first + ", the first of " +
                            std::to_string(lost.size()) + " that failed")
                               .c_str());
  return failures;
}

secular::OrbitHistory history_of(
    const std::variant<secular::ElementTable, secular::ElementSeries>& orbit) {
  return std::visit([](const auto& of) { return secular::OrbitHistory(of); }, orbit);
}

void require_epoch(const secular::OrbitHistory& orbit, double epoch) {
  if (!(epoch >= orbit.first_time() && epoch <= orbit.last_time()))
    throw nb::value_error(
        ("epoch: got " + number_text(epoch) + "; expected one that the table covers, " +
         number_text(orbit.first_time()) + " to " + number_text(orbit.last_time()))
            .c_str());
}

SpinHistories histories(const std::variant<secular::ElementTable, secular::ElementSeries>& elements,
                        const Typed<"PrecessionRates | collections.abc.Sequence[PrecessionRates] | "
                                    "numpy.typing.ArrayLike">& rates,
                        const ArrayLike& poles,
                        const Typed<"SaveAt | numpy.typing.ArrayLike">& times,
                        const Typed<"Splitting">& method, double epoch) {
  const secular::OrbitHistory orbit = history_of(elements);
  require_epoch(orbit, epoch);
  const SaveAt at = save_at_of(times, "times");
  const Method by = method_of(method, "spin_histories");
  const auto* const splitting = std::get_if<Splitting>(&by);
  if (splitting == nullptr)
    throw nb::type_error(("method: got a " + class_name(method) + "; expected Splitting").c_str());
  const ManyRates of_rates = rates_of(rates);
  Numbers axes(poles, "poles", {3});
  const Shape shape = broadcast(of_rates.shape, axes.shape(), "rates", "poles");
  axes.broadcast(shape);
  const Lane rate_at(of_rates.shape, shape);
  std::vector<secular::SpinAxis> starts;
  std::vector<secular::PrecessionRates> each;
  for (std::size_t k = 0; k < size_of(shape); ++k) {
    const Vec3 pole{axes.at(k)[0], axes.at(k)[1], axes.at(k)[2]};
    // as spin_history takes it; what is no direction fails alone
    starts.push_back(norm(pole) > 0.0 ? secular::spin_axis(pole) : secular::SpinAxis{pole});
    each.push_back(of_rates.all[rate_at(k)]);
  }
  const auto rows = static_cast<std::size_t>(at.size());
  Shape whole = shape;
  whole.push_back(rows);
  Result axes_found(whole, {3}), asked({rows}), elements_found({rows}, {4});
  const std::span<secular::SpinAxis> results(reinterpret_cast<secular::SpinAxis*>(axes_found.at(0)),
                                             size_of(whole));
  const Progress look = signal_check();
  const std::vector<secular::LostSpin> lost = [&] {
    const WithoutGil released;
    return secular::spin_histories(orbit, each, starts, epoch, at, *splitting, results, look);
  }();
  for (std::size_t k = 0; k < rows; ++k) {
    const double time = at[static_cast<std::int64_t>(k)];
    const secular::OrbitElements o = orbit.at(time);
    *asked.at(k) = time;
    std::copy_n(std::array{o.k, o.h, o.q, o.p}.data(), 4, elements_found.at(k));
  }
  return {asked.take(), axes_found.take(), failures_of(lost, shape), method_text(by),
          elements_found.take()};
}

}  // namespace

void bind_spin_histories(nb::module_& m) {
  using H = SpinHistories;
  nb::class_<H> c(m, "SpinHistories", R"(The spin axes of many planets on one orbit, over ages.

Made by spin_histories, of bodies of a shape (...) at M times.)");
  c.def_ro("t", &H::t, "(M,): the times.")
      .def_ro("s", &H::s,
              "(..., M, 3): unit vectors along the spins, reference axes; NaN from where an axis "
              "failed.")
      .def_prop_ro(
          "obliquity", [](const H& h) { return numbers_of(h, &secular::SpinAngles::obliquity); },
          "(..., M): angles from the normal of the orbit, rad; computed when asked for.")
      .def_prop_ro(
          "precession", [](const H& h) { return numbers_of(h, &secular::SpinAngles::precession); },
          "(..., M): by how much the equinoxes have gone back in the orbit, rad, in (-pi, pi]; NaN "
          "at obliquity 0 and pi; computed when asked for.")
      .def_ro("failures", &H::failures,
              "By index, the Outcome of each axis that did not reach the last time.")
      .def_ro("method", &H::method, "In words.")
      .def("__repr__",
           [](const H& h) {
             const Shape shape = Numbers(h.s, "s", {3}).shape();
             return "<SpinHistories: " + text_of(shape) + " samples; " + h.method + ">";
           })
      .def("__getstate__",
           [](const H& h) { return nb::make_tuple(h.t, h.s, h.failures, h.method, h.orbit); })
      .def("__setstate__",
           [](H& h,
              const std::tuple<nb::object, nb::object, nb::dict, std::string, nb::object>& of) {
             new (&h) H{FloatArray(std::get<0>(of)), FloatArray(std::get<1>(of)), std::get<2>(of),
                        std::get<3>(of), FloatArray(std::get<4>(of))};
           });
  m.def("spin_histories", histories, "orbit"_a, "rates"_a, "poles"_a, "times"_a, "method"_a,
        "epoch"_a = 0.0,
        R"(The spin axes of many planets, or of clones of one, on one orbit that changes over ages.

Each is that of spin_history by the same Splitting, to the last bit. They are computed together in
the lanes of the processor, some twenty times as fast.

Parameters
----------
orbit : ElementTable or ElementSeries, along reference axes of any kind.
rates : PrecessionRates, a sequence of them, or numbers (..., 4): star, satellites, geodetic, drift.
poles : (..., 3), at the epoch, along the reference axes; their lengths do not matter.
times : SaveAt, or times (M,), away from the epoch in one direction.
method : Splitting; as Splitting(5, "order8") in kyr.
epoch : when the poles are where they are.

Returns
-------
SpinHistories
    Of the shape that rates and poles broadcast to. An axis that cannot go on, or never began, fails
    alone: it is NaN from there on and stands in `failures`, with a RuntimeWarning.

Times at the ends of steps cost nothing more; others a step each. Releases the GIL; Ctrl-C raises
KeyboardInterrupt. (Laskar and Robutel 1993; Touma and Wisdom 1993))");
}

}  // namespace polhode::python
