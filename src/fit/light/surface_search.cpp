// SPDX-License-Identifier: MIT
// Convex bodies and meshes from the ellipsoids of a search: of every pair of periods, whatever the
// ellipsoid came to, and of the images of what is within the limit.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/detail/light_starts.hpp"
#include "fit/free_motion.hpp"
#include "fit/light_states.hpp"
#include "fit/result_bytes.hpp"
#include "math/number_text.hpp"
#include "polhode/ensemble/cell_journal.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/fit/snapshots.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/rotor/attitude.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {
namespace {

// Attitudes of a mesh with the periods of an ellipsoid: the iterations of each, and how many are
// fitted to the end.
constexpr int short_iterations = 4;
constexpr std::size_t mesh_finalists = 3;
// The largest psi that a mesh takes from an ellipsoid, as a part of the maximum of the mesh.
constexpr double most_psi = 0.95;
// States from which one start is enough: in rad, and of the rate.
constexpr double near_turn = 0.05, near_rate = 0.01;
// The search of a mesh by its periods, and about its part of the work.
constexpr std::size_t mesh_tries = 60;
constexpr int mesh_iterations = 6;
constexpr double search_part = 0.4;
constexpr double images_of_one = 3.0;  // fits, about
constexpr std::array<Quaternion, 4> half_turns{Quaternion{1.0, 0.0, 0.0, 0.0},
                                               {0.0, 1.0, 0.0, 0.0},
                                               {0.0, 0.0, 1.0, 0.0},
                                               {0.0, 0.0, 0.0, 1.0}};
constexpr std::array<LightImage, 3> images{LightImage::normal, LightImage::bisector,
                                           LightImage::difference};

// Fits of convex bodies or of the mesh to the curves of a search, each from an ellipsoid.
class SurfaceFits {
 public:
  explicit SurfaceFits(const LightSearch& search)
      : search_(search), geometry_(geometry_of(search.curves)) {}

  // The best from this ellipsoid: of a mesh of some attitudes with its periods. None where the mesh
  // has no such motion.
  std::vector<FoundLight> from(const LightModel& ellipsoid) const {
    if (!mesh()) return {convex_from(ellipsoid)};
    std::vector<FoundLight> tried, found;
    for (const SpinState& spin : mesh_starts(ellipsoid))
      tried.push_back(mesh_from(spin, ellipsoid, short_iterations));
    std::erase_if(tried, [](const FoundLight& one) {
      return one.solution.result.end == LeastSquaresResult::End::no_value;
    });
    std::ranges::stable_sort(tried, {},
                             [](const FoundLight& one) { return one.solution.result.cost; });
    for (std::size_t k = 0; k < std::min(tried.size(), mesh_finalists); ++k)
      found.push_back(mesh_from(tried[k].solution.body.spin, ellipsoid, surface().most_iterations));
    return found;
  }

  // From what has the same light where directions do not change: images, of a mesh all attitudes.
  // Not from what is near a state that is `known`.
  std::vector<FoundLight> from_images(const LightModel& ellipsoid,
                                      const std::vector<LightModel>& known) const {
    std::vector<FoundLight> found;
    if (mesh()) {
      for (const SpinState& spin : mesh_starts(ellipsoid))
        if (!is_known({spin, ellipsoid.shape, ellipsoid.law}, known))
          found.push_back(mesh_from(spin, ellipsoid, surface().most_iterations));
      return found;
    }
    for (const LightImage i : images) {
      const LightModel image = image_of(ellipsoid, i, geometry_.to_sun, geometry_.to_observer);
      if (!is_known(image, known)) found.push_back(convex_from(image));
    }
    return found;
  }

  const std::optional<LightModel>& mesh() const { return surface().mesh; }
  // Convex bodies turn with their facets; a mesh is another one after a half turn.
  bool are_same(const FoundLight& a, const FoundLight& b) const {
    return are_same_spins(a, b, !mesh(), geometry_.time_base);
  }
  // Also half turns of ellipsoids that they begin with are the same.
  bool are_same_starts(const FoundLight& a, const FoundLight& b) const {
    return are_same_spins(a, b, true, geometry_.time_base);
  }

 private:
  const SurfaceSearch& surface() const { return *search_.surface; }

  FoundLight fitted(const LightModel& start, const LightModel& ellipsoid, int iterations) const {
    FoundLight found =
        found_light(fit_light(surface().fit_from(start, search_.curves, search_.loss, iterations)));
    found.begun = ellipsoid;
    return found;
  }

  FoundLight convex_from(const LightModel& ellipsoid) const {
    FoundLight found = fitted(surface().convex_of(ellipsoid), ellipsoid, surface().most_iterations);
    found.ellipsoid = ellipsoid.ellipsoid();
    return found;
  }

