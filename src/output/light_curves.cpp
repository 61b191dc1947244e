// SPDX-License-Identifier: MIT
#include "polhode/output/light_curves.hpp"

#include <string_view>

#include "output/part_file.hpp"
#include "polhode/tables/lc.hpp"
#include "polhode/tables/light_columns.hpp"

namespace polhode {
inline namespace v0 {
namespace {

void write_whole(const std::string& path, std::string_view text) {
  detail::PartFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace

void write_lc(const std::string& path, std::span<const LightCurve> curves, const Date& epoch) {
  write_whole(path, lc_text(curves, epoch));
}

void write_light_csv(const std::string& path, std::span<const LightCurve> curves,
                     std::span<const std::string> notes) {
  write_whole(path, light_csv(curves, notes));
}

}  // namespace v0
}  // namespace polhode
