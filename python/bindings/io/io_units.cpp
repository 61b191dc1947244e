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
Floats in_core(const io::Units& units, Typed<"numpy.typing.ArrayLike | str"> value,
               OneOf<io::Dimension> dimension, const std::optional<std::string>& unit) {
  const io::Dimension d = choice<io::Dimension>(dimension, "dimension");
  if (nb::isinstance<nb::str>(value)) {
    if (unit)
      throw nb::value_error("to_core: a text has its own unit; expected no unit in addition");
    const std::string text = nb::cast<std::string>(value);
    if (text.size() > most_text)
      throw nb::value_error("to_core: a text of more than 200 letters; expected one like \"3 h\"");
    const io::Quantity quantity = io::quantity_from_text(text);
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

Floats from_core(const io::Units& units, ArrayLike value, OneOf<io::Dimension> dimension) {
  const io::Dimension d = choice<io::Dimension>(dimension, "dimension");
  const Numbers numbers(value, "value");
  Result result(numbers.shape());
  for (std::size_t k = 0; k < size_of(numbers.shape()); ++k)
    *result.at(k) = units.from_core(numbers.at(0)[k], d);
  return result.take();
}

void bind_dimension(nb::module_& m) {
  nb::enum_<io::Dimension>(m, "Dimension", "What a number of a scenario measures.",
                           nb::is_arithmetic())
      .value("number", io::Dimension::number)
      .value("time", io::Dimension::time)
      .value("angle", io::Dimension::angle)
      .value("rate", io::Dimension::rate)
      .value("moment", io::Dimension::moment)
      .value("momentum", io::Dimension::momentum)
      .value("energy", io::Dimension::energy)
      .value("length", io::Dimension::length)
      .value("gm", io::Dimension::gm)
      .value("torque", io::Dimension::torque)
      .value("damping", io::Dimension::damping)
      .value("mass", io::Dimension::mass)
      .value("area", io::Dimension::area)
      .value("speed", io::Dimension::speed)
      .value("density", io::Dimension::density)
      .value("pressure", io::Dimension::pressure)
      .value("magnetic_field", io::Dimension::magnetic_field)
      .value("magnetic_moment", io::Dimension::magnetic_moment)
      .value("magnetic_tensor", io::Dimension::magnetic_tensor)
      .value("moment3", io::Dimension::moment3)
      .value("moment4", io::Dimension::moment4)
      .value("root_momentum", io::Dimension::root_momentum)
      .value("growth", io::Dimension::growth);
}

nb::tuple names_of_units(const io::Units& u) {
  return nb::make_tuple(u.time(), u.angle(), u.moment(), u.length());
}

void def_conversions(nb::class_<io::Units>& c) {
  c.def("to_core", in_core, "value"_a, "dimension"_a, "unit"_a = nb::none(),
        R"(Numbers in these units, in `unit`, or a text such as "27.38 h", as core numbers.

ValueError for an unknown unit, and for one of another dimension.)")
      .def("from_core", from_core, "value"_a, "dimension"_a,
           "Core numbers in these units: what outputs carry.")
      .def(
          "label",
          [](const io::Units& u, OneOf<io::Dimension> dimension) {
            return u.label(choice<io::Dimension>(dimension, "dimension"));
          },
          "dimension"_a,
          "How outputs name the unit of a dimension: \"deg/h\"; \"1\" for pure numbers.");
}

}  // namespace

void bind_units(nb::module_& m) {
  bind_dimension(m);
  nb::class_<io::Units> c(m, "Units",
                          R"(What the bare numbers of a scenario and of its outputs mean.

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
      .def_prop_ro("time", &io::Units::time, "The unit of time.")
      .def_prop_ro("angle", &io::Units::angle, "The unit of angles.")
      .def_prop_ro("moment", &io::Units::moment, "The unit of moments of inertia.")
      .def_prop_ro("length", &io::Units::length, "The unit of lengths.");
  def_conversions(c);
  def_value(c, names_of_units);
  c.def("__repr__", [](const io::Units& u) {
    return "Units(time=\"" + u.time() + "\", angle=\"" + u.angle() + "\", moment=\"" + u.moment() +
           "\", length=\"" + u.length() + "\")";
  });
  m.def(
      "known_units",
      [] {
        Typed<"dict[str, str]"> units{nb::dict()};
        for (const io::KnownUnit& unit : io::known_units())
          units[nb::str(unit.symbol.data(), unit.symbol.size())] =
              nb::str(unit.name.data(), unit.name.size());
        return units;
      },
      "The units that a scenario may use, with their names; products and powers of them too.");
}

}  // namespace polhode::python
