// SPDX-License-Identifier: MIT
// CCSDS messages in keyword = value notation: lines, and ephemeris messages (AEM, OEM).
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/dates.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// The lines of a CCSDS message in keyword = value notation.
struct KvnLine {
  enum class Kind { pair, word, data, comment };
  Kind kind;
  std::string_view key;    // of a pair; the word; "COMMENT"
  std::string_view value;  // of a pair or comment; all of a data line
};

class KvnReader {
 public:
  KvnReader(std::string_view text, std::string name);

  // The next line that is not blank; nothing at the end of the text.
  std::optional<KvnLine> next();
  // Throws DomainError "NAME:LINE: text".
  [[noreturn]] void fail(const std::string& text) const;
  // That of the line last read, from 1.
  std::size_t line_number() const { return line_; }
  // The value of a pair, not empty.
  std::string value_of(const KvnLine& line) const;
  // The blank-separated fields of a data line.
  std::vector<std::string_view> fields(const KvnLine& line) const;
  // A field as a finite number.
  double number(std::string_view field, std::string_view what) const;

 private:
  std::string_view rest_;
  std::string name_;
  std::size_t line_ = 0;
};

// What the ephemeris messages of CCSDS share, of attitudes (AEM) and of orbits (OEM): a header, and
// segments of metadata and dated rows.
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
}  // namespace io
}  // namespace v0
}  // namespace polhode
