// SPDX-License-Identifier: MIT
// A state that the library does not know, a gyrostat, through the loop and the files of every run:
// stopped anywhere and continued, the files have the same bytes.
#include <gmock/gmock.h>

#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gyrostat.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/run/detail/integrated_run.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using io::detail::IntegratedEnd;
using io::detail::RowsOfMotion;
using io::detail::RowWriter;
using io::detail::RunControl;
using io::detail::RunState;
using test::Gyrostat;
using test::GyrostatState;
using ::testing::HasSubstr;

struct Stopped {};

class RunOfAnyState : public test::InTempFolder {
 protected:
  using Samples = std::span<const BasicSample<GyrostatState>>;

  RunOfAnyState() {
    // the first on the way to the first row, where none is looked for
    for (const double turned : {100.0, 300.0})
      problem_.events.push_back({"wheel", [turned](const BasicSample<GyrostatState>& at) {
                                   return at.s.wheel - turned;
                                 }});
  }

  IntegratedEnd<GyrostatState> run(const std::vector<std::unique_ptr<io::Sink>>& sinks,
                                   const RunControl& control) const {
    RowWriter writer(3, sinks, control.rows);
    const RowsOfMotion<Gyrostat> motion{problem_, rows_, write};
    auto end = io::detail::integrated_run(motion, writer, control);
    writer.finish();
    return end;
  }
  static void write(Samples samples, std::span<double> out) {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      out[3 * k] = samples[k].t;
      out[3 * k + 1] = samples[k].s.g.z;
      out[3 * k + 2] = samples[k].s.wheel;
    }
  }
  std::unique_ptr<io::Sink> opened(
      const std::string& name, const std::optional<io::SinkPosition>& from = std::nullopt) const {
    return io::open_sink(path(name), groups_, provenance_, from);
  }

  // From its bytes alone, again and again, as another process would.
  io::RunReport run_with_stops(const std::string& name, double every) {
    std::optional<RunState> kept;
    std::string motion;
    std::optional<io::SinkPosition> position;
    for (;;) {
      std::vector<std::unique_ptr<io::Sink>> sinks;
      sinks.push_back(opened(name, position));
      const double begun = kept ? kept->t : 0.0;
      const std::string from = motion;
      Archive reader(from);
      RunControl control;
      if (kept) {
        control.rows = kept->rows;
        control.motion = &reader;
      }
      control.event = [&](const io::RunEvent& event) { events_.push_back(event); };
      control.events_have_rows = true;
      control.due = [&](double t) { return t > begun + every; };
      control.keep = [&](const RunState& state, const io::detail::WriteMotion& write) {
        Archive bytes;
        write(bytes);
        kept = state;
        motion = bytes.bytes();
        position = sinks[0]->position();
        EXPECT_EQ(position.value().rows, state.rows);
        sinks[0]->kept();
        ++stops_;
        throw Stopped{};
      };
      try {
        return run(sinks, control).report;
      } catch (const Stopped&) {
      }
    }
  }

  BasicProblem<Gyrostat> problem_{Gyrostat({1.0, 1.7, 2.2}, {0.15, -0.4, 0.9}, 0.05),
                                  GyrostatState{{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}, 0.25}, 0.0,
                                  20.0, Adaptive{.tolerance = 1e-12}};
  // not at t = 0: there is a way to the first row
  const SaveAt rows_ = SaveAt::count(8.0, 20.0, 12001);
  const std::vector<io::ColumnGroup> groups_{{"t", {{"t", "s"}}},
                                             {"gyrostat", {{"g3", "kg m2/s"}, {"wheel", "rad"}}}};
  const io::Provenance provenance_{"9.9", "", "gyrostat.toml", "", {}, {}};
  std::vector<io::RunEvent> events_;
  int stops_ = 0;
};

TEST_F(RunOfAnyState, StoppedAndContinuedItsFilesHaveTheSameBytes) {
  for (const std::string extension : {".csv", ".h5"}) {
    std::vector<std::unique_ptr<io::Sink>> sinks;
    sinks.push_back(opened("whole" + extension));
    const IntegratedEnd<GyrostatState> whole = run(sinks, {});
    ASSERT_TRUE(whole.report.outcome.ok()) << whole.report.outcome.advice;
    sinks.clear();
    events_.clear();
    stops_ = 0;
    const io::RunReport stopped = run_with_stops("stopped" + extension, 3.0);
    EXPECT_EQ(stops_, 6);  // twice on the way to the first row
    EXPECT_EQ(stopped.statistics.steps, whole.report.statistics.steps);
    EXPECT_EQ(stopped.statistics.evaluations, whole.report.statistics.evaluations);
    EXPECT_EQ(text("stopped" + extension), text("whole" + extension));

    ASSERT_EQ(whole.report.events.size(), 1U);
    ASSERT_EQ(events_.size(), 1U);
    io::RunEvent met = events_[0];
    EXPECT_EQ(met.row, (std::vector<double>{met.t, io::record_of<GyrostatState>(met).s.g.z,
                                            io::record_of<GyrostatState>(met).s.wheel}));
    met.row.clear();  // which nobody asked for in the whole run
    EXPECT_EQ(met, whole.report.events[0]);
  }
  EXPECT_THAT(text("whole.csv"), HasSubstr("# units: t [s], g3 [kg m2/s], wheel [rad]\n"));
}

TEST_F(RunOfAnyState, RowsAreThoseOfIntegrate) {
  std::vector<std::unique_ptr<io::Sink>> sinks;
  std::vector<double> rows;
  class Kept : public io::Sink {
   public:
    explicit Kept(std::vector<double>& to) : to_(to) {}
    void push(std::span<const double> numbers) override {
      to_.insert(to_.end(), numbers.begin(), numbers.end());
    }
    void finish() override {}

   private:
    std::vector<double>& to_;
  };
  sinks.push_back(std::make_unique<Kept>(rows));
  const IntegratedEnd<GyrostatState> end = run(sinks, {});

  BasicProblem<Gyrostat> to_first = problem_;
  to_first.events = {};
  to_first.stop = 8.0;
  BasicProblem<Gyrostat> along = problem_;
  along.start = 8.0;
  along.initial = integrate(to_first, Keep{.samples = SaveAt::times({8.0})}).samples().back().s;
  const auto samples = integrate(along, Keep{.samples = rows_}).samples();
  std::vector<double> straight(3 * samples.size());
  write(samples, straight);
  EXPECT_EQ(rows, straight);
  ASSERT_TRUE(end.latest.has_value());
  EXPECT_EQ(end.latest->s, samples.back().s);
}

}  // namespace
}  // namespace polhode
