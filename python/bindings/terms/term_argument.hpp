// SPDX-License-Identifier: MIT
// The arguments of terms: how each kind of them comes from Python, what is kept of it, and what a
// property shows.
#pragma once

#include <optional>
#include <type_traits>
#include <utility>

#include "interface/value.hpp"

namespace polhode::python {

// How an argument of type M comes from Python, what is kept of it in the recipe, and what a
// property shows of that: numbers as Carried does, objects as they were given.
template <class M>
struct Taken : Carried<M> {
  using Shown = decltype(Carried<M>::shown(std::declval<M>()));
  static nb::object kept(const M& x) { return Carried<M>::argument(x); }
  static nb::object show(const nb::object& kept) {
    if constexpr (std::is_same_v<typename Carried<M>::In, ArrayLike>)
      return Carried<M>::shown(Carried<M>::read(kept, ""));
    else
      return kept;
  }
};
// An object of Python, which the one who makes the term looks into.
template <class M>
  requires std::is_base_of_v<nb::object, M>
struct Taken<M> {
  using In = M;
  using Shown = M;
  static M read(const M& x, const char*) { return x; }
  static nb::object kept(const M& x) { return x; }
  static nb::object show(const nb::object& kept) { return kept; }
};
// A value of a class of ours.
template <class M>
  requires(std::is_same_v<typename Carried<M>::In, M> &&
           nb::detail::is_base_caster_v<nb::detail::make_caster<M>>)
struct Taken<M> {
  using In = nb::handle_t<M>;
  using Shown = nb::handle_t<M>;
  static In read(In x, const char*) { return x; }
  static nb::object kept(In x) { return nb::borrow(x); }
  static nb::object show(const nb::object& kept) { return kept; }
};

// A member of an enum, its name, or None.
template <class E>
  requires std::is_enum_v<E>
struct Taken<std::optional<E>> {
  using In = OneOf<E>;
  using Shown = std::optional<E>;
  static Shown read(nb::handle x, const char* name) {
    return x.is_none() ? Shown() : choice<E>(x, name);
  }
  static nb::object kept(const Shown& x) { return x ? nb::cast(*x) : nb::none(); }
  static nb::object show(const nb::object& kept) { return kept; }
};

// Numbers of any shape; kept as tuples.
struct Table {
  FloatArray numbers;
};
template <>
struct Taken<Table> {
  using In = ArrayLike;
  using Shown = FloatArray;
  static Table read(nb::handle x, const char* name) { return {real_array(x, name)}; }
  static nb::object kept(const Table& x);
  static FloatArray show(nb::handle kept) { return real_array(kept, ""); }
};

// One number, or a diagonal (3,).
struct Diagonal {
  Vec3 all;
  bool is_one;
};
template <>
struct Taken<Diagonal> {
  using In = ArrayLike;
  using Shown = Typed<"float | tuple[float, float, float]">;
  static Diagonal read(nb::handle x, const char* name);
  static nb::object kept(const Diagonal& x) {
    return x.is_one ? nb::object(nb::float_(x.all.x)) : nb::object(tuple_of(x.all));
  }
  static nb::object show(const nb::object& kept) { return kept; }
};

// One number, a diagonal (3,) or a matrix (3, 3), along the principal axes.
struct Tensor {
  Mat3 matrix;
  bool is_full;
};
Tensor tensor_of(nb::handle value, const char* name);
template <>
struct Taken<Tensor> {
  using In = ArrayLike;
  using Shown = FloatArray;
  static Tensor read(nb::handle x, const char* name) { return tensor_of(x, name); }
  static nb::object kept(const Tensor& x);
  static FloatArray show(nb::handle kept) { return array_of(tensor_of(kept, "").matrix); }
};

// The name of a term in messages: the one given, or that of the function, or of the class.
struct TermName {};
template <>
struct Taken<TermName> {
  using In = Text;
  using Shown = Text;
  static TermName read(nb::handle, const char*) { return {}; }
};

// An object that signatures call as they call a T.
template <class T>
class As : public nb::object {
 public:
  static constexpr auto Name = nb::detail::make_caster<T>::Name;
  As(nb::handle any, nb::detail::borrow_t) : nb::object(any, nb::detail::borrow_t{}) {}
  As(nb::handle any, nb::detail::steal_t) : nb::object(any, nb::detail::steal_t{}) {}
  static bool check_(nb::handle) { return true; }
};

template <class M, class Default = Required>
struct Argument {
  using Member = M;
  const char* name;
  const char* text;  // what it is, for the docstring
  Default otherwise = {};
  bool has_property = true;

  Argument without_property() const {
    Argument other = *this;
    other.has_property = false;
    return other;
  }
};
template <class M>
Argument<M> argument(const char* name, const char* text = "") {
  return {name, text};
}
template <class M, class Default>
Argument<M, Default> argument(const char* name, const char* text, Default otherwise) {
  return {name, text, otherwise};
}
inline Argument<TermName, nb::none> term_name() {
  return {"name", "stands in messages.", nb::none()};
}

}  // namespace polhode::python
