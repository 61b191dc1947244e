// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <utility>

#include "polhode/run/fit.hpp"
#include "polhode/run/run.hpp"
#include "run/detail/output_checks.hpp"
#include "run/detail/sweep.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

detail::CheckpointSetup setup_of(const Scenario& scenario, const std::vector<std::string>& paths) {
  std::vector<std::string> files;  // what goes to standard output is written at the end
  std::ranges::copy_if(paths, std::back_inserter(files), detail::is_file);
  detail::CheckpointSetup setup =
      detail::setup_of_tables({"fit", "fits anew"}, scenario, {}, files);
  setup.can_be_complete = false;  // files of a fit do not tell which fit they are of
  return setup;
}

}  // namespace

// A sweep whose cells are the results of the journal; the fit itself computes them.
class FitCheckpoint::Parts final : public detail::Sweep {
 public:
  Parts(const Scenario& scenario, const std::vector<std::string>& paths, RunOptions options)
      : Sweep(scenario, setup_of(scenario, paths), {}, provenance(scenario), std::move(options)) {
    resume();
    open([](const std::string&, const std::optional<SinkPosition>&) {
      return detail::CheckpointedOutput{[] { return SinkPosition{}; }, [] {}};
    });
    journal_.added = [this] {
      if (outputs_.is_due()) keep();
    };
  }

  using Sweep::keep;
  bool keeps() const { return outputs_.keeps(); }
  void forget() { outputs_.forget(); }
  ensemble::CellJournal& journal() { return journal_; }

 private:
  void serialize(Archive& bytes) override { journal_.serialize(bytes); }
  double reached() const override { return static_cast<double>(journal_.results()); }
  detail::CheckpointPlace place() const override {
    const std::string after = "after " + std::to_string(journal_.results()) + " results";
    return {detail::printable(scenario_.document.name, 200) + " " + after, after, after};
  }

  ensemble::CellJournal journal_;
};

FitCheckpoint::FitCheckpoint(const Scenario& scenario, const std::vector<std::string>& outputs,
                             RunOptions options)
    : ResumableRun(std::make_unique<Parts>(scenario, outputs, std::move(options))) {}
FitCheckpoint::Parts& FitCheckpoint::parts() { return static_cast<Parts&>(*sweep_); }
ensemble::CellJournal& FitCheckpoint::journal() { return parts().journal(); }
bool FitCheckpoint::keep() {
  if (!parts().keeps()) return false;
  parts().keep();
  return true;
}
void FitCheckpoint::forget() { parts().forget(); }

}  // namespace io
}  // namespace v0
}  // namespace polhode
