// SPDX-License-Identifier: MIT
// What the ephemeris messages of CCSDS share, of attitudes (AEM) and of orbits (OEM): a header, and
// segments of metadata and dated rows.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tables/detail/kvn_reader.hpp"
#include "text/civil_time.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct KvnHeader {
  std::string version;
  std::string creation_date;
  std::string originator;
  std::vector<std::string> comments;
};

class KvnEphemerisReader : public KvnReader {
 public:
  // `kind` is AEM or OEM; `versions` are those that are read, and live as long as this.
  KvnEphemerisReader(std::string_view text, std::string name, std::string kind,
                     std::span<const std::string_view> versions);

  // From the first line to META_START.
  KvnHeader read_header();
  // From there to META_STOP.
  void read_metadata();
  // Of the metadata last read.
  bool has(std::string_view key) const { return metadata_.contains(key); }
  std::string needed(std::string_view key) const;
  std::string optional(std::string_view key) const;  // empty where it is not there
  std::size_t line_of(std::string_view key) const;   // 0 where it is not there
  // TIME_SYSTEM, one for the whole file.
  std::string read_time_system();
  // A date of that system.
  CivilTime date(std::string_view text, std::string_view what = "") const;
  // The date of a row, later than that of the row before in the segment, as seconds from the first
  // row of the file.
  double read_seconds(std::string_view text);

  // Throws 'got "LINE" PLACE; expected ...', PLACE as in "in the header".
  [[noreturn]] void unexpected(const KvnLine& line, std::string_view place,
                               std::string_view expected) const;
  // Throws 'KEY: got "VALUE"; expected ...'.
  [[noreturn]] void refuse(std::string_view key, std::string_view value,
                           std::string_view expected) const;

 private:
  std::string version(const KvnLine& line) const;
  [[noreturn]] void fail_first_line() const;

  std::string kind_;
  std::span<const std::string_view> versions_;
  struct Entry {
    std::string value;
    std::size_t line;
  };
  std::map<std::string, Entry, std::less<>> metadata_;
  std::string time_system_;  // of the file; empty before the first segment
  std::optional<CivilTime> origin_;
  std::optional<CivilTime> before_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