  FoundLight mesh_from(const SpinState& spin, const LightModel& ellipsoid, int iterations) const {
    return fitted({spin, mesh()->shape, mesh()->law}, ellipsoid, iterations);
  }

  bool is_known(const LightModel& body, const std::vector<LightModel>& known) const {
    return std::ranges::any_of(known, [&](const LightModel& one) {
      const SpinState s = mesh() ? body.spin : nearest_of_same(one, body).spin;
      return norm(attitude_residual(one.spin.q, s.q)) < near_turn &&
             norm(s.w_F - one.spin.w_F) < near_rate * norm(one.spin.w_F);
    });
  }

  // The mesh with the mode, periods, pole and phases of an ellipsoid and of its images, in each of
  // four half turns; without those whose periods the body of the mesh cannot have.
  std::vector<SpinState> mesh_starts(const LightModel& ellipsoid) const {
    const SpinState& own = mesh()->spin;
    const Body body = Body::from_tensor(own.inertia_F);
    std::vector<SpinState> all;
    std::vector<LightModel> seen{ellipsoid};
    for (const LightImage i : images)
      seen.push_back(image_of(ellipsoid, i, geometry_.to_sun, geometry_.to_observer));
    for (const LightModel& one : seen) {
      try {
        TumblerState t = to_tumbler(free_rotation_of(one.spin), one.spin.t0);
        RotorState s;
        try {
          s = to_rotor(body, t);
        } catch (const DomainError&) {  // psi beyond what the body has, or no such periods
          const double most = t.psi0;
          t.psi0 = 0.0;
          const double limit = most_psi * psi_max(FreeRotation(body, to_rotor(body, t)));
          t.psi0 = std::isfinite(limit) ? std::clamp(most, -limit, limit) : most;
          s = to_rotor(body, t);
        }
        for (const Quaternion& r : half_turns) {
          const Vec3 g = rotate(conj(r), s.g), I = body.moments();
          const Quaternion& f = body.q_FB();
          all.push_back({one.spin.t0, normalized(s.q) * r * conj(f),
                         rotate(f, Vec3{g.x / I.x, g.y / I.y, g.z / I.z}), own.inertia_F});
        }
      } catch (const DomainError&) {  // no motion of the body has them
        continue;
      }
    }
    return all;
  }

  const LightSearch& search_;
  LightGeometry geometry_;
};

// An ellipsoid, and the pairs of periods that came to it.
struct Start {
  FoundLight ellipsoid;
  std::vector<std::size_t> pairs;
};

// Takes the ellipsoids out of a result and puts bodies in.
class Surfaces {
 public:
  Surfaces(const LightSearch& search, LightSearchResult& result)
      : search_(search), result_(result), fits_(search) {
    result.surface_of_periods.resize(search.periods.size());
  }

