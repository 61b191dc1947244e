// SPDX-License-Identifier: MIT
// Elliptic integrals and functions over arrays: polhode._core._elliptic, which polhode/elliptic.py
// wraps with names and docstrings.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "interface/arrays.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/elliptic/legendre_pi.hpp"
#include "polhode/elliptic/modulus.hpp"

namespace polhode::python {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// The arguments of a function, in order, by name.
std::vector<Numbers> numbers(std::initializer_list<std::pair<nb::handle, const char*>> all) {
  std::vector<Numbers> read;
  read.reserve(all.size());
  for (const auto& [value, name] : all) read.emplace_back(value, name);
  return read;
}

// f(at, put's out) at every position of the shape that the arguments broadcast to.
template <class F>
nb::object mapped(std::vector<Numbers> all, std::initializer_list<std::size_t> inner, F f) {
  const Shape shape = broadcast(all);
  Result result(shape, inner);
  for_each(size_of(shape), [&](std::size_t k) { f(all, k, result.at(k)); });
  return result.take();
}

template <class F>
nb::object plain(std::vector<Numbers> all, F f) {
  return mapped(std::move(all), {}, [&](const std::vector<Numbers>& x, std::size_t k, double* out) {
    *out = f([&](std::size_t i) { return x[i][k]; });
  });
}

// The last argument is m, or m and m1; f(x, modulus, out) writes `count` numbers, NaN where the
// modulus is not finite.
template <class F>
nb::object with_modulus(std::vector<Numbers> all, nb::handle m, nb::handle m1,
                        std::initializer_list<std::size_t> inner, std::size_t count, F f) {
  all.emplace_back(m, "m");
  const std::size_t at = all.size() - 1;
  const bool has_m1 = !m1.is_none();
  if (has_m1) all.emplace_back(m1, "m1");
  return mapped(std::move(all), inner,
                [&](const std::vector<Numbers>& x, std::size_t k, double* out) {
                  const double m_k = x[at][k];
                  const double m1_k = has_m1 ? x[at + 1][k] : 1.0 - m_k;
                  if (std::isfinite(m_k) && std::isfinite(m1_k)) {
                    f([&](std::size_t i) { return x[i][k]; },
                      elliptic::Modulus::from_any_pair(m_k, m1_k), out);
                  } else {
                    std::fill_n(out, count, nan);
                  }
                });
}

// A function of the modulus alone, or of one or two numbers and the modulus.
template <class F>
void bind_of_modulus(nb::module_& e, const char* name, F f) {
  e.def(
      name,
      [f](nb::handle m, nb::handle m1) {
        return with_modulus(
            {}, m, m1, {}, 1,
            [&](auto&&, const elliptic::Modulus& mod, double* out) { *out = f(mod); });
      },
      "m"_a, "m1"_a.none());
}
template <class F>
void bind_of_one(nb::module_& e, const char* name, const char* first, F f) {
  e.def(
      name,
      [f, first](nb::handle a, nb::handle m, nb::handle m1) {
        return with_modulus(
            numbers({{a, first}}), m, m1, {}, 1,
            [&](auto&& x, const elliptic::Modulus& mod, double* out) { *out = f(x(0), mod); });
      },
      nb::arg(first), "m"_a, "m1"_a.none());
}

void bind_carlson(nb::module_& e) {
  e.def("carlson_rf", [](nb::handle x, nb::handle y, nb::handle z) {
    return plain(numbers({{x, "x"}, {y, "y"}, {z, "z"}}),
                 [](auto&& a) { return elliptic::carlson_rf(a(0), a(1), a(2)); });
  });
  e.def("carlson_rc", [](nb::handle x, nb::handle y) {
    return plain(numbers({{x, "x"}, {y, "y"}}),
                 [](auto&& a) { return elliptic::carlson_rc(a(0), a(1)); });
  });
  e.def("carlson_rd", [](nb::handle x, nb::handle y, nb::handle z) {
    return plain(numbers({{x, "x"}, {y, "y"}, {z, "z"}}),
                 [](auto&& a) { return elliptic::carlson_rd(a(0), a(1), a(2)); });
  });
  e.def("carlson_rj", [](nb::handle x, nb::handle y, nb::handle z, nb::handle p) {
    return plain(numbers({{x, "x"}, {y, "y"}, {z, "z"}, {p, "p"}}),
                 [](auto&& a) { return elliptic::carlson_rj(a(0), a(1), a(2), a(3)); });
  });
  e.def("agm", [](nb::handle a, nb::handle b) {
    return plain(numbers({{a, "a"}, {b, "b"}}), [](auto&& x) { return elliptic::agm(x(0), x(1)); });
  });
  e.def("cel", [](nb::handle kc, nb::handle p, nb::handle a, nb::handle b) {
    return plain(numbers({{kc, "kc"}, {p, "p"}, {a, "a"}, {b, "b"}}),
                 [](auto&& x) { return elliptic::cel(x(0), x(1), x(2), x(3)); });
  });
}

void bind_complete(nb::module_& e) {
  bind_of_modulus(e, "complete_k",
                  [](const elliptic::Modulus& mod) { return elliptic::complete_k(mod); });
  bind_of_modulus(e, "complete_e",
                  [](const elliptic::Modulus& mod) { return elliptic::complete_e(mod); });
  bind_of_modulus(e, "complete_b",
                  [](const elliptic::Modulus& mod) { return elliptic::complete_b(mod); });
  bind_of_modulus(e, "complete_d",
                  [](const elliptic::Modulus& mod) { return elliptic::complete_d(mod); });
  bind_of_modulus(e, "nome", [](const elliptic::Modulus& mod) { return elliptic::nome(mod); });
  bind_of_modulus(e, "complementary_nome",
                  [](const elliptic::Modulus& mod) { return elliptic::complementary_nome(mod); });
  bind_of_one(e, "complete_pi", "n",
              [](double n, const elliptic::Modulus& mod) { return elliptic::complete_pi(n, mod); });
  bind_of_one(e, "heuman_lambda0", "psi", [](double psi, const elliptic::Modulus& mod) {
    return elliptic::heuman_lambda0(psi, mod);
  });
}

// Room for the arguments of one call of the lanes, where they do not lie side by side already.
constexpr std::size_t arguments_together = 512;
using SomeArguments = std::array<double, arguments_together>;

// Numbers k, k + 1, ...: where they lie, or those of a number that stands for all.
const double* side_by_side(const Numbers& x, std::size_t k, SomeArguments& room) {
  if (x.at(1) != x.at(0)) return x.at(k);
  room.fill(x[k]);
  return room.data();
}

// sn, cn and dn of an argument by itself, and of arrays in lanes.
nb::tuple jacobi_of_arrays(nb::handle u, nb::handle m, nb::handle m1) {
  std::vector<Numbers> x = numbers({{u, "u"}, {m, "m"}});
  if (!m1.is_none()) x.emplace_back(m1, "m1");
  const Shape shape = broadcast(x);
  Result sn(shape), cn(shape), dn(shape);
  const auto write = [&](std::size_t begin, std::size_t end) {
    SomeArguments of_u, of_m, of_m1;
    for (std::size_t k = begin; k < end; k += arguments_together) {
      const std::size_t count = std::min(arguments_together, end - k);
      const auto all = [count](const double* from) { return std::span(from, count); };
      const double* const parameters = side_by_side(x[1], k, of_m);
      for (std::size_t i = 0; x.size() == 2 && i < count; ++i) of_m1[i] = 1.0 - parameters[i];
      const double* const complements = x.size() == 2 ? of_m1.data() : side_by_side(x[2], k, of_m1);
      elliptic::jacobi(
          all(side_by_side(x[0], k, of_u)), all(parameters), all(complements),
          elliptic::JacobiSpans{{sn.at(k), count}, {cn.at(k), count}, {dn.at(k), count}});
    }
  };
  if (shape.empty()) {
    const double m_0 = x[1][0], m1_0 = x.size() == 3 ? x[2][0] : 1.0 - m_0;
    elliptic::Jacobi<double> j{nan, nan, nan};
    if (std::isfinite(m_0) && std::isfinite(m1_0))
      j = elliptic::jacobi(x[0][0], elliptic::Modulus::from_any_pair(m_0, m1_0));
    return nb::make_tuple(j.sn, j.cn, j.dn);
  }
  for_each_part(size_of(shape), write);
  return nb::make_tuple(sn.take(), cn.take(), dn.take());
}

void bind_incomplete(nb::module_& e) {
  const auto bind = [&](const char* name, auto f) { bind_of_one(e, name, "phi", f); };
  bind("legendre_f",
       [](double phi, const elliptic::Modulus& mod) { return elliptic::legendre_f(phi, mod); });
  bind("legendre_e",
       [](double phi, const elliptic::Modulus& mod) { return elliptic::legendre_e(phi, mod); });
  bind("legendre_d",
       [](double phi, const elliptic::Modulus& mod) { return elliptic::legendre_d(phi, mod); });
  bind("legendre_b",
       [](double phi, const elliptic::Modulus& mod) { return elliptic::legendre_b(phi, mod); });
  bind("jacobi_zeta",
       [](double phi, const elliptic::Modulus& mod) { return elliptic::jacobi_zeta(phi, mod); });
  bind_of_one(e, "amplitude", "u",
              [](double u, const elliptic::Modulus& mod) { return elliptic::amplitude(u, mod); });
  e.def(
      "legendre_pi",
      [](nb::handle phi, nb::handle n, nb::handle m, nb::handle m1) {
        return with_modulus(numbers({{phi, "phi"}, {n, "n"}}), m, m1, {}, 1,
                            [](auto&& x, const elliptic::Modulus& mod, double* out) {
                              *out = elliptic::legendre_pi(x(0), x(1), mod);
                            });
      },
      "phi"_a, "n"_a, "m"_a, "m1"_a.none());
  e.def("jacobi", &jacobi_of_arrays, "u"_a, "m"_a, "m1"_a.none());
}

}  // namespace

void bind_elliptic(nb::module_& m) {
  nb::module_ e = m.def_submodule("_elliptic");
  bind_carlson(e);
  bind_complete(e);
  bind_incomplete(e);
}

}  // namespace polhode::python
