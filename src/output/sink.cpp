// SPDX-License-Identifier: MIT
#include "polhode/output/sink.hpp"

#include <filesystem>

#include "output/sinks.hpp"
#include "polhode/error.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {

std::unique_ptr<Sink> open_sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                                const Provenance& provenance,
                                const std::optional<SinkPosition>& from) {
  if (path == "-") return detail::csv_sink(path, groups, provenance, from);
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status))
    throw DomainError(detail::printable(path, path.size()) +
                      ": is a folder; expected a file to write, PATH.csv, PATH.h5 or PATH.aem");
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".h5") return detail::hdf5_sink(path, groups, provenance, from);
  if (extension == ".aem") return detail::aem_sink(path, groups, provenance, from);
  const bool device = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (extension == ".csv" || device) return detail::csv_sink(path, groups, provenance, from);
  throw DomainError(detail::printable(path, path.size()) +
                    ": the extension says what to write; expected .csv, .h5 or .aem, or - for "
                    "CSV to standard output");
}

}  // namespace v0
}  // namespace polhode