  void run() {
    const std::vector<Start> starts = starts_of();
    if (search_.begins)
      search_.begins("surfaces",
                     (fits_.mesh() ? polhode::detail::counted(search_.starts, "start", "starts") +
                                         " by periods, "
                                   : "") +
                         polhode::detail::counted(starts.size(), "ellipsoid", "ellipsoids") +
                         " to begin with, and images of the best");
    if (fits_.mesh()) search_periods();
    fit(
        starts.size(), true,
        [&](std::size_t k) { return fits_.from(starts[k].ellipsoid.solution.body); },
        [&](std::size_t k, const std::vector<FoundLight>& all) {
          add(all, starts[k].ellipsoid.periods);
          const auto best = std::ranges::min_element(
              all, {}, [](const FoundLight& one) { return rank(one.solution); });
          if (best == all.end()) return;
          for (const std::size_t p : starts[k].pairs) tell(best->solution, p);
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
    for (FoundLight& one : kept_) set_ellipsoid(one);
    result_.solutions = std::move(kept_);
    describe_solutions(result_.solutions, search_.curves, !fits_.mesh());
    result_.failure = result_.solutions.empty() ? failure() : std::string();
  }

 private:
  std::string failure() const {
    if (result_.surfaces == 0)
      return fits_.mesh() ? "the mesh has none of these periods" : "no ellipsoid to begin with";
    return "none of " + std::to_string(result_.surfaces) + " fits of " +
           (fits_.mesh() ? "the mesh" : "convex bodies") + " converged";
  }

  // Ellipsoids of all pairs, each once, and those of other poles.
  std::vector<Start> starts_of() const {
    const auto& best_of = result_.best_of_periods;
    std::vector<std::size_t> pairs;
    for (std::size_t p = 0; p < best_of.size(); ++p)
      if (best_of[p]) pairs.push_back(p);
    std::ranges::stable_sort(pairs, {}, [&](std::size_t p) { return best_of[p]->result.cost; });
    pairs.resize(std::min(pairs.size(), search_.surface->pairs));
    std::vector<Start> starts;
    const auto known = [&](const FoundLight& f) {
      return std::ranges::find_if(
          starts, [&](const Start& one) { return fits_.are_same_starts(one.ellipsoid, f); });
    };
    for (const std::size_t p : pairs) {
      const FoundLight best = found_light(*best_of[p], p);
      const auto at = known(best);
      if (at == starts.end())
        starts.push_back({best, {p}});
      else
        at->pairs.push_back(p);
    }
    for (const FoundLight& f : result_.solutions)
      if (known(f) == starts.end()) starts.push_back({f, {}});
    return starts;
  }

  // `has_images`: the images of the kept solutions are still to be fitted after these.
  template <class Made, class Take>
  void fit(std::size_t count, bool has_images, const Made& made, const Take& take) {
    double fits = 0.0;
    ensemble::ordered_parallel_for(
        search_.journal, static_cast<std::int64_t>(count), search_.threads,
        [&](std::int64_t k) {
          if (search_.between) search_.between();
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
    if (!search_.progress) return;
    const double from = fits_.mesh() ? search_part : 0.0;
    const double part = fits_left > 0.0 ? fits_done_ / (fits_done_ + fits_left) : 1.0;
    search_.progress(from + (1.0 - from) * part);
  }

  void add(const std::vector<FoundLight>& all, std::size_t periods) {
    for (const FoundLight& one : all) {
      ++result_.surfaces;
      if (!one.solution.is_found()) continue;
      ++result_.surfaces_converged;
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
    LightSearch how = search_;
    how.surface.reset();
    how.body = fits_.mesh();
    how.tries = mesh_tries;
    how.short_iterations = mesh_iterations;
    how.finalists = LightSearch{}.finalists;
    how.unknowns = search_.surface->unknowns;
    how.begins = {};
    if (search_.progress) how.progress = [&](double part) { search_.progress(search_part * part); };
    const LightSearchResult found = search_light(how);
    result_.surfaces += found.finalists;
    result_.surfaces_converged += found.converged;
    for (const FoundLight& f : found.solutions) {
      kept_.push_back(f);
      kept_.back().begun = as_ellipsoid(f);
    }
    for (std::size_t p = 0; p < found.best_of_periods.size(); ++p)
      if (found.best_of_periods[p]) tell(*found.best_of_periods[p], p);
  }

  // The best that converged, or else the best.
  static std::pair<bool, double> rank(const LightSolution& s) {
    return {!s.is_found(), s.result.cost};
  }
  void tell(const LightSolution& s, std::size_t pair) {
    std::optional<LightSolution>& told = result_.surface_of_periods.at(pair);
    if (!told || !(rank(*told) <= rank(s))) told = s;
  }

  std::size_t count_within() const {
    double least = std::numeric_limits<double>::infinity();
    for (const FoundLight& one : kept_) least = std::min(least, one.solution.result.cost);
    return static_cast<std::size_t>(std::ranges::count_if(kept_, [&](const FoundLight& one) {
      return one.solution.result.cost <= search_.within * least;
    }));
  }

  void limit() {
    sort_by_cost(kept_, [](const FoundLight& one) -> const LightSolution& { return one.solution; });
    if (kept_.empty()) return;
    const double most = search_.within * kept_.front().solution.result.cost;
    std::erase_if(kept_, [&](const FoundLight& one) { return one.solution.result.cost > most; });
  }

  const LightSearch& search_;
  LightSearchResult& result_;
  SurfaceFits fits_;
  std::vector<FoundLight> kept_;
  double fits_done_ = 0.0;
};

}  // namespace

void fit_surfaces(const LightSearch& search, LightSearchResult& result) {
  Surfaces(search, result).run();
}

void set_ellipsoid(FoundLight& one) {
  if (!one.solution.body.is_convex()) return;
  try {
    const shape::FacetShape mesh = one.solution.body.convex().mesh();
    one.ellipsoid = ellipsoid_of_moments(homogeneous_inertia(mesh));
  } catch (const DomainError& error) {
    one.solution.notes.push_back(std::string("no mesh has these areas: ") + error.what());
  }
}

}  // namespace detail

LightModel SurfaceSearch::convex_of(const LightModel& ellipsoid) const {
  return {ellipsoid.spin, ConvexShape::of(ellipsoid.ellipsoid(), degree, rows), ellipsoid.law};
}

LightFit SurfaceSearch::fit_from(const LightModel& start, std::vector<light::LightCurve> curves,
                                 const Loss& loss, int iterations) const {
  return {std::move(curves), start, unknowns, loss, iterations, 0.0, regularisation};
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
