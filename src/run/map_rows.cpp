// SPDX-License-Identifier: MIT
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/output/sink.hpp"
#include "polhode/run/map.hpp"
#include "polhode/run/run.hpp"
#include "polhode/trajectory/state_bytes.hpp"
#include "polhode/version.hpp"
#include "run/detail/earlier_run.hpp"
#include "text/number_text.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::size_t longest_line = 65536;
constexpr std::size_t numbers_per_block = 65536;

std::string head_of(const ScenarioMap& map) {
  std::string read = map.scenario().text;
  for (const ScenarioFile& file : map.scenario().files) read += file_note(file) + "\n";
  return "polhode " + std::string(version()) + " map of " + std::to_string(map.size()) +
         " cells, scenario " + std::to_string(fingerprint(read)) + "\n";
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

// The first output that is a file, or will be.
std::string first_file(std::span<const std::string> outputs) {
  for (const std::string& path : outputs)
    if (path != "-" && detail::part_path(path) != path) return path;
  return {};
}

std::string cells_path(std::span<const std::string> outputs) {
  const std::string file = first_file(outputs);
  return file.empty() ? file : file + ".cells";
}

}  // namespace

bool is_complete(const ScenarioMap& map, std::span<const std::string> outputs,
                 const BeginWords& words) {
  const std::string cells = cells_path(outputs);
  if (cells.empty())
    throw DomainError("map: got " + words.resume + "; expected it beside outputs that are files");
  std::error_code ignored;
  return !std::filesystem::exists(cells, ignored) &&
         detail::are_complete(outputs, provenance(map.scenario()), words);
}

MapRows::MapRows(const ScenarioMap& map, std::vector<std::string> outputs, RunBegin begin,
                 BeginWords words)
    : map_(map),
      outputs_(std::move(outputs)),
      words_(std::move(words)),
      path_(cells_path(outputs_)),
      head_(head_of(map)) {
  if (begin != RunBegin::restart) {
    const std::string run = detail::checkpoint_among(outputs_, words_);
    if (!run.empty())
      throw DomainError(detail::printable(run, 500) +
                        ": an unfinished run is there; expected another file for the map, or " +
                        words_.restart + ", which loses the run");
  }
  if (path_.empty()) {
    open_sinks();
    return;
  }
  open();
  struct stat status {};
  const bool is_new = ::fstat(::fileno(file_), &status) == 0 && status.st_size == 0;
  try {
    if (begin != RunBegin::restart) read(begin);
    open_sinks();
    if (begin != RunBegin::restart) return;
    detail::forget_checkpoints(outputs_);
    if (::ftruncate(::fileno(file_), 0) != 0) detail::fail_to_write(path_, errno);
    read(begin);
  } catch (...) {
    if (is_new) ::unlink(path_.c_str());
    std::fclose(file_);
    throw;
  }
}

MapRows::~MapRows() {
  if (file_ != nullptr) std::fclose(file_);
}

// For this process alone.
void MapRows::open() {
  const int descriptor = detail::locked_file(path_);
  file_ = ::fdopen(descriptor, "r+b");
  if (file_ != nullptr) return;
  const int error_number = errno;
  ::close(descriptor);
  detail::fail_to_write(path_, error_number);
}

// A path that cannot be written is found out before the first cell, and no other run takes it until
// the last.
void MapRows::open_sinks() {
  for (const std::string& path : outputs_)
    sinks_.push_back(path == "-" ? nullptr
                                 : open_sink(path, map_.groups(), provenance(map_.scenario())));
}

// What is whole of an earlier map; the rest of the file is cut off.
void MapRows::read(RunBegin begin) {
  std::string line = next_line(file_);
  off_t whole = 0;
  if (line == head_) {
    whole = static_cast<off_t>(line.size());
    while (size() < map_.size()) {
      std::optional<WholeCell> next = next_cell(file_, map_.width());
      if (!next) break;
      whole += next->bytes;
      cells_.push_back(std::move(next->cell));
    }
  } else if (line.ends_with('\n')) {
    throw DomainError(detail::printable(path_, 500) +
                      ": is of another map, file or version of polhode; " + words_.restart +
                      " runs this one anew");
  }
  if (begin == RunBegin::anew && size() > 0)
    detail::refuse_unfinished(path_, "map", done_text(), words_);
  if (::ftruncate(::fileno(file_), whole) != 0) detail::fail_to_write(path_, errno);
  std::fseek(file_, 0, SEEK_END);
  if (whole == 0) put(head_);
}

std::string MapRows::done_text() const {
  return std::to_string(size()) + " of " + std::to_string(map_.size()) + " cells";
}

void MapRows::put(const std::string& lines) {
  errno = 0;
  if (std::fputs(lines.c_str(), file_) == EOF || std::fflush(file_) != 0)
    detail::fail_to_write(path_, errno);
}

// What to do after a disk was full.
std::string MapRows::next_text() const {
  return are_kept() ? words_.resume + " goes on after " + done_text() : std::string();
}

void MapRows::push(const MapCell& cell) {
  MapCell kept{cell.numbers, detail::printable(cell.failure, 1000)};
  if (are_kept())
    detail::with_remedy([&] { put(lines_of(kept, map_.width())); }, [&] { return next_text(); });
  cells_.push_back(std::move(kept));
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

void MapRows::finish() {
  const auto write_outputs = [&] {
    for (std::unique_ptr<Sink>& sink : sinks_) {
      if (!sink) sink = open_sink("-", map_.groups(), provenance(map_.scenario()));
      write(*sink);
      sink->finish();
    }
  };
  detail::with_remedy(write_outputs, [&] { return next_text(); });
  if (file_ == nullptr) return;
  std::remove(path_.c_str());  // before the lock goes with fclose
  std::fclose(std::exchange(file_, nullptr));
}

}  // namespace v0
}  // namespace polhode
