// SPDX-License-Identifier: MIT
// The experiment of kind "rotation" from the values of a file.
#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "scenario/detail/made_experiments.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/tables/body.hpp"
#include "scenario/tables/event.hpp"
#include "scenario/tables/state.hpp"
#include "scenario/tables/surface.hpp"
#include "scenario/tables/time.hpp"
#include "text/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

// What is made anew: with a base, only what stands on a number that has changed.
class RotationBuilder {
 public:
  RotationBuilder(const KindContext& at, const MadeRotation* base,
                  std::span<const std::string> changed)
      : at_(at), base_(base), changed_(changed) {}

  MadeRotation made() {
    const std::span<const ChartKind> charts = at_.kinds.charts();
    const std::string form = state_form(at_, charts);
    const Placed<BodyTable> body_of_file = body_table(at_);
    const Placed<StateTable> state = state_table(at_);
    const Placed<TimeTable> time = time_table(at_);
    std::shared_ptr<const ScenarioShape> shape =
        keeps({"body."}) ? base_->rotation.shape : shape_of(body_of_file);
    const Body body = keeps({"body."}) ? base_->rotation.body : body_of(body_of_file, shape.get());
    time_ = time->is_automatic() ? automatic_span(time) : times_of(time);
    MadeRotation made{{.body = body,
                       .q_file = body_of_file->moments ? Quaternion{} : body.q_FB(),
                       .chart = form,
                       .state = state_of(at_, form, charts, body),
                       .epoch = state->epoch.value_or(""),
                       .axes = state->axes,
                       .shape = std::move(shape),
                       .time = time_},
                      {},
                      {}};
    add_orbits(made);
    Rotation& rotation = made.rotation;
    rotation.method = method_of(at_);
    rotation.events =
        keeps({"event["}) ? base_->rotation.events : events_of(at_, at_.kinds.columns());
    if (base_ == nullptr)  // reported here, between the state and what acts on it
      static_cast<void>(format_options_of(at_, at_.output.formats));
    add_frame(rotation, at_);
    same_axes_ = base_ != nullptr && rotation.q_file == base_->rotation.q_file;
    same_surface_ = same_axes_ && keeps({"surface["}) && rotation.shape == base_->rotation.shape;
    if (same_surface_) {
      rotation.surface = base_->rotation.surface;
      rotation.surface_meshes = base_->rotation.surface_meshes;
    } else {
      add_surface(rotation, at_);
    }
    add_terms(made);
    if (const TumblerState* tumbler = std::get_if<TumblerState>(&rotation.state))
      require_angles(at_, body, *tumbler);
    prepare_motion(rotation, at_);
    // members of an ensemble share the rows of the file
    if (time->is_automatic())
      rotation.time = base_ != nullptr ? base_->rotation.time : automatic_times(rotation, time);
    return made;
  }

 private:
  // Whether there is a base, and no number below these paths has changed.
  bool keeps(std::initializer_list<std::string_view> paths) const {
    return base_ != nullptr && std::none_of(changed_.begin(), changed_.end(), [&](const auto& key) {
             return std::any_of(paths.begin(), paths.end(),
                                [&](std::string_view path) { return key.starts_with(path); });
           });
  }

  void add_orbits(MadeRotation& made) {
    const OrbitsContext place{{at_.values, at_.units, at_.name}, time_, at_.kinds};
    const std::vector<std::string> paths = orbit_paths(at_.values);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const OrbitKind* const kind = at_.kinds.orbit(word(at_.values, paths[i] + ".kind"));
      if (kind != nullptr && !kind->made)
        refuse(at_.values, paths[i] + ".kind", at_.name,
               "expected a kind with positions, such as \"kepler\" or \"elements\": shipped orbits "
               "are for kind = \"obliquity\"");
      const bool kept =
          keeps({paths[i] + ".", "state.dut1"}) && (!base_->orbits[i].time || keeps({"time."}));
      made.orbits.push_back(kept ? base_->orbits[i] : OrbitUses{});
      made.rotation.orbits.push_back(kept ? base_->rotation.orbits[i]
                                          : orbit_of(place, paths[i], made.orbits[i]));
      same_orbits_.push_back(kept);
    }
  }

  bool keeps_term(const std::string& path, const TermUses& uses) const {
    return keeps({path + ".", "state.dut1"}) && (!uses.body || keeps({"body."})) &&
           (!uses.file_axes || same_axes_) && (!uses.surface || same_surface_) &&
           std::all_of(uses.orbits.begin(), uses.orbits.end(),
                       [&](std::size_t orbit) { return same_orbits_[orbit]; });
  }

  MadeTerms made_terms(const Rotation& rotation, const std::string& kind, const std::string& path,
                       TermUses& uses) const {
    const PerturbationKind* const description = at_.kinds.perturbation(kind);
    if (description == nullptr)
      throw std::logic_error("perturbation: the schema allows a kind without a description: " +
                             kind);
    const KeyValues table(at_.values, at_.units, path, at_.name);
    const TermParts parts = parts_of(rotation);
    return table.built("kind", [&] { return description->made(TermContext(table, parts, uses)); });
  }

  void add_made(Rotation& rotation, MadeTerms made, const std::string& path) const {
    if (auto* const one = std::get_if<AnyPerturbation>(&made)) {
      rotation.terms.push_back(std::move(*one));
    } else if (auto* const several = std::get_if<std::vector<AnyPerturbation>>(&made)) {
      for (AnyPerturbation& term : *several) rotation.terms.push_back(std::move(term));
    } else {
      if (rotation.damper)
        refuse(at_.values, path + ".kind", at_.name,
               "expected at most one perturbation of this kind");
      const auto& damper = std::get<DamperAtStart>(made);
      rotation.damper = damper.damper;
      rotation.damper_rate = damper.rate;
    }
  }

  void add_terms(MadeRotation& made) {
    Rotation& rotation = made.rotation;
    const std::vector<std::string> paths = array_paths(at_.values, "perturbation");
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const std::string& kind = word(at_.values, paths[i] + ".kind");
      rotation.kinds.push_back(kind);
      TermTable table{{}, rotation.terms.size(), 0};
      const MadeRotation* const base =
          base_ != nullptr && keeps_term(paths[i], base_->tables[i].uses) ? base_ : nullptr;
      if (base != nullptr && base->tables[i].count > 0) {
        table = base->tables[i];
        for (std::size_t k = 0; k < table.count; ++k)
          rotation.terms.push_back(base->rotation.terms[table.first + k]);
      } else {
        add_made(rotation, made_terms(rotation, kind, paths[i], table.uses), paths[i]);
        table.count = rotation.terms.size() - table.first;
      }
      rotation.arguments.push_back({table.count, table.uses.arguments});
      made.tables.push_back(std::move(table));
    }
  }

  const KindContext& at_;
  const MadeRotation* base_;
  std::span<const std::string> changed_;
  std::optional<SaveAt> time_;
  bool same_axes_ = false;
  bool same_surface_ = false;
  std::vector<bool> same_orbits_;
};

}  // namespace

MadeRotation made_rotation(const KindContext& at, const MadeRotation* base,
                           std::span<const std::string> changed) {
  MadeRotation made = RotationBuilder(at, base, changed).made();
  check_motion(made.rotation, at);
  return made;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
