// SPDX-License-Identifier: MIT
// What a file says of light curves, to a plan.
#include "polhode/detail/scenario/light_plan.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include "polhode/tables/obj.hpp"
#include "scenario/fit/fit_plan.hpp"
#include "scenario/tables/light.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

using Shape = LightPlan::Shape;

light::Scattering law_of(const Placed<LightTable>& light) {
  if (light->law != LightLaw::mixed)
    light.refuse_any<&LightTable::multiple>("expected none unless light.law = \"mixed\"");
  if (light->law == LightLaw::lambert) return light::Scattering::lambert();
  return light::Scattering::mixed(light->law == LightLaw::mixed ? light->multiple : 0.0);
}

// A shape that is no ellipsoid does not go with every key.
void require_shape(const Placed<LightTable>& light, const Placed<FreeTable>& free,
                   const Rotation& rotation) {
  if (light->shape != Shape::mesh)
    light.refuse_any<&LightTable::mesh>("expected shape = \"mesh\" as well");
  if (light->shape != Shape::convex)
    light.refuse_any<&LightTable::convex>("expected shape = \"convex\" as well");
  else if (!free->has("shape"))
    free.refuse<&FreeTable::unknowns>(
        "expected shape among them: a convex body is what is looked for");
  if (light->shape != Shape::mesh) return;
  if (rotation.shape == nullptr && !light->mesh)
    light.refuse<&LightTable::shape>("expected a key light.mesh or body.shape as well, the mesh");
  light.refuse_any<&LightTable::semiaxes>("expected none together with shape = \"mesh\"");
}

// A mesh does not change, and in a fit its moments do not follow it.
fit::MomentSource moments_of(const Placed<LightTable>& light, fit::MomentSource source) {
  if (light->shape != Shape::mesh || source != fit::MomentSource::shape) return source;
  light.refuse_any<&LightTable::source>(
      "expected \"of-body\" with a mesh, whose moments are those of [body]; body.shape gives "
      "[body] those of an even filling");
  return fit::MomentSource::start;
}

ScanPlan scan_of(const Placed<ScanTable>& table) {
  ScanPlan scan = static_cast<const ScanPlan&>(*table);
  if (scan.shortest && scan.longest && !(*scan.shortest < *scan.longest))
    table.refuse<&ScanPlan::longest>("expected a period longer than fit.scan.shortest");
  if (scan.sessions != ScanPlan::Sessions::separate)
    table.refuse_any<&ScanPlan::windows>("expected fit.scan.sessions = \"separate\" as well");
  scan.labels = {table->pairs, table->readings};
  const std::vector<double>& periods = table->periods;
  if (periods.size() % 2 != 0)
    table.refuse<&ScanTable::periods>("expected pairs of periods, P1 and P2 one after the other");
  for (std::size_t i = 0; i + 1 < periods.size(); i += 2)
    scan.at.push_back({periods[i], periods[i + 1]});
  if (scan.at.empty())
    table.refuse_any<&ScanTable::own_order>("expected fit.scan.at as well, pairs of periods");
  scan.at_order = table->own_order.value_or(scan.order);
  scan.places = {.shortest = table.place<&ScanPlan::shortest>(),
                 .longest = table.place<&ScanPlan::longest>(),
                 .order = table.place<&ScanPlan::order>(),
                 .windows = table.place<&ScanPlan::windows>(),
                 .at = table.place<&ScanTable::periods>()};
  return scan;
}

std::vector<fit::TumblerPeriods> periods_of(const FileValues& at, bool searches) {
  std::vector<fit::TumblerPeriods> all;
  for (const Placed<fit::TumblerPeriods>& one : periods_tables(at)) {
    if (!searches) one.refuse<&fit::TumblerPeriods::mode>("expected fit.from = \"search\" as well");
    all.push_back(*one);
  }
  return all;
}

