// SPDX-License-Identifier: MIT
#include "polhode/analysis/section.hpp"

#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace analysis {
namespace {

using polhode::detail::number_text;

constexpr double turn = 2.0 * std::numbers::pi;

// In (-period/2, period/2].
double folded(double x, double period) {
  const double r = std::remainder(x, period);
  return r == -0.5 * period ? 0.5 * period : r;
}

double AndoyerState::*field_of(AndoyerAngle angle) {
  if (angle == AndoyerAngle::l) return &AndoyerState::l;
  return angle == AndoyerAngle::g ? &AndoyerState::g : &AndoyerState::h;
}

template <class Point>
BasicSection<Point> end_of(const Trajectory& run) {
  return {{}, run.outcome(), run.statistics(), run.method()};
}

template <class Point, class Sectioned>
BasicSection<Point> kept(const Sectioned& sectioned) {
  std::vector<Point> points;
  BasicSection<Point> section =
      sectioned([&points](const Point& point) { points.push_back(point); });
  section.points = std::move(points);
  return section;
}

Problem without_events(Problem problem) {
  problem.events.clear();
  return problem;
}

// From the first strobe of the run on, whichever way it goes.
SaveAt strobe_times(const Problem& problem, const Strobe& strobe, const char* function) {
  const auto& [period, epoch] = strobe;
  if (!(period > 0.0) || !std::isfinite(period) || !std::isfinite(epoch))
    throw DomainError(std::string(function) + ": period " + number_text(period) + " and epoch " +
                      number_text(epoch) + " must be finite, the period positive");
  const bool forward = problem.start <= problem.stop;
  const double turns = (problem.start - epoch) / period;
  double k = forward ? std::ceil(turns) : std::floor(turns);
  // the quotient may have been rounded to the other side of a whole number
  const double sign = forward ? 1.0 : -1.0;
  const auto is_before = [&](double t) { return sign * (t - problem.start) < 0.0; };
  if (!is_before(std::fma(k - sign, period, epoch))) k -= sign;
  if (is_before(std::fma(k, period, epoch))) k += sign;
  const double first = std::fma(k, period, epoch);
  const bool any = sign * (problem.stop - first) >= 0.0;
  return SaveAt::steps(first, any ? problem.stop : first, sign * period);
}

AndoyerPoint andoyer_point(double t, const RotorState& s) { return {t, s, to_andoyer(s)}; }

AndoyerSection strobed(const Problem& problem, const Strobe& strobe,
                       const PointSink<AndoyerPoint>& sink, const Progress& progress) {
  const SaveAt times = strobe_times(problem, strobe, "andoyer_section");
  return end_of<AndoyerPoint>(integrate(
      without_events(problem), times,
      [&](std::span<const Sample> samples) {
        for (const Sample& at : samples) sink(andoyer_point(at.t, at.s));
      },
      progress));
}

AndoyerSection passed(const Problem& problem, const AndoyerSurface& surface,
                      const PointSink<AndoyerPoint>& sink, const Progress& progress) {
  if (!std::isfinite(surface.value))
    throw DomainError("andoyer_section: value " + number_text(surface.value) + " must be finite");
  Problem watched = without_events(problem);
  watched.events.push_back(
      {.name = "section",
       .function =
           [angle = field_of(surface.angle), value = surface.value](const Sample& at) {
             return std::remainder(to_andoyer(at.s).*angle - value, turn);
           },
       .crossing = surface.crossing,
       .period = turn});
  Streams streams;
  streams.events = [&](const EventRecord& at) { sink(andoyer_point(at.t, at.s)); };
  return end_of<AndoyerPoint>(integrate(watched, SaveAt::times({}), streams, progress));
}

// What a strobe at the pericentre sees.
class PericentreView {
 public:
  explicit PericentreView(const PrecessingKeplerOrbit& orbit)
      : elements_(orbit.elements()),
        rates_(orbit.rates()),
        n_(polhode::mean_motion(elements_) + rates_.mean_anomaly) {}

