// SPDX-License-Identifier: MIT
// Convex bodies and meshes from the ellipsoids of a search: of every pair of periods, whatever the
// ellipsoid came to, and of the images of what is within the limit.
#include <algorithm>
#include <limits>
#include <utility>

#include "fit/result_bytes.hpp"
#include "polhode/ensemble/cell_journal.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/light_search.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/detail/light_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// An ellipsoid, and the pairs of periods that came to it.
struct Start {
  FoundLight ellipsoid;
  std::vector<std::size_t> pairs;
};

class Surfaces {
 public:
  Surfaces(const Scenario& scenario, const LightSearch& asked, const LightSearchResult& found,
           const LightFitOptions& options, LightReport& report)
      : scenario_(scenario),
        plan_(require_fit(scenario)),
        asked_(asked),
        found_(found),
        options_(options),
        report_(report),
        fits_(scenario, report.unknowns, asked.curves) {}

  void run() {
    const std::vector<Start> starts = starts_of();
    if (options_.begins)
      options_.begins(
          "surfaces",
          (fits_.mesh() ? counted(asked_.starts, "start", "starts") + " by periods, " : "") +
              counted(starts.size(), "ellipsoid", "ellipsoids") +
              " to begin with, and images of the best");
    if (fits_.mesh()) search_periods();
    fit(
        starts.size(), true,
        [&](std::size_t k) { return fits_.from(starts[k].ellipsoid.solution.body); },
        [&](std::size_t k, const std::vector<FoundLight>& all) {
          add(all, starts[k].ellipsoid.periods);
          tell(starts[k], all);
        });
    limit();
    const std::vector<FoundLight> kept = kept_;
    std::vector<LightModel> known;
    for (const FoundLight& one : kept)
      known.push_back(fits_.mesh() ? one.solution.body : *one.begun);
    if (!fits_.mesh())
      for (const Start& one : starts) known.push_back(one.ellipsoid.solution.body);
    fit(
        kept.size(), false, [&](std::size_t k) { return fits_.from_images(*kept[k].begun, known); },
        [&](std::size_t k, const std::vector<FoundLight>& all) { add(all, kept[k].periods); });
    limit();
    finish();
  }

 private:
  // The search of a mesh, and about its part of the work.
  static constexpr std::size_t mesh_tries = 60;
  static constexpr int mesh_iterations = 6;
  static constexpr double search_part = 0.4;
  static constexpr double images_of_one = 3.0;  // fits, about

  // Ellipsoids of all pairs, each once, and those of other poles.
  std::vector<Start> starts_of() const {
    std::vector<std::size_t> pairs;
    for (std::size_t p = 0; p < found_.best_of_periods.size(); ++p)
      if (found_.best_of_periods[p]) pairs.push_back(p);
    std::ranges::stable_sort(pairs, {},
                             [&](std::size_t p) { return found_.best_of_periods[p]->result.cost; });
    pairs.resize(std::min(pairs.size(), plan_.light.convex.pairs));
    std::vector<Start> starts;
    const auto known = [&](const FoundLight& f) {
      return std::ranges::find_if(
          starts, [&](const Start& one) { return fits_.are_same_starts(one.ellipsoid, f); });
    };
    for (const std::size_t p : pairs) {
      const FoundLight best = found_light(*found_.best_of_periods[p], p);
      const auto at = known(best);
      if (at == starts.end())
        starts.push_back({best, {p}});
      else
        at->pairs.push_back(p);
    }
    for (const FoundLight& f : found_.solutions)
      if (known(f) == starts.end()) starts.push_back({f, {}});
    return starts;
  }

