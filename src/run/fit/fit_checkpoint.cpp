// SPDX-License-Identifier: MIT
#include "polhode/run/fit_checkpoint.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/run/run.hpp"
#include "polhode/trajectory/state_bytes.hpp"
#include "run/detail/checkpoint.hpp"
#include "run/detail/output_checks.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace {

detail::KeptSetup setup_of(const Scenario& scenario, const std::vector<std::string>& paths,
                           RunBegin begin, const BeginWords& words, double seconds) {
  std::vector<std::string> files;  // what goes to standard output is written at the end
  std::ranges::copy_if(paths, std::back_inserter(files), detail::is_file);
  detail::KeptSetup setup = detail::setup_of_tables({"fit", "fits anew"}, scenario, {}, files);
  setup.begin = begin;
  setup.words = words;
  setup.seconds = seconds;
  setup.can_be_complete = false;  // files of a fit do not tell which fit they are of
  return setup;
}

}  // namespace

class FitCheckpoint::Parts {
 public:
  Parts(const Scenario& scenario, const detail::KeptSetup& setup)
      : scenario_(scenario), outputs_(setup, provenance(scenario)) {
    if (outputs_.continues()) {
      StateBytes bytes(outputs_.state());
      std::uint64_t written = 0;
      bytes(written);
      if (written != form)
        throw DomainError(detail::printable(scenario.document.name, 200) +
                          ": the checkpoint has results in the form of another build of polhode; " +
                          setup.words.restart + " " + setup.kind.again);
      journal_.serialize(bytes);
    }
    outputs_.open([](const std::string&, const std::optional<SinkPosition>&) {
      return detail::KeptOutput{[] { return SinkPosition{}; }, [] {}};
    });
    journal_.added = [this] {
      if (outputs_.is_due()) keep();
    };
  }

  void keep() {
    StateBytes bytes;
    std::uint64_t written = form;
    bytes(written);
    journal_.serialize(bytes);
    const std::string results = std::to_string(journal_.results()) + " results";
    outputs_.keep({bytes.bytes(),
                   detail::printable(scenario_.document.name, 200) + " after " + results,
                   "after " + results});
  }

  detail::KeptOutputs& outputs() { return outputs_; }
  CellJournal& journal() { return journal_; }

 private:
  // Of the results (fit/result_bytes.hpp): another one if their bytes change.
  inline static const std::uint64_t form = fingerprint("results of fits, a body with its shape");

  const Scenario& scenario_;
  CellJournal journal_;
  detail::KeptOutputs outputs_;
};

FitCheckpoint::FitCheckpoint(const Scenario& scenario, const std::vector<std::string>& outputs,
                             RunBegin begin, const BeginWords& words, double seconds)
    : parts_(
          std::make_unique<Parts>(scenario, setup_of(scenario, outputs, begin, words, seconds))) {}
FitCheckpoint::~FitCheckpoint() = default;
bool FitCheckpoint::continues() const { return parts_->outputs().continues(); }
CellJournal& FitCheckpoint::journal() { return parts_->journal(); }
std::size_t FitCheckpoint::results() const { return parts_->journal().results(); }
bool FitCheckpoint::keep() {
  if (!parts_->outputs().keeps()) return false;
  parts_->keep();
  return true;
}
void FitCheckpoint::forget() { parts_->outputs().forget(); }

}  // namespace v0
}  // namespace polhode
