// SPDX-License-Identifier: MIT
// The sinks behind open_sink; `from` is where one that is there goes on.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "polhode/output/sink.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The lines of a CSV file before its rows.
std::string csv_head(const std::vector<ColumnGroup>& groups, const Provenance& provenance);
std::unique_ptr<Sink> csv_sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                               const Provenance& provenance,
                               const std::optional<SinkPosition>& from);
std::unique_ptr<Sink> hdf5_sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                                const Provenance& provenance,
                                const std::optional<SinkPosition>& from);
std::unique_ptr<Sink> aem_sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                               const Provenance& provenance,
                               const std::optional<SinkPosition>& from);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
