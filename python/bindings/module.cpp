// SPDX-License-Identifier: MIT
// polhode._core: every layer of the C++ library, in the order in which they build on each other.
#include "bindings.hpp"
#include "fit/bind_fit.hpp"
#include "interface/gil.hpp"
#include "polhode/error.hpp"
#include "polhode/version.hpp"

namespace polhode::python {

namespace {

void bind_everything(nb::module_& m) {
  m.doc() = "Rotation of rigid bodies; import polhode, which re-exports all of this.";
  m.attr("__version__") = version();
  nb::exception<DomainError>(m, "DomainError", PyExc_ValueError).attr("__doc__") =
      "An argument outside the domain of a function: names it, its value and the requirement.";
  bind_numbers(m);
  bind_math(m);
  bind_elliptic(m);
  bind_rotor(m);
  bind_free(m);
  bind_generating(m);
  bind_orbit(m);
  bind_frame(m);
  bind_shape(m);
  bind_perturb(m);
  bind_user_terms(m);
  bind_damper(m);
  bind_system(m);
  bind_trajectory(m);
  bind_dynamics(m);
  bind_many(m);
  bind_satellite(m);
  bind_analysis(m);
  bind_section(m);
  bind_planet_data(m);
  bind_secular(m);
  bind_spin_histories(m);
  bind_spectrum(m);
  bind_series(m);
  bind_lie_transform(m);
  bind_normal_form(m);
  bind_io(m);
  bind_fit(m);
}

// The module that holds what is bound; let go of at exit, before Python looks for leaks.
PyObject* first = nullptr;

void keep_until_exit(nb::module_& m) {
  first = m.inc_ref().ptr();
  nb::module_::import_("atexit").attr("register")(nb::cpp_function([] {
    // a daemon thread in the midst of a run never lets go of what it runs: that is no leak
    if (WithoutGil::threads() > 0) nb::set_leak_warnings(false);
    Py_CLEAR(first);
  }));
}

// A C++ type can be bound once in a process. Who imports the package again (coverage tools,
// notebooks that clear sys.modules) gets what is bound already.
void import_again(nb::module_& m) {
  const nb::object names = nb::handle(first).attr("__dict__").attr("copy")();
  for (const char* own : {"__name__", "__spec__", "__loader__", "__package__", "__file__"})
    names.attr("pop")(own, nb::none());
  m.attr("__dict__").attr("update")(names);
  nb::set_leak_warnings(false);  // of two modules, one is torn down too late for its report
}

}  // namespace

}  // namespace polhode::python

NB_MODULE(_core, m) {
  using namespace polhode::python;
  if (first != nullptr) return import_again(m);
  bind_everything(m);
  keep_until_exit(m);
}
