// SPDX-License-Identifier: MIT
// CCSDS messages in keyword = value notation: lines, and ephemeris messages (AEM, OEM).
#include "tables/detail/kvn_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "polhode/error.hpp"
#include "tables/detail/trimmed.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr std::string_view blanks = " \t\r\f\v";

}  // namespace

KvnReader::KvnReader(std::string_view text, std::string name)
    : rest_(without_mark(text)), name_(std::move(name)) {}

std::optional<KvnLine> KvnReader::next() {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = trimmed(rest_.substr(0, end), blanks);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    if (line.empty()) continue;
    const std::string_view word = line.substr(0, line.find_first_of(" \t="));
    if (word == "COMMENT")
      return KvnLine{KvnLine::Kind::comment, word, trimmed(line.substr(7), blanks)};
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos)
      return KvnLine{KvnLine::Kind::pair, trimmed(line.substr(0, equals), blanks),
                     trimmed(line.substr(equals + 1), blanks)};
    const bool upper = line.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_") == std::string::npos;
    if (upper) return KvnLine{KvnLine::Kind::word, line, {}};
    return KvnLine{KvnLine::Kind::data, {}, line};
  }
  return std::nullopt;
}

void KvnReader::fail(const std::string& text) const {
  throw DomainError(name_ + ":" + std::to_string(std::max<std::size_t>(line_, 1)) + ": " + text);
}

std::string KvnReader::value_of(const KvnLine& line) const {
  if (line.value.empty()) fail(printable(line.key) + ": got nothing; expected a value");
  return std::string(line.value);
}

std::vector<std::string_view> KvnReader::fields(const KvnLine& line) const {
  std::vector<std::string_view> parts;
  std::string_view rest = line.value;
  while (!(rest = trimmed(rest, blanks)).empty()) {
    const std::size_t end = std::min(rest.find_first_of(blanks), rest.size());
    parts.push_back(rest.substr(0, end));
    rest.remove_prefix(end);
  }
  return parts;
}

double KvnReader::number(std::string_view field, std::string_view what) const {
  const std::string_view shown = field;
  if (field.starts_with('+')) field.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
    fail(std::string(what) + ": got \"" + printable(shown) + "\"; expected a finite number");
  return value;
}

namespace {

constexpr std::string_view time_systems[] = {"UTC", "TAI", "TT", "TDB", "GPS"};

bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

KvnEphemerisReader::KvnEphemerisReader(std::string_view text, std::string name, std::string kind,
                                       std::span<const std::string_view> versions)
    : KvnReader(text, std::move(name)), kind_(std::move(kind)), versions_(versions) {}

void KvnEphemerisReader::unexpected(const KvnLine& line, std::string_view place,
                                    std::string_view expected) const {
  fail("got \"" + printable(line.key.empty() ? line.value : line.key) + "\" " + std::string(place) +
       "; expected " + std::string(expected));
}

void KvnEphemerisReader::refuse(std::string_view key, std::string_view value,
                                std::string_view expected) const {
  fail(std::string(key) + ": got \"" + printable(value) + "\"; expected " + std::string(expected));
}

void KvnEphemerisReader::fail_first_line() const {
  fail("expected CCSDS_" + kind_ + "_VERS = " + one_of(versions_) + " as the first line of an " +
       kind_);
}

std::string KvnEphemerisReader::version(const KvnLine& line) const {
  const std::string key = "CCSDS_" + kind_ + "_VERS";
  if (line.key != key) fail_first_line();
  std::string version = value_of(line);
  if (!is_one_of(version, versions_)) refuse(key, version, one_of(versions_));
  return version;
}

KvnHeader KvnEphemerisReader::read_header() {
  KvnHeader header;
  std::optional<KvnLine> line = next();
  if (!line) fail_first_line();
  header.version = version(*line);
  while ((line = next())) {
    if (line->kind == KvnLine::Kind::comment)
      header.comments.emplace_back(line->value);
    else if (line->key == "META_START")
      return header;
    else if (line->key == "CREATION_DATE")
      header.creation_date = value_of(*line);
    else if (line->key == "ORIGINATOR")
      header.originator = value_of(*line);
    else if (line->key != "MESSAGE_ID" && line->key != "CLASSIFICATION")
      unexpected(*line, "in the header", "CREATION_DATE, ORIGINATOR or META_START");
  }
  fail("the file ends before META_START");
}

void KvnEphemerisReader::read_metadata() {
  metadata_.clear();
  before_.reset();
  while (const std::optional<KvnLine> line = next()) {
    if (line->kind == KvnLine::Kind::comment) continue;
    if (line->key == "META_STOP") return;
    if (line->kind != KvnLine::Kind::pair)
      unexpected(*line, "in the metadata", "KEYWORD = value or META_STOP");
    if (!metadata_.emplace(line->key, Entry{value_of(*line), line_number()}).second)
      fail(printable(line->key) + " is there twice");
  }
  fail("the file ends before META_STOP");
}

std::string KvnEphemerisReader::needed(std::string_view key) const {
  const auto found = metadata_.find(key);
  if (found == metadata_.end()) fail("the metadata above have no " + std::string(key));
  return found->second.value;
}

std::string KvnEphemerisReader::optional(std::string_view key) const {
  const auto found = metadata_.find(key);
  return found == metadata_.end() ? std::string() : found->second.value;
}

std::size_t KvnEphemerisReader::line_of(std::string_view key) const {
  const auto found = metadata_.find(key);
  return found == metadata_.end() ? 0 : found->second.line;
}

std::string KvnEphemerisReader::read_time_system() {
  const std::string system = needed("TIME_SYSTEM");
  if (!is_one_of(system, time_systems)) refuse("TIME_SYSTEM", system, one_of(time_systems));
  if (!time_system_.empty() && system != time_system_)
    fail("TIME_SYSTEM: got " + system + "; the first segment has " + time_system_);
  return time_system_ = system;
}

CivilTime KvnEphemerisReader::date(std::string_view text, std::string_view what) const {
  const std::optional<CivilTime> time = civil_time(text, time_system_ == "UTC");
  if (!time)
    fail("got \"" + printable(text) + "\"" + std::string(what) +
         "; expected a date such as 2029-04-13T21:46:00.0");
  return *time;
}

double KvnEphemerisReader::read_seconds(std::string_view text) {
  const CivilTime time = date(text);
  if (before_ && !(time > *before_)) fail("a date not later than that of the row before");
  before_ = time;
  if (!origin_) origin_ = time;
  try {
    return seconds_between(time_system_, *origin_, time);
  } catch (const DomainError& error) {
    fail(error.what());
  }
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
