// SPDX-License-Identifier: MIT
#include <optional>

#include "interface/arrays.hpp"
#include "interface/choice.hpp"
#include "interface/value.hpp"
#include "io/io_parts.hpp"
#include "polhode/text/units.hpp"

namespace polhode::python {

namespace {

constexpr std::size_t most_text = 200;

// Numbers of any shape, or a text such as "27.38 h".
Floats in_core(const Units& units, Typed<"numpy.typing.ArrayLike | str"> value,
               OneOf<Dimension> dimension, const std::optional<std::string>& unit) {
  const Dimension d = choice<Dimension>(dimension, "dimension");
  if (nb::isinstance<nb::str>(value)) {
    if (unit)
      throw nb::value_error("to_core: a text has its own unit; expected no unit in addition");
    const std::string text = nb::cast<std::string>(value);
    if (text.size() > most_text)
      throw nb::value_error("to_core: a text of more than 200 letters; expected one like \"3 h\"");
    const Quantity quantity = quantity_from_text(text);
    return nb::float_(units.to_core(quantity.value, quantity.unit, d));
  }
  const Numbers numbers(value, "value");
  Result result(numbers.shape());
  // with the GIL: the library behind units is not thread-safe
  for (std::size_t k = 0; k < size_of(numbers.shape()); ++k)
    *result.at(k) =
        unit ? units.to_core(numbers.at(0)[k], *unit, d) : units.to_core(numbers.at(0)[k], d);
  return result.take();
}

Floats from_core(const Units& units, ArrayLike value, OneOf<Dimension> dimension) {
  const Dimension d = choice<Dimension>(dimension, "dimension");
  const Numbers numbers(value, "value");
  Result result(numbers.shape());
  for (std::size_t k = 0; k < size_of(numbers.shape()); ++k)
    *result.at(k) = units.from_core(numbers.at(0)[k], d);
  return result.take();
}

void bind_dimension(nb::module_& m) {
  nb::enum_<Dimension>(m, "Dimension", "What a number of a scenario measures.", nb::is_arithmetic())
      .value("number", Dimension::number)
      .value("time", Dimension::time)
      .value("angle", Dimension::angle)
      .value("rate", Dimension::rate)
      .value("moment", Dimension::moment)
      .value("momentum", Dimension::momentum)
      .value("energy", Dimension::energy)
      .value("length", Dimension::length)
      .value("gm", Dimension::gm)
      .value("torque", Dimension::torque)
      .value("damping", Dimension::damping)
      .value("mass", Dimension::mass)
      .value("area", Dimension::area)
      .value("speed", Dimension::speed)
      .value("density", Dimension::density)
      .value("pressure", Dimension::pressure)
      .value("magnetic_field", Dimension::magnetic_field)
      .value("magnetic_moment", Dimension::magnetic_moment)
      .value("magnetic_tensor", Dimension::magnetic_tensor)
      .value("moment3", Dimension::moment3)
      .value("moment4", Dimension::moment4)
      .value("root_momentum", Dimension::root_momentum)
      .value("growth", Dimension::growth);
}

nb::tuple names_of_units(const Units& u) {
  return nb::make_tuple(u.time(), u.angle(), u.moment(), u.length());
}

void def_conversions(nb::class_<Units>& c) {
  c.def("to_core", in_core, "value"_a, "dimension"_a, "unit"_a = nb::none(),
        R"(Numbers in these units, in `unit`, or a text such as "27.38 h", as core numbers.

ValueError for an unknown unit, and for one of another dimension.)")
      .def("from_core", from_core, "value"_a, "dimension"_a,
           "Core numbers in these units: what outputs carry.")
      .def(
          "label",
          [](const Units& u, OneOf<Dimension> dimension) {
            return u.label(choice<Dimension>(dimension, "dimension"));
          },
          "dimension"_a,
          "How outputs name the unit of a dimension: \"deg/h\"; \"1\" for pure numbers.");
}

}  // namespace

void bind_units(nb::module_& m) {
  bind_dimension(m);
  nb::class_<Units> c(m, "Units", R"(What the bare numbers of a scenario and of its outputs mean.

Parameters
----------
time : a unit of time such as "s", "h", "d".
angle : "rad", "deg", ...; angular rates are in angle per time, momenta always count radians.
moment : "1" (scale-free) or a unit of moment of inertia such as "kg m2".
length : "1" (scale-free) or a unit of length such as "km".

The library itself has no units: its numbers ("core") are in radians and in the units of time,
moment and length that the caller means. known_units() lists the units.)");
  c.def(nb::init<const std::string&, const std::string&, const std::string&, const std::string&>(),
        "time"_a = "s", "angle"_a = "rad", "moment"_a = "1", "length"_a = "1")
      .def_prop_ro("time", &Units::time, "The unit of time.")
      .def_prop_ro("angle", &Units::angle, "The unit of angles.")
      .def_prop_ro("moment", &Units::moment, "The unit of moments of inertia.")
      .def_prop_ro("length", &Units::length, "The unit of lengths.");
  def_conversions(c);
  def_value(c, names_of_units);
  c.def("__repr__", [](const Units& u) {
    return "Units(time=\"" + u.time() + "\", angle=\"" + u.angle() + "\", moment=\"" + u.moment() +
           "\", length=\"" + u.length() + "\")";
  });
  m.def(
      "known_units",
      [] {
        Typed<"dict[str, str]"> units{nb::dict()};
        for (const KnownUnit& unit : known_units())
          units[nb::str(unit.symbol.data(), unit.symbol.size())] =
              nb::str(unit.name.data(), unit.name.size());
        return units;
      },
      "The units that a scenario may use, with their names; products and powers of them too.");
}

}  // namespace polhode::python
