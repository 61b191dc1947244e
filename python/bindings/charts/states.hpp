// SPDX-License-Identifier: MIT
// The Python class of a chart, made from a table of its fields: constructor with broadcasting,
// fields as floats or read-only views, NumPy indexing, equality, pickling, repr.
#pragma once

#include <nanobind/ndarray.h>

#include <array>
#include <cstring>
#include <functional>
#include <memory>
#include <string>

#include "charts/dual_state.hpp"
#include "interface/batch.hpp"
#include "interface/choice.hpp"
#include "polhode/error.hpp"

namespace polhode::python {

// What a field is made of.
enum class Kind { real, vector, quaternion, integer };

struct Field {
  const char* name;
  const char* text;    // what it is, with its unit
  std::size_t offset;  // in the C++ struct
  Kind kind = Kind::real;
  // integer: what one of them is in Python: an enum's member, or nullptr for int.
  nb::object (*member)(int) = nullptr;
  const char* annotation = nullptr;  // of that type
  int standard = 0;                  // the default of an integer field
  // integer: the value of an enum's member given by its name; nullptr for int.
  int (*named)(nb::handle, const char*) = nullptr;
};

template <class E>
nb::object member_of(int value) {
  return nb::cast(static_cast<E>(value));
}
template <class E>
int value_named(nb::handle word, const char* field) {
  return static_cast<int>(choice<E>(word, field));
}
template <class E>
constexpr Field enum_field(const char* name, const char* text, std::size_t offset,
                           const char* annotation, int standard = 0) {
  return {name, text, offset, Kind::integer, member_of<E>, annotation, standard, value_named<E>};
}

// The table of a chart. `required` fields come first; the others have defaults.
template <class S, std::size_t N>
struct Chart {
  const char* name;
  const char* doc;
  std::array<Field, N> fields;
  // The state as it is kept, or DomainError.
  S (*checked)(const S&);
  // True when Duals may be passed; the result is then a DualState.
  bool takes_duals = false;
};

// The parts that do not depend on the chart (states.cpp).
struct StateMemory {
  const Shape& shape;
  const std::byte* first;
  std::size_t stride;
  // Of arrays that look at the states. Not the Python object, which may hold more.
  const std::shared_ptr<const void>& owner;
};
nb::object field_of(const StateMemory& states, const Field& field);
nb::object table_of(const StateMemory& states, std::size_t columns);
// What __array__ returns of it.
nb::object as_asked(const nb::object& table, nb::handle dtype, nb::handle copy);
// Elements as opaque items, for NumPy to index; and where the items of such an array lie.
nb::object items_of(const StateMemory& states, std::size_t item);
struct Items {
  nb::object array;
  const std::byte* first;
  std::size_t stride;
  Shape shape;
};
Items memory_of(nb::handle items, std::size_t item);
std::string repr_of(const char* name, const StateMemory& states, std::span<const Field> fields);
std::string field_signature(const Field& field);
Numbers numbers_for(const Field& field, nb::handle value);
// A field of n states, `stride` bytes apart.
void store(const Field& field, const Numbers& from, std::size_t n, std::byte* states,
           std::size_t stride);
// DomainError that starts with `what` and shows the number that is not finite.
void require_finite(const char* what, std::initializer_list<double> values);
std::string index_text(std::size_t k, const Shape& shape);
std::shared_ptr<const void> kept_alive(nb::object object);

// A class method that returns the class, whatever it is given.
nb::object class_itself();

template <class S>
StateMemory memory(const Batch<S>& states) {
  return {states.shape(), states.first(), states.stride(), states.owner()};
}

template <class S, std::size_t N>
Batch<S> states_from(const Chart<S, N>& chart, std::array<nb::handle, N> values) {
  std::vector<Numbers> numbers;
  numbers.reserve(N);
  for (std::size_t i = 0; i < N; ++i) numbers.push_back(numbers_for(chart.fields[i], values[i]));
  const Shape shape = broadcast(numbers);
  return Batch<S>::filled(shape, [&](S* out) {
    const std::size_t n = size_of(shape);
    std::uninitialized_fill_n(out, n, S{});
    for (std::size_t i = 0; i < N; ++i)  // field by field: a strided copy each
      store(chart.fields[i], numbers[i], n, reinterpret_cast<std::byte*>(out), sizeof(S));
    for_each(n, [&](std::size_t k) {
      try {
        out[k] = chart.checked(out[k]);
      } catch (const DomainError& e) {
        if (shape.empty()) throw;
        throw DomainError(e.what() + index_text(k, shape));
      }
    });
  });
}

// Items that NumPy made of those of `whole`: views onto the same memory, or copies.
template <class S>
Batch<S> part_of(const Batch<S>& whole, nb::handle of_numpy) {
  const Items items = memory_of(of_numpy, sizeof(S));
  const std::less<> before;  // a total order of pointers
  const bool inside = !before(items.first, whole.first()) &&
                      before(items.first, whole.first() + whole.size() * whole.stride());
  return Batch<S>(items.shape, inside ? whole.owner() : kept_alive(items.array), items.first,
                  items.stride);
}

template <class S>
bool same_states(const Batch<S>& a, const Batch<S>& b) {
  if (a.shape() != b.shape()) return false;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (!(a[k] == b[k])) return false;
  return true;
}

namespace detail {

template <std::size_t I>
using Value = ArrayLike;

template <class S, std::size_t N, std::size_t R, std::size_t... Required, std::size_t... Optional>
void def_init(nb::class_<Batch<S>>& c, const Chart<S, N>& chart, std::index_sequence<Required...>,
              std::index_sequence<Optional...>) {
  c.def(
      "__init__",
      [table = &chart](Batch<S>* self, Value<Required>... required, Value<Optional>... optional) {
        new (self)
            Batch<S>(states_from(*table, std::array<nb::handle, N>{required..., optional...}));
      },
      nb::arg(chart.fields[Required].name)...,
      (nb::arg(chart.fields[R + Optional].name) = chart.fields[R + Optional].standard)...);
}

}  // namespace detail

// R: how many fields are required.
template <std::size_t R, class S, std::size_t N>
nb::class_<Batch<S>> bind_states(nb::module_& m, const Chart<S, N>& chart) {
  using B = Batch<S>;
  using Self = nb::handle_t<B>;
  const Chart<S, N>* const table = &chart;  // static: it outlives the class
  const auto states = [](nb::handle self) -> const B& { return nb::cast<const B&>(self); };
  nb::class_<B> c(m, chart.name, chart.doc);
  // RotorState[float], in annotations: the stub says what of (python/generic_stub.py).
  c.attr("__class_getitem__") = class_itself();
  detail::def_init<S, N, R>(c, chart, std::make_index_sequence<R>{},
                            std::make_index_sequence<N - R>{});
  if (chart.takes_duals) {
    c.def_static("__new__", [table](nb::handle type, const nb::args& args,
                                    const nb::kwargs& named) {
      nb::object made = dual_state_of(table->name, table->fields, args, named);
      if (made.is_valid()) return made;
      const nb::handle own = nb::type<Batch<S>>();
      if (PyType_Check(type.ptr()) == 0 ||
          PyType_IsSubtype(reinterpret_cast<PyTypeObject*>(type.ptr()),
                           reinterpret_cast<PyTypeObject*>(own.ptr())) == 0)
        throw nb::type_error(
            (std::string(table->name) + ".__new__: expected the class or one derived from it")
                .c_str());
      made = nb::inst_alloc(type);
      // For its own classes nanobind calls only __new__; for their subclasses Python calls
      // __init__ as well.
      const bool unpickles = args.size() == 1 && PyBytes_Check(nb::handle(args[0]).ptr()) != 0 &&
                             nb::len(nb::handle(args[0])) == 0;  // of __getnewargs__
      if (type.is(own) && !unpickles) type.attr("__init__")(made, *args, **named);
      return made;
    });
    c.def("__getnewargs__", [](Self) { return nb::make_tuple(nb::bytes("", 0)); });
  }
  bool all_real = true;
  for (const Field& field : chart.fields) {
    all_real = all_real && field.kind == Kind::real;
    c.def_prop_ro(
        field.name, [field, states](Self self) { return field_of(memory(states(self)), field); },
        nb::for_getter(nb::sig(field_signature(field).c_str())), field.text);
  }
  c.def_prop_ro(
      "shape", [](const B& s) { return shape_tuple(s.shape()); },
      "Shape of the array of states; () for one.");
  c.def_prop_ro(
      "ndim", [](const B& s) { return s.shape().size(); }, "Number of its axes.");
  c.def_prop_ro(
      "size", [](const B& s) { return s.size(); }, "Number of states.");
  c.def("__len__", [table](const B& s) {
    if (s.shape().empty())
      throw nb::type_error((std::string("one ") + table->name + " has no len()").c_str());
    return s.shape()[0];
  });
  c.def(
      "__getitem__",
      [states](Self self, nb::handle key) {
        const B& whole = states(self);
        return part_of(whole, nb::object(items_of(memory(whole), sizeof(S))[key]));
      },
      "key"_a,
      nb::sig((std::string("def __getitem__(self, key: object) -> ") + chart.name).c_str()));
  c.def("__iter__", [table, states](Self self) {
    if (states(self).shape().empty())
      throw nb::type_error((std::string("one ") + table->name + " is not iterable").c_str());
    return nb::steal(PySeqIter_New(self.ptr()));
  });
  c.def(
      "reshape",
      [states](Self self,
               const Typed<"typing.SupportsIndex | collections.abc.Iterable[typing.SupportsIndex]">&
                   shape) {
        const B& whole = states(self);
        return part_of(whole, items_of(memory(whole), sizeof(S)).attr("reshape")(shape));
      },
      "shape"_a, "The same states in another shape, as numpy.reshape.");
  c.def(
      "__eq__", [](const B& a, const B& b) { return same_states(a, b); }, nb::is_operator(),
      "other"_a);
  c.attr("__hash__") = nb::none();
  c.def("__repr__", [table](const B& s) { return repr_of(table->name, memory(s), table->fields); });
  c.def("__copy__", [](const B& s) { return s; });
  c.def(
      "__deepcopy__", [](const B& s, nb::handle) { return s; }, "memo"_a);
  c.def("__getstate__", [states](Self self) {
    const nb::object items = items_of(memory(states(self)), sizeof(S));
    return nb::make_tuple(items.attr("shape"), items.attr("tobytes")());
  });
  c.def("__setstate__", [](B& s, const std::tuple<Shape, nb::bytes>& state) {
    const auto& [shape, bytes] = state;
    if (!is_size_of(shape, bytes.size() / sizeof(S)) || bytes.size() % sizeof(S) != 0)
      throw nb::value_error("this pickle is of another version or machine");
    new (&s) B(B::filled(shape, [&](S* out) { std::memcpy(out, bytes.data(), bytes.size()); }));
  });
  if (all_real) {
    c.def(
        "__array__",
        [states](Self self, nb::handle dtype, nb::handle copy) {
          return as_asked(table_of(memory(states(self)), N), dtype, copy);
        },
        "dtype"_a = nb::none(), "copy"_a = nb::none());
  }
  return c;
}

}  // namespace polhode::python
