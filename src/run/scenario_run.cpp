// SPDX-License-Identifier: MIT
#include "polhode/run/scenario_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "math/number_text.hpp"
#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "run/detail/earlier_run.hpp"
#include "run/detail/run_state.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

namespace fs = std::filesystem;
using std::chrono::duration;
using std::chrono::microseconds;
using Clock = std::chrono::steady_clock;

constexpr std::size_t events_shown = 20;
constexpr std::string_view mark = "polhode run 2";
constexpr double share = 0.05;  // of the time that checkpoints may take

std::string shown(const std::string& path) { return detail::printable(path, 500); }

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

// What a checkpoint must agree in with the run that goes on, each by its name in messages.
struct Identity {
  std::string version, columns, outputs, scenario, files, surroundings;

  std::vector<std::pair<std::string, std::string*>> parts() {
    return {{"version of polhode", &version},
            {"outputs", &outputs},
            {"columns", &columns},
            {"scenario", &scenario},
            {"files of the scenario", &files},
            {"orbits and torques", &surroundings}};
  }
};

// What acts on the body, at some times of the run: the same text and files may mean something else
// to another build.
std::string mark_of_surroundings(const Scenario& scenario) {
  const System system = at_damper_rate(rotor_system(scenario), scenario.damper_rate);
  const RotorState s = initial_state(scenario);
  const double last = (*scenario.time)[scenario.time->size() - 1];
  StateBytes bytes;
  for (int i = 0; i < 16; ++i) {
    const double t = last * (i / 15.0);
    try {
      Effect e = effect(system, t, s);
      bytes.all(e.v, e.u);
    } catch (const std::exception&) {  // the run will say so
      double none = t;
      bytes(none);
    }
  }
  return "mark " + std::to_string(fingerprint(bytes.bytes()));
}

Identity identity_of(const Scenario& scenario, const RunFiles& files) {
  Identity result;
  result.version = provenance(scenario).version;
  for (const std::string& column : scenario.columns) result.columns += column + " ";
  for (const std::string& path : files.outputs) result.outputs += file_name(path) + " ";
  if (!files.events.empty()) result.outputs += "events " + file_name(files.events);
  result.scenario = scenario.name + " " + std::to_string(scenario.text.size()) + " bytes, mark " +
                    std::to_string(fingerprint(scenario.text));
  for (const ScenarioFile& file : scenario.files)
    result.files += (result.files.empty() ? "" : "; ") + file_note(file);
  result.surroundings = mark_of_surroundings(scenario);
  return result;
}

// All that the file of a checkpoint holds.
struct Kept {
  Identity identity;
  detail::RunState state;
  std::vector<SinkPosition> positions;  // of the outputs, and of the events last
  std::vector<DampedEventRecord> events;
  std::int64_t events_met = 0;

  void transfer(StateBytes& bytes) {
    for (auto& [name, text] : identity.parts()) bytes(*text);
    state.transfer(bytes);
    std::int64_t n = static_cast<std::int64_t>(positions.size());
    bytes(n);
    positions.resize(static_cast<std::size_t>(n));
    for (SinkPosition& p : positions) bytes.all(p.bytes, p.rows);
    bytes.all(events, events_met);
  }
};

std::string text_of(Kept& kept, const std::string& told) {
  StateBytes body, head;
  kept.transfer(body);
  std::string title(mark);
  std::uint64_t hash = fingerprint(body.bytes());
  head.all(title, hash);
  return told + "\n" + head.bytes() + body.bytes();
}

Kept kept_in(const std::string& path, const BeginWords& words) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream all;
  all << file.rdbuf();
  const std::string text = all.str();
  Kept kept;
  try {
    const std::size_t line = text.find('\n');
    const std::string bytes = line == std::string::npos ? "" : text.substr(line + 1);
    StateBytes reader(bytes);
    std::string title;
    std::uint64_t hash = 0;
    reader.all(title, hash);
    if (title != mark || fingerprint(std::string_view(bytes).substr(8 + title.size() + 8)) != hash)
      throw DomainError("");
    kept.transfer(reader);
  } catch (const DomainError&) {
    throw DomainError(shown(path) +
                      ": is no checkpoint of this version of polhode, or was damaged; " +
                      words.restart + " runs the scenario anew");
  }
  return kept;
}

