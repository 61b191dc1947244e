// SPDX-License-Identifier: MIT
// [orbit.NAME] from a series, such as Laskar's of 1988.
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "scenario/detail/history_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct Arguments : PlaceKeys, ColumnKeys {
  std::string ellipse_file, plane_file;
  double amplitude_unit;
  std::string axes;
};

constexpr std::array own_keys = {
    file_key<&Arguments::ellipse_file>(
        "ellipse_file", "The terms of e exp(i varpi), one a line: A exp(i (nu t + phi)).")
        .required()
        .example("\"ellipse.txt\""),
    file_key<&Arguments::plane_file>("plane_file", "The terms of sin(i/2) exp(i Omega).")
        .required()
        .example("\"plane.txt\""),
    columns_key<&ColumnKeys::columns, Arguments>(
        "columns",
        "What the columns of both files are, by the names that the files give them or in their "
        "order: frequency, amplitude and phase; - is a column that is not read.")
        .otherwise("[\"frequency\", \"amplitude\", \"phase\"]")
        .example("[\"-\", \"frequency\", \"amplitude\", \"phase\"]")
        .shown(),
    column_units_key<Arguments>.example("[\"1\", \"arcsec/yr\", \"1\", \"deg\"]"),
    quantity_key<&Arguments::amplitude_unit>("amplitude_unit", Dimension::number,
                                             "What one unit of the amplitudes is.")
        .otherwise("1")
        .example("1e-8")
        .positive(),
    word_key<&Arguments::axes>("axes", "ecliptic-J2000|inertial", "The axes of the elements.")
        .required()
        .example("\"ecliptic-J2000\""),
};
constexpr auto keys = polhode::io::joined(place_keys<Arguments>, own_keys);

enum Role : std::size_t { frequency, amplitude, phase };
constexpr ColumnRole roles[] = {
    {"frequency", Dimension::rate}, {"amplitude", Dimension::number}, {"phase", Dimension::angle}};

std::vector<secular::SeriesTerm> terms_of(const Arguments& a, const OrbitContext& at,
                                          std::string_view key) {
  return at.built(key, [&] {
    const DeclaredColumns columns(at, key, a, roles);
    for (const Role role : {frequency, amplitude, phase})
      if (!columns.has(role)) at.refuse("columns", "expected frequency, amplitude and phase");
    std::vector<secular::SeriesTerm> terms;
    for (std::size_t k = 0; k < columns.rows(); ++k)
      terms.push_back({columns.of(frequency)[k], a.amplitude_unit * columns.of(amplitude)[k],
                       columns.of(phase)[k]});
    return terms;
  });
}

ScenarioHistory history(const Arguments& a, const OrbitContext& at) {
  std::vector<secular::SeriesTerm> ellipse = terms_of(a, at, "ellipse_file");
  std::vector<secular::SeriesTerm> plane = terms_of(a, at, "plane_file");
  const std::size_t terms = ellipse.size() + plane.size();
  return at.built("amplitude_unit", [&]() -> ScenarioHistory {
    return {secular::OrbitHistory(secular::ElementSeries(std::move(ellipse), std::move(plane))),
            "series of " + std::to_string(terms) + " terms",
            {},
            a.axes == "inertial"};
  });
}

ScenarioOrbit made(const Arguments& a, const OrbitContext& at) {
  return positions_of(at, "ellipse_file", history(a, at), a);
}

}  // namespace

OrbitKind series_kind() {
  return history_kind<Arguments>(
      "series",
      "Elements over ages, from a series: for kind obliquity, and with gm and semi_major_axis for "
      "rotations.",
      keys, history, made,
      {{"laskar1988",
        "Laskar, J. (1988). Secular evolution of the solar system over 10 million years. Astronomy "
        "and Astrophysics 198, 341-362.",
        "orbits as a series"}});
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
