// SPDX-License-Identifier: MIT
#include "tables/detail/kvn_ephemeris.hpp"

#include <algorithm>
#include <utility>

#include "polhode/error.hpp"
#include "text/printable.hpp"
#include "text/word_list.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
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
}  // namespace v0
}  // namespace polhode