// When to make a checkpoint: looks at the clock after every 1 to 64 steps, and leaves most of the
// time to the run.
class Pace {
 public:
  explicit Pace(double seconds) : seconds_(std::max(seconds, 0.0)) { wait(0.0); }
  bool due() {
    if (--calls_left_ > 0) return false;
    const Clock::time_point now = Clock::now();
    if (now - looked_ < microseconds(200)) stride_ = std::min(2 * stride_, 64);
    if (now - looked_ > microseconds(2000)) stride_ = 1;
    calls_left_ = stride_;
    looked_ = now;
    return now >= next_;
  }
  void made(Clock::time_point begun) {
    wait(duration<double>(Clock::now() - begun).count() / share);
  }

 private:
  void wait(double least) {
    const duration<double> pause(std::min(std::max(seconds_, least), 1e9));
    next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(pause);
  }

  double seconds_;
  int stride_ = 1;
  int calls_left_ = 1;
  Clock::time_point looked_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace

class ScenarioRun::Parts {
 public:
  Parts(const Scenario& scenario, RunFiles files, RunOptions options)
      : scenario_(scenario),
        files_(std::move(files)),
        options_(std::move(options)),
        layout_(row_layout(scenario)),
        pace_(options_.checkpoint_seconds) {
    kept_.identity = identity_of(scenario, files_);
    find();
    if (complete_) return;
    with_remedy([&] { open(); });
  }

  RunReport run() {
    if (complete_) return complete_report();
    RunReport report;
    try {
      with_remedy([&] {
        report = detail::run_rows(scenario_, layout_, sinks_, control());
        if (report.outcome.ok() && events_) events_->finish();
      });
    } catch (const DomainError&) {
      forget();  // what a term or an orbit refuses, it would refuse again
      throw;
    }
    report.events_met = kept_.events_met;
    report.events = std::move(kept_.events);
    forget();
    return report;
  }

  bool continued_ = false;
  bool complete_ = false;
  const detail::RunState& state() const { return from_; }

 private:
  std::vector<std::string> paths() const {
    std::vector<std::string> all = files_.outputs;
    if (!files_.events.empty()) all.push_back(files_.events);
    return all;
  }
  bool are_files() const {
    const auto is_file = [](const std::string& path) {
      std::error_code ignored;
      const fs::file_status status = fs::status(path, ignored);
      return path != "-" && (!fs::exists(status) || fs::is_regular_file(status));
    };
    const std::vector<std::string> all = paths();
    return !all.empty() && std::all_of(all.begin(), all.end(), is_file);
  }

  // A disk that was full says what to do then.
  template <class F>
  void with_remedy(const F& f) const {
    detail::with_remedy(f, [&]() -> std::string {
      if (!are_files()) return {};
      if (!safe_t_) return "run it again";
      return options_.words.resume + " goes on from t = " + time_text(*safe_t_);
    });
  }

  // What earlier runs have left.
  void find() {
    if (options_.begin == RunBegin::restart) return;  // open() removes them
    const std::vector<std::string> all = paths();
    const std::string found = detail::checkpoint_among(all, options_.words);
    if (options_.begin == RunBegin::anew) {
      if (!found.empty()) refuse_to_overwrite(found);
      return;
    }
    if (!are_files())
      throw DomainError("run: resume needs outputs that are files, which a run leaves behind");
    if (!found.empty()) return take_up(found);
    complete_ = detail::are_complete(all, provenance(scenario_), options_.words);
  }

  [[noreturn]] void refuse_to_overwrite(const std::string& found) const {
    std::string line;
    std::ifstream file(found, std::ios::binary);
    std::getline(file, line);
    detail::refuse_unfinished(found, "run", line, options_.words);
  }

  void take_up(const std::string& found) {
    Kept kept = kept_in(found, options_.words);
    auto theirs = kept.identity.parts();
    auto ours = kept_.identity.parts();
    for (std::size_t i = 0; i < ours.size(); ++i)
      if (*theirs[i].second != *ours[i].second)
        throw DomainError(shown(found) + ": is of another run: " + ours[i].first + " was \"" +
                          *theirs[i].second + "\", is \"" + *ours[i].second + "\"; " +
                          options_.words.restart + " runs the scenario anew");
    kept_ = std::move(kept);
    from_ = kept_.state;
    safe_t_ = from_.t;
    continued_ = true;
  }

  void open() {
    try {
      open_files();
    } catch (const detail::FileInUse&) {
      throw;
    } catch (const DomainError& error) {
      if (!continued_) throw;
      throw DomainError(std::string(error.what()) + "; put it back, or " + options_.words.restart +
                        " runs the scenario anew");
    }
    // Now they are ours alone.
    if (options_.begin == RunBegin::restart) detail::forget_checkpoints(paths());
    if (options_.also) sinks_.push_back(std::move(options_.also));
    keeps_ = are_files();
  }