  Strobe strobe() const { return {turn / n_, elements_.epoch - elements_.mean_anomaly / n_}; }

  SpinOrbitPoint point(const System& system, const Sample& at) const {
    return system.damper() ? point(at_damper_rate(system, at.s.damper_rate), at.t, at.s)
                           : point(system, at.t, at.s);
  }

 private:
  SpinOrbitPoint point(const System& system, double t, const RotorState& s) const {
    const Quaternion q_IB = inertial_state(system, t, s).q;
    const Quaternion q_OB = conj(orbit_axes(t)) * q_IB;
    const Vec3 axis_1 = rotate(q_OB, Vec3{1.0, 0.0, 0.0}), axis_3 = rotate(q_OB, Vec3{0, 0, 1.0});
    const Vec3 w = rotate(q_OB, angular_velocity(system, t, s).inertial);
    return {t, s, folded(std::atan2(axis_1.y, axis_1.x), std::numbers::pi), w.z / n_,
            std::atan2(std::hypot(axis_3.x, axis_3.y), axis_3.z)};
  }

  // Pericentre, along the motion there, normal.
  Quaternion orbit_axes(double t) const {
    const double age = t - elements_.epoch;
    return rotation_z(elements_.node + rates_.node * age) *
           rotation_x(elements_.inclination + rates_.inclination * age) *
           rotation_z(elements_.argument + rates_.argument * age);
  }

  KeplerElements elements_;
  SecularRates rates_;
  double n_;  // of the mean anomaly, all in all
};

}  // namespace

void require_pericentres(const KeplerElements& elements, const char* function) {
  const double e = elements.eccentricity;
  if (e > 0.0 && e < 1.0) return;
  throw DomainError(
      std::string(function) + ": eccentricity " + number_text(e) + " must be between 0 and 1: " +
      (e > 0.0 ? "a hyperbola passes its pericentre once" : "a circular orbit has no pericentre"));
}

AndoyerSection andoyer_section(const Problem& problem, const SectionSurface& surface,
                               const PointSink<AndoyerPoint>& sink, const Progress& progress) {
  if (const auto* strobe = std::get_if<Strobe>(&surface))
    return strobed(problem, *strobe, sink, progress);
  return passed(problem, std::get<AndoyerSurface>(surface), sink, progress);
}

AndoyerSection andoyer_section(const Problem& problem, const SectionSurface& surface,
                               const Progress& progress) {
  return kept<AndoyerPoint>([&](const PointSink<AndoyerPoint>& sink) {
    return andoyer_section(problem, surface, sink, progress);
  });
}

SpinOrbitSection spin_orbit_section(const Problem& problem, const PrecessingKeplerOrbit& orbit,
                                    const PointSink<SpinOrbitPoint>& sink,
                                    const Progress& progress) {
  require_pericentres(orbit.elements(), "spin_orbit_section");
  const PericentreView view(orbit);
  const SaveAt times = strobe_times(problem, view.strobe(), "spin_orbit_section");
  return end_of<SpinOrbitPoint>(integrate(
      without_events(problem), times,
      [&](std::span<const Sample> samples) {
        for (const Sample& at : samples) sink(view.point(problem.system, at));
      },
      progress));
}

SpinOrbitSection spin_orbit_section(const Problem& problem, const PrecessingKeplerOrbit& orbit,
                                    const Progress& progress) {
  return kept<SpinOrbitPoint>([&](const PointSink<SpinOrbitPoint>& sink) {
    return spin_orbit_section(problem, orbit, sink, progress);
  });
}

SpinOrbitSection spin_orbit_section(const Problem& problem, const KeplerOrbit& orbit,
                                    const Progress& progress) {
  require_pericentres(orbit.elements(), "spin_orbit_section");
  return spin_orbit_section(problem, PrecessingKeplerOrbit(orbit.elements(), {}), progress);
}

}  // namespace analysis
}  // namespace v0
}  // namespace polhode
