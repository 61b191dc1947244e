// SPDX-License-Identifier: MIT
#include "tables/detail/kvn_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "polhode/error.hpp"
#include "tables/detail/trimmed.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
