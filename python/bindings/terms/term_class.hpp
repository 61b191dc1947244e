// SPDX-License-Identifier: MIT
// The Python class of a kind of term, from rows of its arguments and a function that makes the term
// of them: constructor, signature, docstring, properties, and by its recipe equality, text and
// pickles.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "interface/value.hpp"
#include "polhode/scenario/perturbation_kind.hpp"
#include "polhode/text/key.hpp"
#include "polhode/text/key_values.hpp"
#include "terms/orbit_value.hpp"
#include "terms/term_value.hpp"

namespace polhode::python {

// What a term is being made with, next to its arguments.
struct Making {
  std::string type;   // GravityGradient
  std::string name;   // of the term
  std::string label;  // GravityGradient "moon"
  std::vector<SharedFunction> functions = {};
};

struct TermArgument {
  std::string name;
  std::string type;            // in the signature
  std::string help;            // in the docstring
  std::string otherwise = {};  // what stands for it, as Python; empty: it is required
  std::string shown = {};      // type of its property; empty: none
  // Its key of files: "number", "angle", "rate" or "orbit"; empty: it is none.
  std::string key = {};
};

// The terms, and the arguments as they are kept: plain numbers and tuples, which compare and hash.
struct MadeTerm {
  std::vector<AnyPerturbation> parts;
  nb::tuple arguments;
};

struct TermClass {
  std::string name;
  std::string kind = {};  // in files; empty: they have none
  std::string summary;
  std::string notes = {};
  std::vector<TermArgument> arguments;  // the required ones first
  // Given None for what is left out. nb::next_overload for an argument of another type.
  std::function<MadeTerm(Making&, std::span<const nb::object>)> made;
  nb::handle type = {};  // Python's class
};

void add_term_class(nb::module_& m, TermClass of);
// For a kind that Python registers: Python makes its class from this (polhode.kinds), and sets its
// type with _set_term_type. Returns (number, name, signature, docstring, names of the arguments).
nb::tuple add_registered_class(TermClass of);
// Null where no class is of this kind of files.
const TermClass* class_of_kind(std::string_view kind);

// Stands in messages: of the function, or of the class, where it is left out.
TermArgument name_argument();

// The class of a kind that Python registers.
TermClass class_of_registered(io::PerturbationKind kind);
// The classes of the kinds of the library.
void bind_kind_terms(nb::module_& m);
// Values that terms are described by.
void bind_term_values(nb::module_& m);

// The value of a key as Python has it: numbers, tuples of them, words. `orbit` gives that of a
// name.
nb::object python_value(const io::Key& key, const io::KeyValue& value,
                        const std::function<nb::object(const std::string&)>& orbit);

}  // namespace polhode::python
