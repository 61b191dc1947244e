// SPDX-License-Identifier: MIT
#include "polhode/scenario/kinds.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/detail/kind_check.hpp"
#include "scenario/detail/kind_rows.hpp"
#include "scenario/detail/schema_table.hpp"
#include "scenario/detail/torque_kinds.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key perturbation_table = {
    .path = "perturbation[]",
    .help = "What acts on the body; any number of tables, each of one kind."};
constexpr Key perturbation_kind_key = {.path = "perturbation[].kind",
                                       .type = choice,
                                       .presence = required,
                                       .example = "\"gravity-gradient\"",
                                       .help = "What it is."};

std::vector<detail::KindOfTable> kinds_of_table(std::span<const PerturbationKind> kinds) {
  std::vector<detail::KindOfTable> all;
  for (const PerturbationKind& kind : kinds)
    all.push_back({{{}, kind.name, kind.help, kind.on_surface}, kind.keys, kind.sets});
  return all;
}

// Their order is that of pages and templates.
std::vector<PerturbationKind> our_perturbations() {
  using namespace detail;
  return {gravity_gradient_kind(),
          constant_torque_kind(),
          damping_kind(),
          tide_kind(),
          internal_damping_kind(),
          anelastic_damping_kind(),
          torque_table_kind(),
          solar_pressure_kind(),
          drag_kind(),
          residual_dipole_kind(),
          eddy_currents_kind(),
          kane_damper_kind()};
}

bool is_plain(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
  });
}

}  // namespace

struct Kinds::Parts {
  Parts(std::vector<PerturbationKind> of, OutputFormats all_formats)
      : perturbations(std::move(of)),
        formats(std::move(all_formats)),
        rows(perturbation_table, perturbation_kind_key, kinds_of_table(perturbations)),
        table(detail::experiment_kinds(), {rows.part()}, formats),
        schema(table.schema()) {}

  std::vector<PerturbationKind> perturbations;
  OutputFormats formats;
  detail::KindRows rows;
  detail::SchemaTable table;
  Schema schema;
};

Kinds::Kinds(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}

Kinds default_kinds() {
  static const auto ours =
      std::make_shared<const Kinds::Parts>(our_perturbations(), default_output_formats());
  return Kinds(ours);
}

Kinds Kinds::with(PerturbationKind kind) const {
  const std::string shown = "Kinds: perturbation \"" + detail::printable(std::string(kind.name));
  if (!is_plain(kind.name)) throw DomainError(shown + "\"; expected letters, digits and -");
  if (perturbation(kind.name) != nullptr)
    throw DomainError(shown + "\" is there; expected another name");
  const std::vector<std::string_view> charts = state_charts();
  if (std::find(charts.begin(), charts.end(), kind.name) != charts.end())
    throw DomainError(shown + "\" is the name of a chart; expected another name");
  detail::require_sound(kind);
  std::vector<PerturbationKind> all = parts_->perturbations;
  all.push_back(std::move(kind));
  return Kinds(std::make_shared<const Parts>(std::move(all), parts_->formats));
}

Kinds Kinds::with(OutputFormat format) const {
  return Kinds(std::make_shared<const Parts>(parts_->perturbations,
                                             parts_->formats.with(std::move(format))));
}

const OutputFormats& Kinds::formats() const { return parts_->formats; }

std::span<const PerturbationKind> Kinds::perturbations() const { return parts_->perturbations; }

const PerturbationKind* Kinds::perturbation(std::string_view name) const {
  for (const PerturbationKind& kind : parts_->perturbations)
    if (kind.name == name) return &kind;
  return nullptr;
}

const Schema& Kinds::schema() const { return parts_->schema; }

const Schema& scenario_schema() {
  static const Kinds kinds = default_kinds();
  return kinds.schema();
}

}  // namespace v0
}  // namespace polhode
