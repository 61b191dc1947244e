// SPDX-License-Identifier: MIT
// Checks before a run writes: outputs are files of their own, and the disk has room for them.
#include "run/detail/output_checks.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>
#include <variant>

#include "polhode/error.hpp"
#include "polhode/run/run.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

namespace fs = std::filesystem;

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code none;
  if (fs::equivalent(a, b, none)) return true;
  const fs::path one = fs::weakly_canonical(a, none), other = fs::weakly_canonical(b, none);
  return !one.empty() && one == other;
}

}  // namespace

bool is_file(const std::string& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  return path != "-" && (!fs::exists(status) || fs::is_regular_file(status));
}

void require_own_files(const Document& document, std::span<const std::string> paths) {
  const fs::path folder = document.folder;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!is_file(paths[i])) continue;
    const std::string path = printable(paths[i], longest_path);
    if (is_same_file(paths[i], document.path))
      throw DomainError(path + ": is the scenario itself; expected another file to write");
    for (const ScenarioFile& file : document.files)
      if (is_same_file(paths[i], folder / file.path))
        throw DomainError(path + ": is a file that the scenario reads, " +
                          printable(file.path, longest_path) + "; expected another to write");
    for (std::size_t k = 0; k < i; ++k)
      if (is_file(paths[k]) && is_same_file(paths[i], paths[k]))
        throw DomainError(path + ": is the same file as " + printable(paths[k], longest_path) +
                          "; expected another to write");
  }
}

}  // namespace detail

namespace {

std::filesystem::path folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder;
}

// What a file of an earlier run holds, which this one overwrites.
double freed(const std::string& path) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path + ".part", error);
  return error ? 0.0 : static_cast<double>(bytes);
}

double rows_left(const Scenario& scenario, std::int64_t done) {
  return static_cast<double>(row_times(scenario)->size() - done);
}

double row_numbers(const Scenario& scenario) {
  return static_cast<double>(row_width(row_groups(scenario)));
}

// As a whole number, which no double above 2^53 shows otherwise.
std::string whole(double x) {
  std::string digits = std::to_string(x);
  return digits.substr(0, digits.find('.'));
}

}  // namespace

bool may_end_early(const Scenario& scenario) {
  if (const Rotation* rotation = std::get_if<Rotation>(&scenario.experiment))
    return std::any_of(rotation->events.begin(), rotation->events.end(),
                       [](const ScenarioEvent& event) { return event.stops; });
  return has_events(scenario);
}

std::vector<DiskNeed> disk_needs(const Scenario& scenario, std::span<const std::string> outputs,
                                 std::int64_t done) {
  const double numbers = rows_left(scenario, done) * row_numbers(scenario);
  std::map<dev_t, DiskNeed> disks;
  for (const std::string& path : outputs) {
    const OutputFormat* const format = scenario.output.formats.of_extension(path);
    if (format == nullptr || format->number_bytes.least == 0 || !detail::is_file(path)) continue;
    const std::filesystem::path folder = folder_of(path);
    std::error_code error;
    const std::filesystem::space_info space = std::filesystem::space(folder, error);
    struct stat info {};
    if (error || ::stat(folder.c_str(), &info) != 0) continue;
    DiskNeed& need = disks[info.st_dev];
    if (need.paths.empty()) need.available = static_cast<double>(space.available);
    need.paths += (need.paths.empty() ? "" : ", ") + path;
    need.least += numbers * format->number_bytes.least;
    need.usual += numbers * format->number_bytes.usual;
    if (done == 0) need.available += freed(path);
  }
  std::vector<DiskNeed> all;
  for (const auto& disk : disks) all.push_back(disk.second);
  return all;
}

std::string disk_text(const Scenario& scenario, const DiskNeed& need, double bytes,
                      std::int64_t done) {
  return need.paths + ": " + whole(bytes) + " bytes needed for " +
         whole(rows_left(scenario, done)) + " rows of " + whole(row_numbers(scenario)) +
         " numbers, " + whole(need.available) + " bytes free there";
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
