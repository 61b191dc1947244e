// SPDX-License-Identifier: MIT
#include "interface/recipe.hpp"

#include "interface/value.hpp"

namespace polhode::python {

Any Recipe::argument(std::size_t i) const {
  return is_known() ? nb::object(arguments[i]) : nb::none();
}

Typed<"dict[str, typing.Any]"> Recipe::by_name() const {
  Typed<"dict[str, typing.Any]"> all{nb::dict()};
  for (std::size_t i = 0; i < names.size(); ++i) all[names[i]] = argument(i);
  return all;
}

int Recipe::traverse(visitproc visit, void* arg) const {
  Py_VISIT(arguments.ptr());
  for (const SharedFunction& function : functions)
    if (const int stop = function->traverse(visit, arg); stop != 0) return stop;
  return 0;
}

void Recipe::clear() {
  arguments.reset();
  for (const SharedFunction& function : functions) function->clear();
}

Recipe recipe_of(const char* method, std::initializer_list<const char*> names, nb::object arguments,
                 std::vector<SharedFunction> functions) {
  return {method, names, std::move(arguments), std::move(functions)};
}

nb::object reduced(nb::handle self, const Recipe& recipe) {
  if (!recipe.is_known())
    throw nb::type_error(("a " + class_name(self) +
                          " that comes from a scenario cannot be pickled: pickle the scenario")
                             .c_str());
  return remade(self, recipe.arguments, recipe.method);
}

std::string repr_of(nb::handle self, const Recipe& recipe, const std::string& otherwise) {
  std::string text = class_name(self);
  if (!recipe.is_known()) return "<" + text + ": " + otherwise + ">";
  if (recipe.method[0] != '\0') text += std::string(".") + recipe.method;
  std::string inside;
  for (std::size_t i = 0; i < recipe.names.size(); ++i) {
    const nb::object value = recipe.argument(i);
    if (value.is_none()) continue;
    inside += (inside.empty() ? "" : ", ") + std::string(recipe.names[i]) + "=";
    inside += repr_text(value);
  }
  return text + "(" + inside + ")";
}

bool same_recipe(const Recipe& a, const Recipe& b) {
  if (!a.is_known() || !b.is_known()) return false;
  return std::string(a.method) == b.method && a.arguments.equal(b.arguments);
}

nb::object hash_of(const Recipe& recipe) {
  if (!recipe.is_known()) return nb::int_(0);
  return nb::int_(nb::hash(nb::make_tuple(nb::str(recipe.method), recipe.arguments)));
}

}  // namespace polhode::python
