// SPDX-License-Identifier: MIT
// Any bytes are a facet shape or one DomainError of one printable line: never a crash. What is a
// shape has facets with areas, and where it is closed, a volume or a reason.
#include "polhode/tables/obj.hpp"

#include <cmath>

#include "fuzz.hpp"
#include "polhode/error.hpp"
#include "polhode/shape/mass_properties.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polhode;
  using fuzz::require;
  try {
    const shape::FacetShape shape = io::shape_from_obj(fuzz::text_of(data, size), "fuzz");
    for (const shape::Facet& facet : shape.facets()) require(facet.area > 0.0);
    if (shape.is_closed() && shape.area() > 1e-30 && shape.area() < 1e30) {
      try {
        require(shape::mass_properties(shape, 1.0).volume > 0.0);
      } catch (const DomainError& error) {
        require(std::string_view(error.what()).find("volume") != std::string_view::npos);
      }
    }
  } catch (const DomainError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("fuzz:") || message.starts_with("FacetShape:"));
    for (const char c : message) require(c >= 0x20 && c < 0x7f);
  }
  return 0;
}
