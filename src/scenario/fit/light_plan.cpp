// SPDX-License-Identifier: MIT
// What a file says of light curves, to a plan.
#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include "polhode/tables/obj.hpp"
#include "scenario/fit/fit_plan.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::int64_t most_minima = 10'000, most_labels = 10'000;
constexpr std::int64_t most_degree = 40, most_rows = 200;

bool has_word(const FileValues& at, std::string_view word) {
  const std::vector<std::string>& words = value_at(at.values, "free.unknowns").words;
  return std::find(words.begin(), words.end(), word) != words.end();
}

[[noreturn]] void refuse(const FileValues& at, const std::string& path, const std::string& text) {
  detail::refuse(at.values, path, at.name, text);
}

std::size_t whole_in(const FileValues& at, const std::string& path, std::int64_t most) {
  const std::int64_t n = value_at(at.values, path).whole;
  if (n < 1 || n > most)
    refuse(at, path, "expected a whole number from 1 to " + std::to_string(most));
  return static_cast<std::size_t>(n);
}

Scattering law_of(const FileValues& at) {
  const std::string& law = word(at.values, "light.law");
  require_range(at.values, "light.multiple", at.name);
  if (is_explicit(at.values, "light.multiple") && law != "mixed")
    refuse(at, "light.multiple", "expected none unless light.law = \"mixed\"");
  if (law == "lambert") return Scattering::lambert();
  return Scattering::mixed(law == "mixed" ? number(at.values, "light.multiple") : 0.0);
}

MomentSource moments_of(const FileValues& at) {
  if (has_word(at, "moments")) return MomentSource::fit;
  return word(at.values, "light.moments") == "of-shape" ? MomentSource::shape : MomentSource::start;
}

LightUnknowns light_unknowns_of(const FileValues& at) {
  return {
      .shape = has_word(at, "shape"), .moments = moments_of(at), .multiple = has_word(at, "law")};
}

ConvexPlan convex_of(const FileValues& at) {
  ConvexPlan convex;
  convex.degree = static_cast<int>(whole_in(at, "light.convex.degree", most_degree));
  convex.rows = static_cast<int>(whole_in(at, "light.convex.rows", most_rows));
  for (const char* const path : {"light.convex.roughness_error", "light.convex.moments_error"})
    require_range(at.values, path, at.name);
  convex.roughness_error = number(at.values, "light.convex.roughness_error");
  convex.moments_error = number(at.values, "light.convex.moments_error");
  if (is_explicit(at.values, "light.moments")) convex.moments = moments_of(at);
  if (has(at.values, "light.convex.pairs"))
    convex.pairs = whole_in(at, "light.convex.pairs", most_labels * most_minima);
  return convex;
}

// What a shape that is no ellipsoid does not go with.
void require_shape(const FileValues& at, const Rotation& rotation, LightPlan::Shape shape) {
  const bool is_mesh = shape == LightPlan::Shape::mesh;
  const auto refuse_unless = [&](bool is_right, const std::string& path, const std::string& text) {
    if (!is_right) refuse(at, path, text);
  };
  refuse_unless(is_mesh || !has(at.values, "light.mesh"), "light.mesh",
                "expected shape = \"mesh\" as well");
  refuse_unless(shape == LightPlan::Shape::convex || !is_explicit(at.values, "light.convex"),
                "light.convex", "expected shape = \"convex\" as well");
  if (shape == LightPlan::Shape::convex)
    refuse_unless(has_word(at, "shape"), "free.unknowns",
                  "expected shape among them: a convex body is what is looked for");
  if (!is_mesh) return;
  refuse_unless(rotation.shape != nullptr || has(at.values, "light.mesh"), "light.shape",
                "expected a key light.mesh or body.shape as well, the mesh");
  refuse_unless(!has(at.values, "light.semiaxes"), "light.semiaxes",
                "expected none together with shape = \"mesh\"");
}

