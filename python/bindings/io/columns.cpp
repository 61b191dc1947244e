// SPDX-License-Identifier: MIT
#include "io/columns.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>

#include "polhode/error.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/scenario/kinds.hpp"

namespace polhode::python {

namespace {

// Those of polhode.kinds.register too.
io::ColumnKinds known_columns() {
  const nb::object kinds = nb::module_::import_("polhode._toml").attr("known_kinds")();
  return nb::cast<const io::Kinds&>(kinds).columns();
}

// The tensor's axes are those of files; here everything is along principal axes, as in the states.
System along_principal_axes(const System& system) {
  const Vec3& I = system.body().moments();
  return System(Body(I.x, I.y, I.z), system.frame(), system.terms(), system.damper());
}

// All columns of a group, or the one asked for.
class Part {
 public:
  Part(const std::string& name, const io::ColumnKinds& known, const System& system,
       double initial_energy)
      : origin_{system, initial_energy} {
    if (known.group(name) != nullptr) {
      layout_.emplace(std::vector<std::string>{name}, io::Units(), io::Branch::in_columns, known);
      for (const io::Column& column : layout_->groups().at(1).columns)
        names_.push_back(column.name);
      row_.resize(layout_->width());
    } else {
      one_ = io::scalar_column(name, system, initial_energy, known).value;
      names_.push_back(name);
    }
  }

  const std::vector<std::string>& names() const { return names_; }
  // Number i of the row is in out[i].at(k).
  void write(const Sample& sample, std::size_t k, std::vector<Result>& out) {
    if (!layout_) {
      *out[0].at(k) = one_(sample);
      return;
    }
    layout_->write_rows(origin_, {&sample, 1}, row_);
    for (std::size_t i = 0; i < out.size(); ++i) *out[i].at(k) = row_[i + 1];  // row_[0] is t
  }

 private:
  io::RowOrigin origin_;
  std::optional<io::RowLayout> layout_;
  std::function<double(const Sample&)> one_;
  std::vector<std::string> names_;
  std::vector<double> row_;
};

}  // namespace

nb::dict columns_of(const System& system, std::span<const Sample> rows,
                    const std::vector<std::string>& names, double initial_energy) {
  const System principal = along_principal_axes(system);
  const io::ColumnKinds known = known_columns();
  nb::dict table;
  for (const std::string& name : names) {
    Part part(name, known, principal, initial_energy);
    std::vector<Result> numbers;
    for (std::size_t i = 0; i < part.names().size(); ++i) numbers.emplace_back(Shape{rows.size()});
    for_each(rows.size(), [&](std::size_t k) { part.write(rows[k], k, numbers); });
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const nb::str column(part.names()[i].c_str());
      if (!table.contains(column)) table[column] = numbers[i].take();
    }
  }
  return table;
}

std::vector<std::string> names_of(nb::handle names) {
  if (names.is_none()) return {};
  if (nb::isinstance<nb::str>(names)) return {nb::cast<std::string>(names)};
  std::vector<std::string> result;
  for (const nb::handle name : names) {
    if (!nb::isinstance<nb::str>(name))
      throw nb::type_error(
          ("columns: got " + nb::cast<std::string>(nb::repr(name)) + "; expected names").c_str());
    result.push_back(nb::cast<std::string>(name));
  }
  return result;
}

bool any_needs_energy(const std::vector<std::string>& names) {
  const io::ColumnKinds known = known_columns();
  return std::ranges::any_of(names,
                             [&](const std::string& name) { return known.needs_energy(name); });
}

}  // namespace polhode::python
