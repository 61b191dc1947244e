// SPDX-License-Identifier: MIT
// Any bytes are a series or one DomainError of one printable line: never a crash. What is a series
// of finite numbers is read back from its text and from its table as the same. Expressions in
// doubles, since powers of long rationals take seconds; tables in rationals.
#include <cmath>

#include "fuzz.hpp"
#include "polhode/error.hpp"
#include "polhode/series/series_text.hpp"

namespace {

using namespace polhode;
using fuzz::require;

const series::Symbols& symbols() {
  static const series::Symbols all({"e", "G", "a'"}, {"l", "g_1"}, {{"l", "G"}});
  return all;
}

template <class T>
void require_same(const series::Series<T>& a) {
  for (const series::Term<T>& term : a.terms())
    if (!std::isfinite(to_double(term.c))) return;
  require(series::series_from_text<T>(symbols(), text(a)) == a);
  require(series::series_from_csv<T>(symbols(), series::csv(a)) == a);
  require(!series::latex(a).empty());
}

template <class Read>
void read(const Read& series) {
  try {
    require_same(series());
  } catch (const DomainError& error) {
    for (const char c : std::string_view(error.what())) require(c >= 0x20 && c < 0x7f);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input = fuzz::text_of(data, size);
  read([&] { return series::series_from_text<double>(symbols(), input); });
  read([&] { return series::series_from_csv<series::Rational>(symbols(), input); });
  return 0;
}
