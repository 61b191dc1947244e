// SPDX-License-Identifier: MIT
// [orbit.NAME] from a series, such as Laskar's of 1988.
#include <cmath>
#include <utility>

#include "polhode/scenario/schema.hpp"
#include "scenario/detail/history_keys.hpp"
#include "scenario/kinds/orbits/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr Key keys[] = {
    orbit_gm_key,
    history_axis_key,
    history_longitude_key,
    {.path = "ellipse_file",
     .type = KeyType::text,
     .presence = Presence::required,
     .example = "\"ellipse.txt\"",
     .help = "The terms of e exp(i varpi), one a line: A exp(i (nu t + phi)).",
     .is_file = true},
    {.path = "plane_file",
     .type = KeyType::text,
     .presence = Presence::required,
     .example = "\"plane.txt\"",
     .help = "The terms of sin(i/2) exp(i Omega).",
     .is_file = true},
    {.path = "columns",
     .type = KeyType::columns,
     .fallback = "[\"frequency\", \"amplitude\", \"phase\"]",
     .example = "[\"-\", \"frequency\", \"amplitude\", \"phase\"]",
     .help = "What the columns of both files are, by the names that the files give them or in "
             "their order: frequency, amplitude and phase; - is a column that is not read.",
     .in_template = true},
    {.path = "units",
     .type = KeyType::units,
     .presence = Presence::required,
     .example = "[\"1\", \"arcsec/yr\", \"1\", \"deg\"]",
     .help = "The unit of each of these columns; \"1\" of numbers."},
    {.path = "amplitude_unit",
     .type = KeyType::number,
     .fallback = "1",
     .example = "1e-8",
     .help = "What one unit of the amplitudes is.",
     .range = Range::positive},
    {.path = "axes",
     .type = KeyType::choice,
     .presence = Presence::required,
     .allowed = "ecliptic-J2000|inertial",
     .example = "\"ecliptic-J2000\"",
     .help = "The axes of the elements."},
};

enum Role : std::size_t { frequency, amplitude, phase };
constexpr ColumnRole roles[] = {
    {"frequency", Dimension::rate}, {"amplitude", Dimension::number}, {"phase", Dimension::angle}};

std::vector<SeriesTerm> terms_of(const OrbitContext& at, std::string_view key) {
  return at.built(key, [&] {
    const DeclaredColumns columns(at, key, roles);
    for (const Role role : {frequency, amplitude, phase})
      if (!columns.has(role)) at.refuse("columns", "expected frequency, amplitude and phase");
    const double unit = at.number("amplitude_unit");
    std::vector<SeriesTerm> terms;
    for (std::size_t k = 0; k < columns.rows(); ++k)
      terms.push_back(
          {columns.of(frequency)[k], unit * columns.of(amplitude)[k], columns.of(phase)[k]});
    return terms;
  });
}

ScenarioHistory series_orbit(const OrbitContext& at) {
  std::vector<SeriesTerm> ellipse = terms_of(at, "ellipse_file");
  std::vector<SeriesTerm> plane = terms_of(at, "plane_file");
  const std::size_t terms = ellipse.size() + plane.size();
  return at.built("amplitude_unit", [&]() -> ScenarioHistory {
    return {OrbitHistory(ElementSeries(std::move(ellipse), std::move(plane))),
            "series of " + std::to_string(terms) + " terms"};
  });
}

}  // namespace

OrbitKind series_kind() {
  return {
      .name = "series",
      .help =
          "Elements over ages, from a series: for kind obliquity, and with gm and semi_major_axis "
          "for rotations.",
      .keys = {std::begin(keys), std::end(keys)},
      .citations = {{"laskar1988",
                     "Laskar, J. (1988). Secular evolution of the solar system over 10 million "
                     "years. Astronomy and Astrophysics 198, 341-362.",
                     "orbits as a series"}},
      .made =
          [](const OrbitContext& at) { return positions_of(at, "ellipse_file", series_orbit(at)); },
      .history = series_orbit};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