  // `has_images`: the images of the kept solutions are still to be fitted after these.
  template <class Made, class Take>
  void fit(std::size_t count, bool has_images, const Made& made, const Take& take) {
    double fits = 0.0;
    ordered_parallel_for(
        options_.journal, static_cast<std::int64_t>(count), options_.threads,
        [&](std::int64_t k) {
          end_if_asked();
          return made(static_cast<std::size_t>(k));
        },
        [&](std::int64_t k, const std::vector<FoundLight>& all) {
          take(static_cast<std::size_t>(k), all);
          fits += static_cast<double>(all.size());
          fits_done_ += static_cast<double>(all.size());
          const double done = static_cast<double>(k + 1), all_of_them = static_cast<double>(count);
          tell_progress((all_of_them - done) * std::max(fits, 1.0) / done +
                        (has_images ? images_of_one * static_cast<double>(count_within()) : 0.0));
        },
        [this](Archive& bytes, std::vector<FoundLight>& all) {
          bytes.list(all, [&](FoundLight& one) { serialize(bytes, one, fits_.mesh()); });
        });
  }

  void tell_progress(double fits_left) const {
    if (!options_.progress) return;
    const double from = fits_.mesh() ? search_part : 0.0;
    const double part = fits_left > 0.0 ? fits_done_ / (fits_done_ + fits_left) : 1.0;
    options_.progress("surfaces", from + (1.0 - from) * part);
  }

  void add(const std::vector<FoundLight>& all, std::size_t periods) {
    for (const FoundLight& one : all) {
      ++report_.surfaces;
      if (!one.solution.is_found()) continue;
      ++report_.surfaces_converged;
      const auto same = std::ranges::find_if(
          kept_, [&](const FoundLight& kept) { return fits_.are_same(kept, one); });
      const bool is_new = same == kept_.end();
      if (!is_new) ++same->starts;
      if (!is_new && !(one.solution.result.cost < same->solution.result.cost)) continue;
      FoundLight& kept = is_new ? kept_.emplace_back() : *same;
      const std::size_t starts = is_new ? 1 : kept.starts, place = is_new ? periods : kept.periods;
      kept = one;
      kept.starts = starts;
      kept.periods = place;
    }
  }

  // The mesh from the periods themselves: an ellipsoid may be far from it, and its own light tells
  // more of its attitude.
  void search_periods() {
    LightSearch how = asked_;
    how.body = fits_.mesh();
    how.tries = mesh_tries;
    how.short_iterations = mesh_iterations;
    how.finalists = LightSearch{}.finalists;
    how.unknowns = report_.unknowns;
    how.between = [&] { end_if_asked(); };
    how.progress = {};
    if (options_.progress)
      how.progress = [&](double part) { options_.progress("surfaces", search_part * part); };
    const LightSearchResult found = search_light(how);
    report_.surfaces += found.finalists;
    report_.surfaces_converged += found.converged;
    for (const FoundLight& f : found.solutions) {
      kept_.push_back(f);
      kept_.back().begun = as_ellipsoid(f);
    }
    for (std::size_t p = 0; p < found.best_of_periods.size(); ++p)
      if (found.best_of_periods[p]) tell(*found.best_of_periods[p], p);
  }

  void end_if_asked() const {
    if (options_.stop && options_.stop())
      throw RunInterrupted(scenario_.document.name + ": stopped in the fits of " +
                           (fits_.mesh() ? "the mesh" : "convex bodies"));
  }

  // The best that converged, or else the best.
  void tell(const LightSolution& s, std::size_t pair) {
    std::optional<SurfaceOfPeriods>& told = report_.pairs.at(pair).surface;
    const auto rank = [](bool is_found, double cost) { return std::pair(!is_found, cost); };
    if (told && rank(told->is_converged, told->cost) <= rank(s.is_found(), s.result.cost)) return;
    told = SurfaceOfPeriods{s.periods,     s.pole,       s.result.chi_square,
                            s.result.cost, s.is_found(), s.result.sentence};
  }

  // What the pairs of this start came to: the best that converged, or else the best.
  void tell(const Start& start, const std::vector<FoundLight>& all) {
    const auto rank = [](const FoundLight& one) {
      return std::pair(!one.solution.is_found(), one.solution.result.cost);
    };
    const auto best = std::ranges::min_element(all, {}, rank);
    if (best == all.end()) return;
    for (const std::size_t p : start.pairs) tell(best->solution, p);
  }

