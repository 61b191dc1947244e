// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>

#include "io/detail/number_text.hpp"
#include "io/detail/part_file.hpp"
#include "io/detail/values.hpp"
#include "polhode/error.hpp"
#include "polhode/io/map.hpp"
#include "polhode/io/run.hpp"
#include "polhode/io/sink.hpp"
#include "polhode/version.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::size_t longest_line = 65536;

// FNV-1a: two files that differ have different ones, for all that happens by accident.
std::string fingerprint(std::string_view text) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return std::to_string(hash);
}

std::string head_of(const ScenarioMap& map) {
  return "polhode " + std::string(version()) + " map of " + std::to_string(map.size()) +
         " cells, scenario " + fingerprint(map.scenario().text) + "\n";
}

std::string line_of(const MapCell& cell) {
  std::string line;
  char digits[detail::longest_number];
  for (const double x : cell.numbers) {
    line.append(digits, detail::write_number(digits, x));
    line += ',';
  }
  line += detail::printable(cell.failure, 1000);
  return line + "\n";
}

std::optional<MapCell> cell_of(std::string_view line, std::size_t width) {
  if (!line.ends_with('\n')) return std::nullopt;
  line.remove_suffix(1);
  MapCell cell;
  for (std::size_t i = 0; i < width; ++i) {
    const std::size_t comma = line.find(',');
    if (comma == std::string_view::npos) return std::nullopt;
    double x = 0.0;
    const auto read = std::from_chars(line.data(), line.data() + comma, x);
    if (read.ec != std::errc() || read.ptr != line.data() + comma) return std::nullopt;
    cell.numbers.push_back(x);
    line.remove_prefix(comma + 1);
  }
  cell.failure = line;
  return cell;
}

// A line with its end, shorter at the end of a file.
std::string next_line(std::FILE* file) {
  std::string line;
  for (int c = std::getc(file); c != EOF && line.size() < longest_line; c = std::getc(file)) {
    line += static_cast<char>(c);
    if (c == '\n') break;
  }
  return line;
}

}  // namespace

MapRows::MapRows(const ScenarioMap& map, const std::string& path, bool resume)
    : map_(map), path_(path.empty() ? "" : path + ".cells"), head_(head_of(map)) {
  if (path_.empty()) return;
  errno = 0;
  file_ = std::fopen(path_.c_str(), resume ? "r+b" : "w+b");
  if (file_ == nullptr && resume && errno == ENOENT) file_ = std::fopen(path_.c_str(), "w+b");
  if (file_ == nullptr) throw DomainError(detail::write_failure(path_, errno));
  try {
    read(file_);
  } catch (...) {
    std::fclose(file_);
    throw;
  }
}

MapRows::~MapRows() {
  if (file_ != nullptr) std::fclose(file_);
}

// What is whole of an earlier map; the rest of the file is cut off.
void MapRows::read(std::FILE* file) {
  std::string line = next_line(file);
  off_t whole = 0;
  if (line == head_) {
    const std::size_t width = map_.groups().back().columns.size();
    whole = static_cast<off_t>(line.size());
    while (size() < map_.size()) {
      line = next_line(file);
      std::optional<MapCell> cell = cell_of(line, width);
      if (!cell) break;
      whole += static_cast<off_t>(line.size());
      cells_.push_back(std::move(*cell));
    }
  } else if (line.ends_with('\n')) {
    throw DomainError(detail::printable(path_, path_.size()) +
                      ": is of another map, file or version of polhode; expected to go on from "
                      "this one: remove it to start anew");
  }
  if (::ftruncate(::fileno(file), whole) != 0)
    throw OutputError(detail::write_failure(path_, errno));
  std::fseek(file, 0, SEEK_END);
  if (whole == 0 && (std::fputs(head_.c_str(), file) == EOF || std::fflush(file) != 0))
    throw OutputError(detail::write_failure(path_, errno));
}

void MapRows::push(const MapCell& cell) {
  cells_.push_back(cell);
  cells_.back().failure = detail::printable(cell.failure, 1000);
  if (file_ == nullptr) return;
  errno = 0;
  if (std::fputs(line_of(cell).c_str(), file_) == EOF || std::fflush(file_) != 0)
    throw OutputError(detail::write_failure(path_, errno));
}

void MapRows::finish(std::span<const std::string> outputs) {
  std::vector<double> numbers;
  for (std::int64_t k = 0; k < size(); ++k) {
    const std::vector<double> place = map_.place(k);
    const MapCell& cell = cells_[static_cast<std::size_t>(k)];
    numbers.insert(numbers.end(), place.begin(), place.end());
    numbers.insert(numbers.end(), cell.numbers.begin(), cell.numbers.end());
  }
  for (const std::string& output : outputs) {
    const std::unique_ptr<Sink> sink =
        open_sink(output, map_.groups(), provenance(map_.scenario()));
    sink->push(numbers);
    sink->finish();
  }
  if (file_ == nullptr) return;
  std::fclose(file_);
  file_ = nullptr;
  std::remove(path_.c_str());
}

}  // namespace v0
}  // namespace polhode