// A mesh does not change, and in a fit its moments do not follow it.
void require_mesh_fit(const FileValues& at, LightPlan& plan) {
  if (plan.shape != LightPlan::Shape::mesh) return;
  if (is_explicit(at.values, "light.moments") && plan.unknowns.moments == MomentSource::shape)
    refuse(at, "light.moments",
           "expected \"of-body\" with a mesh, whose moments are those of [body]; body.shape gives "
           "[body] those of an even filling");
  if (plan.unknowns.moments == MomentSource::shape) plan.unknowns.moments = MomentSource::start;
}

std::vector<ScanPlan::Pair> pairs_at(const FileValues& at) {
  const std::string path = "fit.scan.at";
  if (!has(at.values, path)) return {};
  require_range(at.values, path, at.name);
  const std::vector<double>& periods = value_at(at.values, path).numbers;
  if (periods.size() % 2 != 0)
    refuse(at, path, "expected pairs of periods, P1 and P2 one after the other");
  std::vector<ScanPlan::Pair> pairs;
  for (std::size_t i = 0; i + 1 < periods.size(); i += 2)
    pairs.push_back({periods[i], periods[i + 1]});
  return pairs;
}

ScanPlan scan_of(const FileValues& at) {
  ScanPlan scan;
  scan.order = whole_in(at, "fit.scan.order", 9);
  const auto period = [&](const char* path) -> std::optional<double> {
    if (!has(at.values, path)) return std::nullopt;
    require_range(at.values, path, at.name);
    return number(at.values, path);
  };
  scan.shortest = period("fit.scan.shortest");
  scan.longest = period("fit.scan.longest");
  if (scan.shortest && scan.longest && !(*scan.shortest < *scan.longest))
    refuse(at, "fit.scan.longest", "expected a period longer than fit.scan.shortest");
  if (word(at.values, "fit.scan.sessions") == "separate")
    scan.sessions = ScanPlan::Sessions::separate;
  else if (is_explicit(at.values, "fit.scan.windows"))
    refuse(at, "fit.scan.windows", "expected fit.scan.sessions = \"separate\" as well");
  scan.windows = whole_in(at, "fit.scan.windows", most_minima);
  scan.minima = whole_in(at, "fit.scan.minima", most_minima);
  scan.labels.pairs = whole_in(at, "fit.scan.pairs", most_minima);
  scan.labels.labels = whole_in(at, "fit.scan.labels", most_labels);
  scan.at = pairs_at(at);
  const bool has_order = has(at.values, "fit.scan.at_order");
  if (has_order && scan.at.empty())
    refuse(at, "fit.scan.at_order", "expected fit.scan.at as well, pairs of periods");
  scan.at_order = has_order ? whole_in(at, "fit.scan.at_order", 9) : scan.order;
  return scan;
}

std::vector<TumblerPeriods> periods_of(const FileValues& at) {
  std::vector<TumblerPeriods> all;
  for (const std::string& path : array_paths(at.values, "fit.periods")) {
    for (const char* const key : {".precession_period", ".rotation_period"})
      require_range(at.values, path + key, at.name);
    all.push_back(
        {word(at.values, path + ".mode") == "SAM" ? Regime::short_axis : Regime::long_axis,
         number(at.values, path + ".precession_period"),
         number(at.values, path + ".rotation_period")});
  }
  return all;
}

std::vector<double> sessions_of(const FileValues& at) {
  if (!has(at.values, "simulate.sessions")) return {};
  const std::vector<double>& ends = value_at(at.values, "simulate.sessions").numbers;
  if (ends.size() % 2 != 0)
    refuse(at, "simulate.sessions", "expected pairs of times, from when to when each session is");
  for (std::size_t i = 1; i < ends.size(); ++i)
    if (!(ends[i - 1] < ends[i]))
      refuse(at, "simulate.sessions", "expected rising times: sessions one after the other");
  return ends;
}

}  // namespace

