// SPDX-License-Identifier: MIT
#include "run/detail/source.hpp"

#include "polhode/error.hpp"
#include "run/detail/machine.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

Identity identity_with_machine(const Scenario& scenario, const std::vector<ColumnGroup>& groups) {
  std::vector<std::string> columns;
  for (const ColumnGroup& group : groups) columns.push_back(group.name);
  Identity identity = identity_of(scenario, {{}, {}, columns});
  identity.insert(identity.begin(), elementary_functions());
  return identity;
}

}  // namespace

SourceWork::SourceWork(const Scenario& scenario, std::string kind,
                       const std::vector<ColumnGroup>& groups, bool any_machine)
    : name_(scenario.document.name),
      kind_(std::move(kind)),
      identity_(identity_with_machine(scenario, groups)),
      any_machine_(any_machine) {}

std::string SourceWork::stage(CellRange range,
                              const std::function<void(Archive&)>& serialize) const {
  Archive bytes;
  Identity identity = identity_;
  serialize_identity(bytes, identity);
  bytes.all(range.first, range.end, range.each);
  serialize(bytes);
  return bytes.bytes();
}

void SourceWork::begin(const std::string& stage) {
  Archive bytes(stage);
  Identity theirs;
  serialize_identity(bytes, theirs);
  if (any_machine_) take_elementary_functions(theirs, identity_);
  const std::string differs = difference(theirs, identity_);
  if (!differs.empty())
    throw DomainError(name_ + ": is not the " + kind_ + " that is run: " + differs +
                      (differs_in_elementary_functions(differs)
                           ? "; expected machines that are alike, or --any-machine "
                             "(any_machine=True from Python)"
                           : ""));
  CellRange range;
  bytes.all(range.first, range.end, range.each);
  begin_stage(range, bytes);
}

std::string SourceWork::cell(std::int64_t index, const std::function<void()>& look) const {
  return cell_(index, [&](double) { look(); });
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
