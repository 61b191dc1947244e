// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "io/detail/civil_time.hpp"
#include "io/detail/kvn_reader.hpp"
#include "io/detail/values.hpp"
#include "io/detail/word_list.hpp"
#include "polhode/error.hpp"
#include "polhode/io/oem.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::CivilTime;
using detail::KvnLine;

constexpr std::size_t largest_file = std::size_t{1} << 30;
constexpr std::string_view time_systems[] = {"UTC", "TAI", "TT", "TDB", "GPS"};
constexpr std::string_view versions[] = {"1.0", "2.0", "3.0"};

class OemReader {
 public:
  OemReader(std::string_view text, std::string name) : lines_(text, std::move(name)) {}
  OrbitEphemeris read();

 private:
  void read_version(const KvnLine& line);
  void read_header(const KvnLine& line);
  void read_meta();
  void read_row(const KvnLine& line);
  void skip_covariance();
  void require_rows() const;
  std::string needed(std::string_view key) const;

  detail::KvnReader lines_;
  OrbitEphemeris result_;
  std::map<std::string, std::string, std::less<>> meta_;
  std::optional<CivilTime> origin_;
  std::optional<CivilTime> before_;
};

OrbitEphemeris OemReader::read() {
  bool first = true;
  while (const std::optional<KvnLine> line = lines_.next()) {
    if (std::exchange(first, false)) {
      read_version(*line);
    } else if (line->kind == KvnLine::Kind::comment) {
      continue;
    } else if (line->key == "META_START") {
      if (!result_.segments.empty()) require_rows();
      read_meta();
    } else if (result_.segments.empty()) {
      read_header(*line);
    } else if (line->key == "COVARIANCE_START") {
      skip_covariance();
    } else if (line->kind == KvnLine::Kind::data) {
      read_row(*line);
    } else {
      lines_.fail("got \"" + detail::printable(line->key) +
                  "\" among the data; expected a row, COVARIANCE_START or META_START");
    }
  }
  if (first) lines_.fail("expected CCSDS_OEM_VERS as the first line of an OEM");
  if (result_.segments.empty()) lines_.fail("the file ends before META_START");
  require_rows();
  return std::move(result_);
}

void OemReader::read_version(const KvnLine& line) {
  if (line.key != "CCSDS_OEM_VERS")
    lines_.fail("expected CCSDS_OEM_VERS as the first line of an OEM");
  result_.version = lines_.value_of(line);
  if (std::find(std::begin(versions), std::end(versions), result_.version) == std::end(versions))
    lines_.fail("CCSDS_OEM_VERS: got \"" + detail::printable(result_.version) + "\"; expected " +
                detail::one_of(versions));
}

void OemReader::read_header(const KvnLine& line) {
  if (line.key == "CREATION_DATE")
    result_.creation_date = lines_.value_of(line);
  else if (line.key == "ORIGINATOR")
    result_.originator = lines_.value_of(line);
  else if (line.key != "MESSAGE_ID" && line.key != "CLASSIFICATION")
    lines_.fail("got \"" + detail::printable(line.key.empty() ? line.value : line.key) +
                "\" in the header; expected CREATION_DATE, ORIGINATOR or META_START");
}

std::string OemReader::needed(std::string_view key) const {
  const auto found = meta_.find(key);
  if (found == meta_.end()) lines_.fail("the metadata above have no " + std::string(key));
  return found->second;
}

void OemReader::read_meta() {
  meta_.clear();
  before_.reset();
  for (;;) {
    const std::optional<KvnLine> line = lines_.next();
    if (!line) lines_.fail("the file ends before META_STOP");
    if (line->kind == KvnLine::Kind::comment) continue;
    if (line->key == "META_STOP") break;
    if (line->kind != KvnLine::Kind::pair)
      lines_.fail("got \"" + detail::printable(line->key.empty() ? line->value : line->key) +
                  "\" in the metadata; expected KEYWORD = value or META_STOP");
    if (!meta_.emplace(line->key, lines_.value_of(*line)).second)
      lines_.fail(detail::printable(line->key) + " is there twice");
  }
  const auto either = [&](std::string_view key, std::string_view otherwise) {
    return meta_.contains(key) ? needed(key) : needed(otherwise);
  };
  OemSegment segment{.object_name = needed("OBJECT_NAME"),
                     .object_id = needed("OBJECT_ID"),
                     .center = needed("CENTER_NAME"),
                     .frame = needed("REF_FRAME"),
                     .time_system = needed("TIME_SYSTEM"),
                     .start = either("USEABLE_START_TIME", "START_TIME"),
                     .stop = either("USEABLE_STOP_TIME", "STOP_TIME"),
                     .epochs = {},
                     .t = {},
                     .position = {},
                     .velocity = {}};
  if (std::find(std::begin(time_systems), std::end(time_systems), segment.time_system) ==
      std::end(time_systems))
    lines_.fail("TIME_SYSTEM: got \"" + detail::printable(segment.time_system) + "\"; expected " +
                detail::one_of(time_systems));
  for (const std::string* date : {&segment.start, &segment.stop})
    if (!detail::civil_time(*date, segment.time_system == "UTC"))
      lines_.fail("got \"" + detail::printable(*date) +
                  "\" as start or stop; expected a date such as 2029-04-13T21:46:00.0");
  if (!result_.segments.empty() && segment.time_system != result_.segments.front().time_system)
    lines_.fail("TIME_SYSTEM: got " + segment.time_system + "; the first segment has " +
                result_.segments.front().time_system);
  result_.segments.push_back(std::move(segment));
}

void OemReader::read_row(const KvnLine& line) {
  OemSegment& segment = result_.segments.back();
  const std::vector<std::string_view> fields = lines_.fields(line);
  if (fields.size() != 7 && fields.size() != 10)
    lines_.fail("got " + std::to_string(fields.size()) +
                " fields; expected date, position and velocity (7), or with acceleration (10)");
  const std::optional<CivilTime> time = detail::civil_time(fields[0], segment.time_system == "UTC");
  if (!time)
    lines_.fail("got \"" + detail::printable(fields[0]) +
                "\"; expected a date such as 2029-04-13T21:46:00.0");
  if (before_ && !(*time > *before_)) lines_.fail("a date not later than that of the row before");
  before_ = time;
  if (!origin_) origin_ = time;
  std::array<double, 6> x{};
  for (std::size_t i = 0; i < x.size(); ++i)
    x.at(i) = lines_.number(fields[i + 1], i < 3 ? "position" : "velocity");
  segment.epochs.emplace_back(fields[0]);
  try {
    segment.t.push_back(detail::seconds_between(segment.time_system, *origin_, *time));
  } catch (const DomainError& error) {
    lines_.fail(error.what());
  }
  segment.position.push_back({x[0], x[1], x[2]});
  segment.velocity.push_back({x[3], x[4], x[5]});
}

void OemReader::skip_covariance() {
  while (const std::optional<KvnLine> line = lines_.next())
    if (line->key == "COVARIANCE_STOP") return;
  lines_.fail("the file ends before COVARIANCE_STOP");
}

void OemReader::require_rows() const {
  if (result_.segments.back().t.empty()) lines_.fail("a segment without rows");
}

}  // namespace

OrbitEphemeris oem_from_text(std::string_view text, const std::string& name) {
  return OemReader(text, detail::printable(name, name.size())).read();
}

OrbitEphemeris read_oem(const std::string& path) {
  return oem_from_text(detail::text_of_file(path, largest_file), path == "-" ? "<stdin>" : path);
}

}  // namespace v0
}  // namespace polhode
