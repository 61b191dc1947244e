// SPDX-License-Identifier: MIT
// docs/references.bib stands in the library itself.
#include "polhode/text/citation.hpp"

__asm__(".pushsection .rodata\npolhode_references:\n.incbin \"" POLHODE_REFERENCES
        "\"\n.byte 0\n.popsection\n");
extern "C" const char polhode_references[] __attribute__((visibility("hidden")));

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

// From `@type{key,` up to the brace in the first column that ends it; empty for an unknown key.
std::string_view entry_of(std::string_view key) {
  const std::string_view all(polhode_references);
  const std::size_t at = all.find("{" + std::string(key) + ",\n");
  if (at == std::string_view::npos) return {};
  const std::size_t first = all.rfind('@', at);
  return all.substr(first, all.find("\n}", at) + 3 - first);
}

// Without the field that says to us why there is no DOI. It is the last one of its entry.
std::string for_readers(std::string_view entry) {
  const std::size_t ours = entry.find("\n  nodoi");
  if (ours == std::string_view::npos) return std::string(entry);
  return std::string(entry.substr(0, entry.rfind(',', ours))) + "\n}\n";
}

// Plain text for BibTeX and LaTeX: what they would take for commands is escaped, or left out.
std::string for_latex(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("&%$#_").find(c) != std::string_view::npos) result += '\\';
    if (std::string_view("{}\\~^").find(c) == std::string_view::npos) result += c;
  }
  return result;
}

}  // namespace

std::string bibtex(const Citation& citation) {
  const std::string_view entry = entry_of(citation.key);
  if (!entry.empty()) return for_readers(entry);
  return "@misc{" + std::string(citation.key) + ",\n  howpublished = {" + for_latex(citation.text) +
         "}\n}\n";
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