void require_words(const FileValues& at, bool of_light) {
  if (!of_light) {
    for (const char* const word : {"shape", "law"})
      if (has_word(at, word))
        refuse(at, "free.unknowns",
               "expected attitude, rate, moments, products: nothing else is seen in what this file "
               "observes");
    for (const char* const path : {"fit.from", "fit.rotation", "fit.sessions", "fit.within_factor"})
      if (is_explicit(at.values, path)) refuse(at, path, "expected none without light curves");
    return;
  }
  if (!has_word(at, "attitude") || !has_word(at, "rate"))
    refuse(at, "free.unknowns",
           "expected attitude and rate among them: of light curves they always are");
  if (has_word(at, "products"))
    refuse(at, "free.unknowns",
           "expected no products: the axes of the ellipsoid are principal ones");
  if (!array_paths(at.values, "free.prior").empty())
    refuse(at, "free.prior[0].kind", "expected no prior: a fit of light curves takes none");
  if (is_explicit(at.values, "fit.within"))
    refuse(at, "fit.within", "expected none with light curves; fit.within_factor is theirs");
  if (is_explicit(at.values, "fit.rate_spread"))
    refuse(at, "fit.rate_spread", "expected none with light curves: a search has rates of periods");
  if (is_explicit(at.values, "fit.starts") && word(at.values, "fit.from") != "search")
    refuse(at, "fit.starts",
           "expected fit.from = \"search\" as well: light curves are fitted from one start "
           "otherwise");
}

LightPlan light_plan(const FileValues& at, const Rotation& rotation) {
  LightPlan plan;
  const std::string& shape = word(at.values, "light.shape");
  plan.shape = shape == "mesh"     ? LightPlan::Shape::mesh
               : shape == "convex" ? LightPlan::Shape::convex
                                   : LightPlan::Shape::ellipsoid;
  require_shape(at, rotation, plan.shape);
  if (has(at.values, "light.mesh")) plan.mesh = word(at.values, "light.mesh");
  plan.convex = convex_of(at);
  if (has(at.values, "light.semiaxes")) {
    require_range(at.values, "light.semiaxes", at.name);
    plan.semiaxes = vector(at.values, "light.semiaxes");
  }
  plan.law = law_of(at);
  plan.unknowns = light_unknowns_of(at);
  require_mesh_fit(at, plan);
  if (plan.unknowns.multiple && plan.law.single == 0.0)
    refuse(at, "light.law",
           "expected another law where its weight beside that of Lommel and "
           "Seeliger is unknown");
  plan.searches = word(at.values, "fit.from") == "search";
  plan.is_tumbler = word(at.values, "fit.rotation") == "tumbler";
  plan.one_by_one = word(at.values, "fit.sessions") == "one-by-one";
  if (plan.one_by_one && plan.shape != LightPlan::Shape::ellipsoid)
    refuse(at, "fit.sessions",
           "expected light.shape = \"ellipsoid\"; start other shapes from its solution");
  plan.scan = scan_of(at);
  plan.periods = periods_of(at);
  if (!plan.periods.empty() && !plan.searches)
    refuse(at, "fit.periods[0].mode", "expected fit.from = \"search\" as well");
  if (is_explicit(at.values, "fit.starts"))
    plan.starts = static_cast<std::size_t>(value_at(at.values, "fit.starts").whole);
  if (is_explicit(at.values, "fit.iterations"))
    plan.most_iterations = static_cast<int>(value_at(at.values, "fit.iterations").whole);
  require_range(at.values, "fit.within_factor", at.name);
  plan.within_factor = number(at.values, "fit.within_factor");
  if (!(plan.within_factor >= 1.0)) refuse(at, "fit.within_factor", "expected 1 or more");
  plan.sessions = sessions_of(at);
  return plan;
}

}  // namespace detail

FacetShape light_mesh(const Scenario& scenario) {
  const std::string& path = require_fit(scenario).light.mesh;
  if (path.empty()) return scenario.rotation().shape->mesh;
  const Document& file = scenario.document;
  return detail::built(file.checked->values, "light.mesh", file.path, [&] {
    return read_obj((std::filesystem::path(file.path).parent_path() / path).string());
  });
}

}  // namespace v0
}  // namespace polhode
