// SPDX-License-Identifier: MIT
// Kinds: what a scenario may hold. default_kinds() has ours; a program of your own adds its own:
//
//     const Kinds kinds = default_kinds().with(my_torque());
//     const Scenario scenario = read_scenario("mine.toml", kinds);
//
// Domain      a name that no other kind of its sort has, of letters, digits and -; keys of equal
//             names may differ between kinds.
// Errors      DomainError from with() for a name or an extension that is taken, or not plain, and
//             for a kind that is not sound: no text, nothing that makes it, two keys of one name,
//             an example or what stands for a missing key that the key does not take; and for a
//             chart or a group of columns with a word or a column that scenarios could not tell
//             from another.
// Cost        copies share. with() makes the table of keys anew: some ten microseconds.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "polhode/output/column_kind.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/scenario/experiment_kind.hpp"
#include "polhode/scenario/frame_kind.hpp"
#include "polhode/scenario/method_kind.hpp"
#include "polhode/scenario/observation_kind.hpp"
#include "polhode/scenario/orbit_kind.hpp"
#include "polhode/scenario/perturbation_kind.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/tables/convert.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

class Kinds {
 public:
  Kinds with(PerturbationKind kind) const;
  Kinds with(OrbitKind kind) const;
  Kinds with(MethodKind kind) const;
  Kinds with(FrameKind kind) const;
  Kinds with(ExperimentKind kind) const;
  Kinds with(OutputFormat format) const;
  Kinds with(const ChartKind& chart) const;
  Kinds with(ColumnKind kind) const;
  Kinds with(ObservationKind kind) const;

  std::span<const PerturbationKind> perturbations() const;
  // Null where there is none of this name.
  const PerturbationKind* perturbation(std::string_view name) const;
  std::span<const OrbitKind> orbits() const;
  const OrbitKind* orbit(std::string_view name) const;
  std::span<const FrameKind> frames() const;
  std::span<const MethodKind> methods() const;
  const MethodKind* method(std::string_view name) const;
  // Those from outside: what a file may be next to a rotation.
  std::span<const ExperimentKind> experiments() const;
  const ExperimentKind* experiment(std::string_view name) const;
  std::span<const ObservationKind> observations() const;
  const ObservationKind* observation(std::string_view name) const;
  const OutputFormats& formats() const;
  // Of tables to convert; those that are in scenarios also of [state.CHART] and of columns.
  std::span<const ChartKind> charts() const;
  // Output columns of a rotation.
  const ColumnKinds& columns() const;
  // The keys of a scenario file.
  const Schema& schema() const;

 private:
  struct Parts;
  explicit Kinds(std::shared_ptr<const Parts> parts);
  friend Kinds default_kinds();

  std::shared_ptr<const Parts> parts_;
};

Kinds default_kinds();

}  // namespace io
}  // namespace v0
}  // namespace polhode