std::vector<double> sessions_of(const Placed<SimulateTable>& table) {
  const std::vector<double>& ends = table->sessions;
  if (ends.size() % 2 != 0)
    table.refuse<&SimulateTable::sessions>(
        "expected pairs of times, from when to when each session is");
  if (std::ranges::adjacent_find(ends, std::not_fn(std::less<>())) != ends.end())
    table.refuse<&SimulateTable::sessions>("expected rising times: sessions one after the other");
  return ends;
}

}  // namespace

void require_words(const Placed<FreeTable>& free, const Placed<FitTable>& fit, bool of_light) {
  if (!of_light) {
    if (free->has("shape") || free->has("law"))
      free.refuse<&FreeTable::unknowns>(
          "expected attitude, rate, moments, products: nothing else is seen in what this file "
          "observes");
    fit.refuse_any<&FitTable::searches, &FitTable::is_tumbler, &FitTable::one_by_one,
                   &FitTable::within_factor>("expected none without light curves");
    return;
  }
  if (!free->has("attitude") || !free->has("rate"))
    free.refuse<&FreeTable::unknowns>(
        "expected attitude and rate among them: of light curves they always are");
  if (free->has("products"))
    free.refuse<&FreeTable::unknowns>(
        "expected no products: the axes of the ellipsoid are principal ones");
  fit.refuse_any<&FitTable::within>("expected none with light curves; fit.within_factor is theirs");
  fit.refuse_any<&FitTable::rate_spread>(
      "expected none with light curves: a search has rates of periods");
  if (!fit->searches)
    fit.refuse_any<&FitTable::starts>(
        "expected fit.from = \"search\" as well: light curves are fitted from one start "
        "otherwise");
}

LightPlan light_plan(const FileValues& at, const Rotation& rotation, const Placed<FreeTable>& free,
                     const Placed<FitTable>& fit) {
  const Placed<LightTable> light = light_table(at);
  const Placed<SimulateTable> simulate = simulate_table(at);
  require_shape(light, free, rotation);
  const fit::MomentSource moments = free->has("moments") ? fit::MomentSource::fit : light->source;
  LightPlan plan{.shape = light->shape,
                 .mesh = light->mesh.value_or(""),
                 .convex = static_cast<const ConvexPlan&>(*light),
                 .semiaxes = light->semiaxes,
                 .law = law_of(light),
                 .unknowns = {.shape = free->has("shape"),
                              .moments = moments_of(light, moments),
                              .multiple = free->has("law")},
                 .searches = fit->searches,
                 .is_tumbler = fit->is_tumbler,
                 .one_by_one = fit->one_by_one,
                 .periods = periods_of(at, fit->searches),
                 .scan = scan_of(scan_table(at)),
                 .starts = fit.given<&FitTable::starts>(),
                 .most_iterations = fit.given<&FitTable::iterations>(),
                 .within_factor = fit->within_factor,
                 .sessions = sessions_of(simulate),
                 .places = {.moments = light.place<&LightTable::source>(),
                            .degree = light.place<&ConvexPlan::degree>(),
                            .one_by_one = fit.place<&FitTable::one_by_one>(),
                            .sessions = simulate->sessions.empty()
                                            ? place_of(at.values, "time", at.name)
                                            : simulate.place<&SimulateTable::sessions>()}};
  if (light.is_explicit<&LightTable::source>()) plan.convex.moments = moments;
  if (plan.unknowns.multiple && plan.law.single == 0.0)
    light.refuse<&LightTable::law>(
        "expected another law where its weight beside that of Lommel and Seeliger is unknown");
  if (!(plan.within_factor >= 1.0)) fit.refuse<&FitTable::within_factor>("expected 1 or more");
  return plan;
}

}  // namespace detail

shape::FacetShape light_mesh(const Scenario& scenario) {
  static_cast<void>(require_fit(scenario));
  const detail::Placed<detail::LightTable> light =
      detail::light_table(detail::file_values(scenario.document));
  if (!light->mesh) return scenario.rotation().shape->mesh;
  return light.built<&detail::LightTable::mesh>(
      [&] { return read_obj(light.file_at<&detail::LightTable::mesh>()); });
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
