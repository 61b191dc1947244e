// SPDX-License-Identifier: MIT
// W1, the tumbling body under the gravity gradient of docs/accuracy/perturbed-rotation.md, by every
// method: states at times of the dense output, events, what it cost, the state transition.
#include "record.hpp"

namespace {

using namespace polhode;
using probe::Record;

constexpr double orbit = 6.283185307179586;
constexpr int rows = 400;

struct Run {
  std::string name;
  Method method;
  double orbits;
};

std::vector<Run> runs() {
  std::vector<Run> all;
  for (const char* tolerance : {"1e-6", "1e-10", "1e-12", "1e-14", "1e-15"})
    all.push_back({std::string("adaptive/") + tolerance, Adaptive{std::stod(tolerance)}, 1000});
  all.push_back({"adaptive/fixed", Adaptive{1e-2, Precision::compensated, 0.011, 0.011}, 1000});
  all.push_back({"adaptive/double-double", Adaptive{1e-19, Precision::double_double}, 20});
  for (const char* tolerance : {"1e-8", "1e-12", "1e-15"})
    all.push_back({std::string("variation-of-constants/") + tolerance,
                   VariationOfConstants{std::stod(tolerance)}, 1000});
  const std::pair<const char*, SplittingScheme> schemes[] = {
      {"order2", SplittingScheme::order2}, {"order4", SplittingScheme::order4},
      {"order6", SplittingScheme::order6}, {"order8", SplittingScheme::order8},
      {"ABA864", SplittingScheme::ABA864}, {"ABA1064", SplittingScheme::ABA1064}};
  for (const auto& [name, scheme] : schemes)
    for (const double step : {0.1, 0.03})
      all.push_back({"splitting/" + std::string(name) + (step < 0.1 ? "/0.03" : "/0.1"),
                     Splitting{step, scheme}, 1000});
  return all;
}

Problem problem_of(const Run& run) {
  const KeplerOrbit path(
      {.gm = 1.0, .pericentre = pericentre_distance(1.0, 0.1), .eccentricity = 0.1});
  return {System(Body(0.9, 1.0, 1.1), Frame::inertial(),
                 {AnyPerturbation("gravity gradient", GravityGradient(1.0, path))}),
          {{1.0, 0.0, 0.0, 0.0}, {0.9 * 5.0, 4.0, 1.1 * 7.5}},
          0.0,
          run.orbits * orbit,
          run.method};
}

void print_run(const Record& out, const Run& run) {
  const Problem problem = problem_of(run);
  std::int64_t number = 0;
  const Trajectory made = integrate(problem, SaveAt::count(0.0, problem.stop, rows),
                                    [&](std::span<const Sample> block) {
                                      for (const Sample& row : block) {
                                        const std::string field = "row " + std::to_string(number++);
                                        out.value(field + ".t", row.t);
                                        out.state(field, row.s);
                                      }
                                    });
  out.value("status", static_cast<double>(made.outcome().status));
  out.value("steps", static_cast<double>(made.statistics().steps));
  out.value("rejected", static_cast<double>(made.statistics().rejected));
  out.value("evaluations", static_cast<double>(made.statistics().evaluations));
}

// The first orbits again, backwards, with events and with what keeps the dense output.
void print_events(const Record& out, const Run& run) {
  Problem problem = problem_of(run);
  problem.stop = -10.0 * orbit;
  problem.events = {
      {"qw", [](double, const RotorState& s) { return s.q.w; }},
      {"g2", [](double, const RotorState& s) { return s.g.y - 1.0; }, Crossing::rising}};
  const Trajectory made = integrate(problem);
  std::int64_t number = 0;
  for (const EventRecord& event : made.events()) {
    const std::string field = "event " + std::to_string(number++) + " " + event.name;
    out.value(field + ".t", event.t);
    out.value(field + ".direction", event.direction);
    out.state(field, event.s);
  }
  for (int k = 0; k <= rows; ++k)
    out.state("dense " + std::to_string(k), made.at(k * problem.stop / rows));
}

void print_transitions(const Record& out, const Run& run) {
  Problem problem = problem_of(run);
  problem.stop = 3.0 * orbit;
  for (const TransitionSample& row :
       state_transitions(problem, SaveAt::count(0.0, problem.stop, 4))) {
    out.state("transition(" + std::to_string(row.t) + ")", row.s);
    out.matrix("transition(" + std::to_string(row.t) + ")", row.transition, 6);
  }
}

}  // namespace

int main() {
  for (const Run& run : runs()) {
    const Record out(run.name);
    out.tried("run", [&] { print_run(out, run); });
    out.tried("events", [&] { print_events(out, run); });
    out.tried("transitions", [&] { print_transitions(out, run); });
  }
}
