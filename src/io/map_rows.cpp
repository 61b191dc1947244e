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
constexpr std::size_t numbers_per_block = 65536;

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

// "ROWS,FAILURE", then a line of numbers for each row.
std::string lines_of(const MapCell& cell, std::size_t width) {
  std::string lines = std::to_string(cell.numbers.size() / width) + "," + cell.failure + "\n";
  char digits[detail::longest_number];
  for (std::size_t i = 0; i < cell.numbers.size(); ++i) {
    lines.append(digits, detail::write_number(digits, cell.numbers[i]));
    lines += (i + 1) % width == 0 ? '\n' : ',';
  }
  return lines;
}

// A number up to `end`, which goes with it.
template <class T>
std::optional<T> cut_number(std::string_view& line, char end) {
  const std::size_t length = line.find(end);
  if (length == std::string_view::npos) return std::nullopt;
  T x{};
  const auto read = std::from_chars(line.data(), line.data() + length, x);
  if (read.ec != std::errc() || read.ptr != line.data() + length) return std::nullopt;
  line.remove_prefix(length + 1);
  return x;
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

struct WholeCell {
  MapCell cell;
  off_t bytes;
};

// The next cell, unless its lines are not all there.
std::optional<WholeCell> next_cell(std::FILE* file, std::size_t width) {
  std::string line = next_line(file);
  std::string_view rest(line);
  const std::optional<std::size_t> rows = cut_number<std::size_t>(rest, ',');
  if (!rows || !rest.ends_with('\n')) return std::nullopt;
  WholeCell found{{{}, std::string(rest.substr(0, rest.size() - 1))},
                  static_cast<off_t>(line.size())};
  for (std::size_t k = 0; k < *rows; ++k) {
    line = next_line(file);
    rest = line;
    for (std::size_t i = 0; i < width; ++i) {
      const std::optional<double> x = cut_number<double>(rest, i + 1 == width ? '\n' : ',');
      if (!x) return std::nullopt;
      found.cell.numbers.push_back(*x);
    }
    found.bytes += static_cast<off_t>(line.size());
  }
  return found;
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
    whole = static_cast<off_t>(line.size());
    while (size() < map_.size()) {
      std::optional<WholeCell> next = next_cell(file, map_.width());
      if (!next) break;
      whole += next->bytes;
      cells_.push_back(std::move(next->cell));
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
  if (std::fputs(lines_of(cells_.back(), map_.width()).c_str(), file_) == EOF ||
      std::fflush(file_) != 0)
    throw OutputError(detail::write_failure(path_, errno));
}

void MapRows::write(Sink& sink) const {
  const std::size_t width = map_.width();
  std::vector<double> numbers;
  for (std::int64_t k = 0; k < size(); ++k) {
    const std::vector<double> place = map_.place(k);
    const std::vector<double>& results = cells_[static_cast<std::size_t>(k)].numbers;
    for (auto row = results.begin(); row != results.end(); row += static_cast<long>(width)) {
      numbers.insert(numbers.end(), place.begin(), place.end());
      numbers.insert(numbers.end(), row, row + static_cast<long>(width));
    }
    if (numbers.size() < numbers_per_block && k + 1 < size()) continue;
    sink.push(numbers);
    numbers.clear();
  }
}

void MapRows::finish(std::span<const std::string> outputs) {
  for (const std::string& output : outputs) {
    const std::unique_ptr<Sink> sink =
        open_sink(output, map_.groups(), provenance(map_.scenario()));
    write(*sink);
    sink->finish();
  }
  if (file_ == nullptr) return;
  std::fclose(file_);
  file_ = nullptr;
  std::remove(path_.c_str());
}

}  // namespace v0
}  // namespace polhode