  void open_files() {
    const Provenance origin = provenance(scenario_);
    std::size_t i = 0;
    const auto position = [&]() -> std::optional<SinkPosition> {
      return continued_ ? std::optional(kept_.positions.at(i++)) : std::nullopt;
    };
    for (const std::string& path : files_.outputs)
      sinks_.push_back(open_sink(path, layout_.groups(), origin, position()));
    files_open_ = sinks_.size();
    if (!files_.events.empty()) events_.emplace(files_.events, scenario_, position());
  }

  detail::RunControl control() {
    detail::RunControl control;
    control.progress = options_.progress;
    control.event = [this](const DampedEventRecord& event) {
      if (events_) events_->push(event);
      ++kept_.events_met;
      if (options_.keep_events || kept_.events.size() < events_shown) kept_.events.push_back(event);
    };
    control.due = [this](double) {
      stopping_ = options_.stop && options_.stop();
      return stopping_ || (keeps_ && pace_.due());
    };
    control.keep = [this](const detail::RunState& state) {
      if (keeps_) keep(state);
      if (stopping_)
        throw RunInterrupted(scenario_.name + ": stopped at t = " + time_text(state.t), state.t,
                             keeps_);
    };
    if (continued_) control.from = &from_;
    return control;
  }

  std::string time_text(double t) const {
    return detail::number_text(scenario_.units.from_core(t, Dimension::time)) + " " +
           scenario_.units.time();
  }

  void keep(const detail::RunState& state) {
    const Clock::time_point begun = Clock::now();
    kept_.state = state;
    kept_.positions.clear();
    for (std::size_t i = 0; keeps_ && i < files_open_ + (events_ ? 1 : 0); ++i) {
      const auto p = i < files_open_ ? sinks_[i]->position() : events_->position();
      keeps_ = p.has_value();
      if (p) kept_.positions.push_back(*p);
    }
    if (!keeps_) return;
    const std::vector<std::string> all = paths();
    std::string told = detail::printable(scenario_.name, 200) + " at t = " + time_text(state.t) +
                       ", " + std::to_string(state.pushed) + " rows, in ";
    for (const std::string& path : all)
      told += (path == all.front() ? "" : ", ") + detail::printable(file_name(path), 200);
    const std::string checkpoint = detail::checkpoint_path(all.front());
    detail::replace_file(checkpoint, text_of(kept_, told));
    detail::sync_folder_of(checkpoint);  // before what the checkpoint of before needs is gone
    for (std::size_t i = 0; i < files_open_; ++i) sinks_[i]->kept();
    safe_t_ = state.t;
    for (std::size_t i = 1; i < all.size() && !pointed_; ++i)
      detail::point_to_checkpoint(all[i], checkpoint);
    pointed_ = true;
    pace_.made(begun);
  }

  // Nothing will go on from here.
  void forget() {
    detail::forget_checkpoints(paths());
    for (std::size_t i = 0; i < files_open_; ++i) sinks_[i]->kept();
  }

  RunReport complete_report() const {
    RunReport report;
    report.rows = scenario_.time->size();
    report.outcome.t = (*scenario_.time)[report.rows - 1];
    return report;
  }

  const Scenario& scenario_;
  RunFiles files_;
  RunOptions options_;
  RowLayout layout_;
  Pace pace_;
  Kept kept_;
  detail::RunState from_;
  std::vector<std::unique_ptr<Sink>> sinks_;
  std::size_t files_open_ = 0;
  std::optional<EventTable> events_;
  bool keeps_ = false;
  bool stopping_ = false;
  bool pointed_ = false;          // each output says where the checkpoint is
  std::optional<double> safe_t_;  // of the checkpoint
};

ScenarioRun::ScenarioRun(const Scenario& scenario, RunFiles files, RunOptions options) {
  if (!scenario.time) throw DomainError(scenario.name + ": time: got nothing; expected [time]");
  parts_ = std::make_unique<Parts>(scenario, std::move(files), std::move(options));
}
ScenarioRun::~ScenarioRun() = default;
bool ScenarioRun::continues() const { return parts_->continued_; }
bool ScenarioRun::is_complete() const { return parts_->complete_; }
double ScenarioRun::t() const { return parts_->state().t; }
std::int64_t ScenarioRun::rows() const { return parts_->state().pushed; }
RunReport ScenarioRun::run() { return parts_->run(); }

}  // namespace v0
}  // namespace polhode