  std::size_t count_within() const {
    double least = std::numeric_limits<double>::infinity();
    for (const FoundLight& one : kept_) least = std::min(least, one.solution.result.cost);
    return static_cast<std::size_t>(std::ranges::count_if(kept_, [&](const FoundLight& one) {
      return one.solution.result.cost <= plan_.light.within_factor * least;
    }));
  }

  void limit() {
    sort_by_cost(kept_, [](const FoundLight& one) -> const LightSolution& { return one.solution; });
    if (kept_.empty()) return;
    const double most = plan_.light.within_factor * kept_.front().solution.result.cost;
    std::erase_if(kept_, [&](const FoundLight& one) { return one.solution.result.cost > most; });
  }

  // Pairs of periods whose fits are no solutions, although they came as low.
  void note_unfinished() const {
    const double most = plan_.light.within_factor * report_.solutions.front().solution.result.cost;
    const auto count = std::ranges::count_if(report_.pairs, [&](const PairFound& pair) {
      return pair.surface && !pair.surface->is_converged && pair.surface->cost <= most;
    });
    if (count > 0)
      report_.notes.push_back(
          counted(static_cast<std::size_t>(count), "pair of periods", "pairs of periods") +
          " came as low as the solutions, but the fits did not converge: the table has them, and "
          "fit.iterations takes them further");
  }

  void finish() {
    for (FoundLight& one : kept_) set_ellipsoid(one);
    report_.solutions = std::move(kept_);
    describe_solutions(report_.solutions, asked_.curves, !fits_.mesh());
    if (!report_.solutions.empty()) return note_unfinished();
    report_.failure =
        report_.surfaces == 0
            ? fits_.mesh() ? "the mesh has none of these periods" : "no ellipsoid to begin with"
            : "none of " + std::to_string(report_.surfaces) + " fits of " +
                  (fits_.mesh() ? "the mesh" : "convex bodies") + " converged";
  }

  const Scenario& scenario_;
  const FitPlan& plan_;
  const LightSearch& asked_;
  const LightSearchResult& found_;
  const LightFitOptions& options_;
  LightReport& report_;
  SurfaceFits fits_;
  std::vector<FoundLight> kept_;
  double fits_done_ = 0.0;
};

}  // namespace

void begin_surfaces(const Scenario& scenario, LightReport& report) {
  const FitPlan& plan = require_fit(scenario);
  report.shape = plan.light.shape;
  if (report.shape == LightPlan::Shape::mesh) {
    if (plan.light.unknowns.shape)
      plan.places.unknowns.refuse(
          "expected no shape with light.shape = \"mesh\": the mesh is given");
    report.unknowns.shape = false;
  }
  if (report.shape != LightPlan::Shape::convex) return;
  // says what is wrong with degree and rows before the search
  plan.light.places.degree.built(
      [&] { return GaussianImage(plan.light.convex.degree, plan.light.convex.rows); });
  report.unknowns = {.shape = true,
                     .moments = plan.light.convex.moments,
                     .multiple = plan.light.unknowns.multiple};
}

void set_ellipsoid(FoundLight& one) {
  if (!one.solution.body.is_convex()) return;
  try {
    const FacetShape mesh = one.solution.body.convex().mesh();
    one.ellipsoid = ellipsoid_of_moments(homogeneous_inertia(mesh));
  } catch (const DomainError& error) {
    one.solution.notes.push_back(std::string("no mesh has these areas: ") + error.what());
  }
}

void fit_surface_from_start(const Scenario& scenario, const std::optional<LightModel>& ellipsoid,
                            LightReport& report) {
  const SurfaceFits fits(scenario, report.unknowns, report.observed.curves);
  report.surfaces = 1;
  FoundLight one = fits.mesh() ? fits.from_file() : fits.from(*ellipsoid).front();
  if (!one.solution.is_found()) {
    report.failure = one.solution.result.sentence;
    return;
  }
  report.surfaces_converged = 1;
  one.starts = 1;
  set_ellipsoid(one);
  report.solutions = {std::move(one)};
}

void fit_surfaces(const Scenario& scenario, const LightSearch& asked,
                  const LightSearchResult& found, const LightFitOptions& options,
                  LightReport& report) {
  Surfaces(scenario, asked, found, options, report).run();
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
