// SPDX-License-Identifier: MIT
// What a file says of light curves, to a plan.
#include <algorithm>
#include <string>
#include <string_view>

#include "scenario/fit/fit_plan.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::int64_t most_minima = 10'000, most_labels = 10'000;

bool has_word(const FitContext& at, std::string_view word) {
  const std::vector<std::string>& words = value_at(at.values, "free.unknowns").words;
  return std::find(words.begin(), words.end(), word) != words.end();
}

[[noreturn]] void refuse(const FitContext& at, const std::string& path, const std::string& text) {
  detail::refuse(at.values, path, at.name, text);
}

std::size_t whole_in(const FitContext& at, const std::string& path, std::int64_t most) {
  const std::int64_t n = value_at(at.values, path).whole;
  if (n < 1 || n > most)
    refuse(at, path, "expected a whole number from 1 to " + std::to_string(most));
  return static_cast<std::size_t>(n);
}

Scattering law_of(const FitContext& at) {
  const std::string& law = word(at.values, "light.law");
  require_range(at.values, "light.multiple", at.name);
  if (is_explicit(at.values, "light.multiple") && law != "mixed")
    refuse(at, "light.multiple", "expected none unless light.law = \"mixed\"");
  if (law == "lambert") return Scattering::lambert();
  return Scattering::mixed(law == "mixed" ? number(at.values, "light.multiple") : 0.0);
}

LightUnknowns unknowns_of(const FitContext& at) {
  const MomentSource given =
      word(at.values, "light.moments") == "of-shape" ? MomentSource::shape : MomentSource::start;
  return {.shape = has_word(at, "shape"),
          .moments = has_word(at, "moments") ? MomentSource::fit : given,
          .multiple = has_word(at, "law")};
}

ScanPlan scan_of(const FitContext& at) {
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
  scan.minima = whole_in(at, "fit.scan.minima", most_minima);
  scan.labels.pairs = whole_in(at, "fit.scan.pairs", most_minima);
  scan.labels.labels = whole_in(at, "fit.scan.labels", most_labels);
  return scan;
}

std::vector<TumblerPeriods> periods_of(const FitContext& at) {
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

std::vector<double> sessions_of(const FitContext& at) {
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

void require_words(const FitContext& at, bool of_light) {
  if (!of_light) {
    for (const char* const word : {"shape", "law"})
      if (has_word(at, word))
        refuse(at, "free.unknowns",
               "expected attitude, rate, moments, products: nothing else is seen in what this file "
               "observes");
    for (const char* const path : {"fit.from", "fit.within_factor"})
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

LightPlan light_plan(const FitContext& at, const Rotation& rotation) {
  LightPlan plan;
  if (word(at.values, "light.shape") == "mesh") {
    if (rotation.shape == nullptr)
      refuse(at, "light.shape", "expected a key body.shape as well, the mesh");
    if (has(at.values, "light.semiaxes"))
      refuse(at, "light.semiaxes", "expected none together with shape = \"mesh\"");
    plan.shape = LightPlan::Shape::mesh;
  }
  if (has(at.values, "light.semiaxes")) {
    require_range(at.values, "light.semiaxes", at.name);
    plan.semiaxes = vector(at.values, "light.semiaxes");
  }
  plan.law = law_of(at);
  plan.unknowns = unknowns_of(at);
  if (plan.unknowns.multiple && plan.law.single == 0.0)
    refuse(at, "light.law",
           "expected another law where its weight beside that of Lommel and "
           "Seeliger is unknown");
  plan.searches = word(at.values, "fit.from") == "search";
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
}  // namespace v0
}  // namespace polhode
