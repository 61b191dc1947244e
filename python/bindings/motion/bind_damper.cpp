// SPDX-License-Identifier: MIT
// KaneDamper, and a system at one rate of its own.
#include "interface/arrays.hpp"
#include "interface/value.hpp"
#include "motion/system_value.hpp"
#include "polhode/perturb/kane_damper.hpp"
#include "polhode/system/system.hpp"

namespace polhode::python {

namespace {

using K = KaneDamper;

Vec3 vector_at(const Numbers& numbers, std::size_t k) {
  const double* x = numbers.at(k);
  return {x[0], x[1], x[2]};
}

// f(vectors ...) of arrays (..., 3) that broadcast.
template <std::size_t N, class F>
FloatArray of_vectors(Numbers (&in)[N], bool vector, F f) {
  const Shape shape = broadcast(in);
  Result out = vector ? Result(shape, {3}) : Result(shape);
  for_each(size_of(shape), [&](std::size_t k) { f(k, out.at(k)); });
  return out.take();
}

void def_functions(nb::class_<K>& c) {
  c.def(
       "rate_of_body",
       [](const K& damper, const Body& body, ArrayLike rate) {
         Numbers in[] = {Numbers(rate, "rate", {3})};
         return of_vectors(in, true, [&](std::size_t k, double* out) {
           put(out, damper.rate_of_body(body, vector_at(in[0], k)));
         });
       },
       "body"_a, "rate"_a,
       "(..., 3): what body and sphere turn with in addition to I^-1 g, v = -J I^-1 rate.")
      .def(
          "energy",
          [](const K& damper, const Body& body, ArrayLike rate) -> Floats {
            Numbers in[] = {Numbers(rate, "rate", {3})};
            return of_vectors(in, false, [&](std::size_t k, double* out) {
              put(out, damper.energy(body, vector_at(in[0], k)));
            });
          },
          "body"_a, "rate"_a,
          "The kinetic energy in addition to (1/2) g . I^-1 g: (1/2) J rate . (1 - J/I) rate.")
      .def(
          "acceleration",
          [](const K& damper, const Body& body, ArrayLike g, ArrayLike dg, ArrayLike rate) {
            Numbers in[] = {Numbers(g, "g", {3}), Numbers(dg, "dg", {3}),
                            Numbers(rate, "rate", {3})};
            return of_vectors(in, true, [&](std::size_t k, double* out) {
              put(out, damper.acceleration(body, vector_at(in[0], k), vector_at(in[1], k),
                                           vector_at(in[2], k)));
            });
          },
          "body"_a, "g"_a, "dg"_a, "rate"_a,
          "(..., 3): the change of `rate` in time at the momentum g, which changes by dg.")
      .def(
          "momentum",
          [](const K& damper, const Body& body, ArrayLike g, ArrayLike rate) {
            Numbers in[] = {Numbers(g, "g", {3}), Numbers(rate, "rate", {3})};
            return of_vectors(in, true, [&](std::size_t k, double* out) {
              put(out, damper.momentum(body, vector_at(in[0], k), vector_at(in[1], k)));
            });
          },
          "body"_a, "g"_a, "rate"_a,
          "(..., 3): angular momentum of the sphere about its centre, of the g of both.")
      .def(
          "relative_rate",
          [](const K& damper, const Body& body, ArrayLike g, ArrayLike momentum) {
            Numbers in[] = {Numbers(g, "g", {3}), Numbers(momentum, "momentum", {3})};
            return of_vectors(in, true, [&](std::size_t k, double* out) {
              put(out, damper.relative_rate(body, vector_at(in[0], k), vector_at(in[1], k)));
            });
          },
          "body"_a, "g"_a, "momentum"_a,
          "(..., 3): the rate at which the sphere has this momentum.");
}

}  // namespace

void bind_damper(nb::module_& m) {
  auto c = bind_made_value<K>(
      m, "KaneDamper",
      R"(A sphere in a cavity of the body, held by friction alone: Kane and Barba (1966).

A system has one at most: System(..., damper=KaneDamper(moment, friction)). It is no term, since it
has a state of its own, the rate s of the sphere relative to the body (body axes): Problem takes
damper_rate at the start, a Trajectory has damper_rate at its samples. Adaptive and
Collocation integrate it.

With g all of the momentum and I the moments of body and sphere together the body turns with
w = I^-1 (g - J s), and (1 - J/I) ds/dt = s x w - (c/J) s - I^-1 dg/dt. The energy falls by
c |s|^2. Where c/J is large the motion is that under InternalDamping(J**2 / c / I**2).

Parameters
----------
moment : J, of the sphere.
friction : c, torque per rate.

ValueError for a moment that is not positive or a friction that is negative; System refuses a
moment that leaves no body next to it.)",
      [](double moment, double friction) { return K(moment, friction); },
      field("moment", &K::moment, "J, of the sphere."),
      field("friction", &K::friction, "c, torque per rate."));
  def_functions(c);
  m.def(
      "at_damper_rate",
      [](const PythonSystem& system, ArrayLike rate) {
        return PythonSystem(at_damper_rate(system, vec3(rate, "rate")), system);
      },
      "system"_a, "rate"_a,
      R"(The system at one rate (3,) of its damper, for functions of a state.

It has no damper of its own; a term has the v and the energy that the damper has at that rate.
angular_velocity, energy, effect and the others refuse a system with a damper, whose rate they do
not know. Trajectory.columns finds it by itself. ValueError for a rate of a system without a damper
that is not zero.)");
}

}  // namespace polhode::python
