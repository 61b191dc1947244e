// SPDX-License-Identifier: MIT
#include <charconv>
#include <cmath>
#include <memory>
#include <string>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/run/shape_report.hpp"
#include "polhode/tables/obj.hpp"

namespace polhode::cli {
namespace {

struct ShapeOptions {
  std::string file;
  std::string density;
  std::string scale = "1 m";
  bool json = false;
  bool toml = false;
};

// "2000", or "2 g/cm3"; positive.
double quantity(const io::Units& units, const std::string& option, const std::string& text,
                io::Dimension dimension) {
  const std::string got = "shape: " + option + ": got \"" + text + "\"; ";
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    try {
      const io::Quantity q = io::quantity_from_text(text);
      value = units.to_core(q.value, q.unit, dimension);
    } catch (const DomainError& wrong) {
      throw DomainError(got + wrong.what());
    }
  }
  if (!(value > 0.0) || !std::isfinite(value))
    throw DomainError(got + "expected a positive number");
  return value;
}

shape::MassProperties properties_of(const shape::FacetShape& shape, double density,
                                    const std::string& file) {
  try {
    return shape::mass_properties(shape, density);
  } catch (const DomainError& error) {
    throw DomainError(file + ": " + error.what());
  }
}

void report_shape(const ShapeOptions& options) {
  const io::Units units("s", "rad", "kg m2", "m");
  const double density = quantity(units, "--density", options.density, io::Dimension::density);
  const double scale = quantity(units, "--scale", options.scale, io::Dimension::length);
  const shape::FacetShape file = io::read_obj(options.file);
  const shape::FacetShape shape = scale == 1.0 ? file : file.moved({}, scale);
  const shape::MassProperties properties = properties_of(shape, density, options.file);
  if (options.toml) return print(io::body_table(properties, units));
  const auto lines = io::shape_summary(shape, properties, units);
  print(options.json ? io::summary_json(lines)
                     : io::summary_table(lines) + "\n" + io::body_table(properties, units));
}

}  // namespace

void add_shape(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("shape", "Mass, moments and axes of a closed mesh of constant density");
  const auto options = std::make_shared<ShapeOptions>();
  command->add_option("FILE", options->file, "Mesh (Wavefront .obj)")->required();
  command->add_option("--density", options->density, "Density, such as 2000 (kg/m3) or \"2 g/cm3\"")
      ->required();
  command->add_option("--scale", options->scale, "What one unit of the file is, such as \"1 km\"")
      ->capture_default_str();
  command->add_flag("--json", options->json, "For programs: every digit");
  command->add_flag("--toml", options->toml, "Only the [body] table of a scenario");
  command->footer("Example:\n  " + full_name(*command) +
                  " bennu.obj --density 1190 --scale \"1 km\"");
  command->callback([options] { report_shape(*options); });
}

}  // namespace polhode::cli
