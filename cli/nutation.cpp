// SPDX-License-Identifier: MIT
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/run/nutation_report.hpp"
#include "polhode/text/separated.hpp"
#include "polhode/text/units.hpp"

namespace polhode::cli {
namespace {

struct NutationCommand {
  io::NutationRequest request;
  std::string axis = "figure", part = "all", rate = "inertial";
  std::string epoch = "JD 2451545.0 TDB", obliquity, least = "1 uas", out;
};

// "23.4 deg".
double angle(const std::string& option, const std::string& text) {
  try {
    const io::Quantity q = io::quantity_from_text(text);
    const double value = io::Units("s").to_core(q.value, q.unit, io::Dimension::angle);
    if (std::isfinite(value) && value > 0.0) return value;
  } catch (const DomainError&) {
  }
  throw DomainError("nutation: " + option + ": got \"" + text +
                    "\"; expected a positive angle with its unit, such as \"23.4 deg\"");
}

io::NutationRequest completed_request(const NutationCommand& of) {
  io::NutationRequest request = of.request;
  request.axis = secular::planet_axis(of.axis).value();  // one of planet_axes
  request.part = of.part == "all" ? io::NutationPart::all : io::NutationPart::oppolzer;
  request.relative = of.rate == "relative";
  if (!of.obliquity.empty()) request.of.obliquity = angle("--obliquity", of.obliquity);
  request.of.least = angle("--least", of.least);
  try {
    request.of.T = io::julian_centuries(io::epoch_date(of.epoch));
  } catch (const DomainError& error) {
    throw DomainError("nutation: --epoch: got \"" + of.epoch + "\"; " + error.what());
  }
  try {
    io::completed(request.of);
  } catch (const DomainError& error) {
    throw DomainError(std::string("nutation: ") + error.what());
  }
  return request;
}

void show(const NutationCommand& of) {
  if (!of.out.empty() && of.out != "-" && !of.out.ends_with(".csv"))
    throw DomainError("nutation: --out: got \"" + of.out +
                      "\"; the table is written as CSV: expected a name that ends with .csv, or -");
  const io::NutationReport report = io::nutation_report(completed_request(of));
  if (!of.out.empty()) io::write_nutation_csv(report, of.out);
  if (of.out != "-") print(io::nutation_text(report));
}

}  // namespace

void add_nutation(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "nutation", "The nutation of a rigid planet as a table of coefficients (Kinoshita's theory)");
  const auto of = std::make_shared<NutationCommand>();
  io::PlanetNutation& planet = of->request.of;
  const auto one_of = [](const auto& words) {
    return CLI::IsMember(std::vector<std::string>(words.begin(), words.end()));
  };
  command->add_option("--planet", planet.planet, "earth (Moon and Sun), venus or mars (Sun)")
      ->check(one_of(io::separated(io::nutation_planets, '|')))
      ->capture_default_str();
  command->add_option("--axis", of->axis, "momentum, figure or rotation")
      ->check(one_of(secular::planet_axes))
      ->capture_default_str();
  command
      ->add_option(
          "--part", of->part,
          "all, or oppolzer: the axis less that of the momentum, whose terms are Poisson's")
      ->check(CLI::IsMember({"all", "oppolzer"}))
      ->capture_default_str();
  command
      ->add_option("--rate", of->rate,
                   "Of the axis of rotation: inertial, or relative to the moving ecliptic")
      ->check(CLI::IsMember({"inertial", "relative"}))
      ->capture_default_str();
  command->add_option("--out", of->out, "Where to write the table (.csv); - is standard output")
      ->type_name("PATH");
  command->add_option("--lines", of->request.lines, "How many terms to print")
      ->check([](const std::string& text) {
        const bool whole = !text.empty() && text.find_first_not_of("0123456789") == text.npos;
        return whole ? std::string() : "got " + text + "; expected 0, 1, 2, ...";
      })
      ->capture_default_str();
  command->add_flag(
      "--changes", of->request.changes,
      "Four columns more in the file: how fast the coefficients change, in mas a century");
  command->add_option("--epoch", of->epoch, "Date of the obliquity and the eccentricities")
      ->capture_default_str();
  command->add_option("--ellipticity", planet.ellipticity,
                      "H = (C - (A + B)/2)/C, in place of the planet's own");
  command->add_option("--triaxiality", planet.triaxiality, "(B - A)/C");
  command->add_option("--obliquity", of->obliquity, "Such as \"84381.406 arcsec\"");
  command->add_option("--satellite-mass", planet.satellite_mass,
                      "Mass of the Moon over that of the Earth");
  command->add_option("--order", planet.order, "Of the Lie transform, 1 or 2")
      ->capture_default_str();
  command->add_option("--least", of->least, "Leave out smaller terms")->capture_default_str();
  command->footer("\nExample:\n  " + full_name(*command) + " --axis momentum --out momentum.csv");
  command->callback([of] { show(*of); });
}

}  // namespace polhode::cli
