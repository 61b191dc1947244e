// SPDX-License-Identifier: MIT
// What must not reach toml++ 3.3, found by the outline of TOML: strings, comments and the rest.
#include <utility>

#include "scenario/values.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr int most_dots = 250;

// What word processors and web pages write.
constexpr std::pair<std::string_view, std::string_view> lookalikes[] = {
    {"\xe2\x80\x9c", "plain quotes: \""}, {"\xe2\x80\x9d", "plain quotes: \""},
    {"\xe2\x80\x9e", "plain quotes: \""}, {"\xe2\x80\x98", "plain quotes: '"},
    {"\xe2\x80\x99", "plain quotes: '"},  {"\xe2\x88\x92", "a plain minus: -"},
    {"\xe2\x80\x93", "a plain minus: -"}, {"\xc2\xa0", "a plain blank"}};

enum class Place { outside, comment, basic, literal, long_basic, long_literal };

bool is_string(Place place) { return place != Place::outside && place != Place::comment; }
bool is_long(Place place) { return place == Place::long_basic || place == Place::long_literal; }
char quote_of(Place place) {
  return place == Place::basic || place == Place::long_basic ? '"' : '\'';
}
bool has_escapes(Place place) { return quote_of(place) == '"'; }

class Outline {
 public:
  explicit Outline(std::string_view text) : text_(text) {
    if (text_.starts_with("\xef\xbb\xbf")) take(3);
  }

  std::optional<Refusal> refusal() {
    while (at_ < text_.size()) {
      const std::string wrong = complaint(text_[at_]);
      if (!wrong.empty()) return Refusal{where_, wrong};
      step();
    }
    return std::nullopt;
  }

 private:
  std::string complaint(char c) {
    const auto byte = static_cast<unsigned char>(c);
    // TOML forbids them everywhere, and toml++ asserts that they are not in a key
    if ((byte < 0x20 && c != '\n' && c != '\r' && c != '\t') || byte == 0x7f)
      return "not TOML: got the control character " + printable({&c, 1});
    if (place_ != Place::outside) return {};
    // toml++ asks of such a character whether it is a blank, and does not know
    if (byte >= 0x80) return beyond_ascii();
    // toml++ destroys a.b.c... by recursion: a million dots would overflow the stack
    if (std::string_view(",=[]{}\n").find(c) != std::string_view::npos) dots_ = 0;
    if (c == '.' && ++dots_ > most_dots)
      return "got a key of more than 250 dots; expected a scenario";
    return {};
  }

  std::string beyond_ascii() const {
    const std::string_view rest = text_.substr(at_);
    if (at_ == 0 && (rest.starts_with("\xff\xfe") || rest.starts_with("\xfe\xff")))
      return "not TOML: got UTF-16; expected a file in UTF-8";
    for (const auto& [theirs, ours] : lookalikes)
      if (rest.starts_with(theirs))
        return "not TOML: got a typographic character outside of quotes; expected " +
               std::string(ours);
    return "not TOML: got a character beyond ASCII outside of quotes";
  }

  void step() {
    const char c = text_[at_];
    if (place_ == Place::outside) {
      open(c);
    } else if (c == '\n' && !is_long(place_)) {
      place_ = Place::outside;
      last_ = c;
      take(1);
    } else if (is_string(place_) && c == quote_of(place_)) {
      close();
    } else {
      take(is_string(place_) && has_escapes(place_) && c == '\\' && plain(at_ + 1) ? 2 : 1);
    }
  }

  void open(char c) {
    // elsewhere a quote opens nothing: toml++ reads +'x' as a broken number
    const bool begins = std::string_view("=,[{.\n").find(last_) != std::string_view::npos;
    const bool three = begins && run(c) >= 3;
    if (c != ' ' && c != '\t' && c != '\r') last_ = c;
    if (c == '#') place_ = Place::comment;
    if (!begins) {
      take(1);
      return;
    }
    if (c == '"') place_ = three ? Place::long_basic : Place::basic;
    if (c == '\'') place_ = three ? Place::long_literal : Place::literal;
    take(is_long(place_) ? 3 : 1);
  }

  // A long string may end in up to two quotes of its own before the three that close it.
  void close() {
    const std::size_t quotes = run(text_[at_]);
    const bool closes = !is_long(place_) || quotes >= 3;
    take(is_long(place_) ? quotes : 1);
    if (closes) place_ = Place::outside;
  }

  // An escaped character that is neither a line end nor one that complaint() must see.
  bool plain(std::size_t i) const {
    return i < text_.size() && text_[i] >= 0x20 && text_[i] < 0x7f;
  }
  // How many of c stand here, counted up to five: what a long string can end in.
  std::size_t run(char c) const {
    std::size_t count = 0;
    while (count < 5 && at_ + count < text_.size() && text_[at_ + count] == c) ++count;
    return count;
  }

  void take(std::size_t count) {
    for (; count > 0; --count, ++at_) {
      const auto byte = static_cast<unsigned char>(text_[at_]);
      if (byte == '\n')
        where_ = {where_.line + 1, 1};
      else if ((byte & 0xc0) != 0x80)  // a code point, as toml++ counts columns
        ++where_.column;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Position where_;
  Place place_ = Place::outside;
  char last_ = '\n';  // the last character outside of strings that is not blank
  int dots_ = 0;
};

}  // namespace

std::optional<Refusal> refusal(std::string_view text) { return Outline(text).refusal(); }

std::string hint_for(std::string_view complaint) {
  constexpr std::pair<std::string_view, std::string_view> hints[] = {
      {"could not determine value type", "text stands in quotes"},
      {"expected a comment or whitespace, saw ','", "decimals have a point, arrays brackets"},
      {"expected decimal digit, saw '.'", "a number has a digit before its point"},
      {"expected decimal digit, saw '\\n'", "a number has a digit after its point"},
      {"could not be interpreted as a value", "numbers reach up to 1e308"},
      {"saw '{'", "this looks like JSON"},
      {"expected '=', saw ':'", "a key and its value have = between them"}};
  for (const auto& [theirs, ours] : hints)
    if (complaint.find(theirs) != std::string_view::npos) return "; " + std::string(ours);
  return {};
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
