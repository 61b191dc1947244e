// SPDX-License-Identifier: MIT
#include "polhode/text/units.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "message_of.hpp"
#include "polhode/error.hpp"

namespace polhode {
namespace {

using test::message_of;

TEST(Units, CoreUnitsAreTheFilesTimeAndRadians) {
  const io::Units units("h", "deg", "kg m2");
  EXPECT_EQ(units.to_core(27.38, io::Dimension::time), 27.38);
  EXPECT_EQ(units.to_core(180.0, io::Dimension::angle), std::numbers::pi);
  EXPECT_EQ(units.to_core(180.0, io::Dimension::rate), std::numbers::pi);
  EXPECT_EQ(units.to_core(3.0, io::Dimension::momentum), 3.0);
  EXPECT_EQ(units.from_core(std::numbers::pi, io::Dimension::rate), 180.0);
}

TEST(Units, TheUnitOfTheFileChangesNoBit) {
  const io::Units units("d", "deg", "kg m2");
  const double value = 0.1 + 0.2;
  EXPECT_EQ(units.to_core(value, "d", io::Dimension::time), value);
  EXPECT_EQ(units.to_core(value, "rad", io::Dimension::angle), value);
  EXPECT_EQ(units.to_core(value, "kg m2", io::Dimension::moment), value);
  EXPECT_EQ(units.to_core(value, "kg m2/d", io::Dimension::momentum), value);
  EXPECT_EQ(units.to_core(value, "kg m2/d2", io::Dimension::energy), value);
}

TEST(Units, WholeRatiosAreRoundedOnce) {
  const io::Units units("d");
  EXPECT_EQ(units.to_core(1.0, "h", io::Dimension::time), 1.0 / 24.0);
  EXPECT_EQ(units.to_core(7.0, "s", io::Dimension::time), 7.0 / 86400.0);
  EXPECT_EQ(units.to_core(2.0, "yr", io::Dimension::time), 730.5);
  EXPECT_EQ(units.to_core(1.0, "Myr", io::Dimension::time), 365.25e6);
  EXPECT_EQ(units.to_core(1.0, "cy", io::Dimension::time), 36525.0);
}

TEST(Units, ProductsPowersAndQuotients) {
  const io::Units si("s", "rad", "kg m2");
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "rpm", io::Dimension::rate), std::numbers::pi / 30.0);
  EXPECT_DOUBLE_EQ(si.to_core(360.0, "deg/h", io::Dimension::rate), std::numbers::pi / 1800.0);
  EXPECT_DOUBLE_EQ(si.to_core(2.0, "N m s", io::Dimension::momentum), 2.0);
  EXPECT_DOUBLE_EQ(si.to_core(2.0, "kg m2 rad/s", io::Dimension::momentum), 2.0);
  EXPECT_DOUBLE_EQ(si.to_core(2.0, "N m", io::Dimension::energy), 2.0);
  EXPECT_DOUBLE_EQ(si.to_core(2.0, "J", io::Dimension::energy), 2.0);
  EXPECT_DOUBLE_EQ(si.to_core(1e7, "g cm2", io::Dimension::moment), 1.0);
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "kg km^2", io::Dimension::moment), 1e6);
  EXPECT_DOUBLE_EQ(io::Units("h").to_core(1.0, "1/s", io::Dimension::momentum), 3600.0);
}

TEST(Units, GravityTorqueAndDamping) {
  const io::Units km("s", "deg", "kg m2", "km");
  EXPECT_EQ(km.to_core(398600.4418, io::Dimension::gm), 398600.4418);
  EXPECT_EQ(km.to_core(398600.4418, "km3/s2", io::Dimension::gm), 398600.4418);
  EXPECT_DOUBLE_EQ(km.to_core(398600.4418e9, "m3/s2", io::Dimension::gm), 398600.4418);
  EXPECT_DOUBLE_EQ(io::Units("h", "rad", "1", "m").to_core(1.0, "km3/s2", io::Dimension::gm),
                   1e9 * 3600.0 * 3600.0);
  EXPECT_DOUBLE_EQ(io::Units("h").to_core(1.0, "1/s2", io::Dimension::gm), 3600.0 * 3600.0);
  EXPECT_DOUBLE_EQ(km.to_core(1.0, "R_e", io::Dimension::length), 6378.1366);
  EXPECT_DOUBLE_EQ(km.to_core(2.0, "N m", io::Dimension::torque), 2.0);
  EXPECT_DOUBLE_EQ(km.to_core(2.0, "N m s", io::Dimension::damping), 2.0);
  EXPECT_DOUBLE_EQ(km.to_core(2.0, "N m s/rad", io::Dimension::damping), 2.0);
  EXPECT_MESSAGE(
      km.to_core(1.0, "km2/s2", io::Dimension::gm),
      "\"km2/s2\" is not a unit of gravitational parameter here; expected one like km3/s2");
  EXPECT_MESSAGE(
      io::Units().to_core(1.0, "km", io::Dimension::length),
      "\"km\" is not a unit of length here; expected one like 1; set units.length = \"m\"");
}

TEST(Units, RootsOfMomentaAreWrittenAsRoots) {
  const io::Units si("s", "deg", "kg m2"), hours("h");
  EXPECT_EQ(si.label(io::Dimension::root_momentum), "sqrt(kg m2/s)");
  EXPECT_EQ(hours.label(io::Dimension::root_momentum), "sqrt(1/h)");
  EXPECT_EQ(si.to_core(0.1, io::Dimension::root_momentum), 0.1);
  EXPECT_EQ(si.from_core(0.1, io::Dimension::root_momentum), 0.1);
  EXPECT_EQ(si.to_core(0.1, "sqrt(kg m2/s)", io::Dimension::root_momentum), 0.1);
  EXPECT_EQ(hours.to_core(2.0, "sqrt(1/s)", io::Dimension::root_momentum), 120.0);
  EXPECT_DOUBLE_EQ(si.to_core(3.0, "sqrt(g m2 rad/s)", io::Dimension::root_momentum),
                   3.0 * std::sqrt(1e-3));
  for (const char* unit :
       {"kg m2/s", "sqrt(kg m2)", "sqrt()", "sqrt(", "sqrt(kg m2/s", "2 sqrt(1)"})
    EXPECT_THROW(si.to_core(1.0, unit, io::Dimension::root_momentum), DomainError) << unit;
  EXPECT_THROW(si.to_core(1.0, "sqrt(s2)", io::Dimension::time), DomainError);
  EXPECT_MESSAGE(si.to_core(1.0, "kg m2/s", io::Dimension::root_momentum),
                 "\"kg m2/s\" is not a unit of root of an angular momentum here; expected one like "
                 "sqrt(kg m2/s)");
  EXPECT_MESSAGE(hours.to_core(1.0, "sqrt(kg m2/s)", io::Dimension::root_momentum),
                 "\"sqrt(kg m2/s)\" is not a unit of root of an angular momentum here; expected "
                 "one like sqrt(1/h); set units.moment = \"kg m2\"");
}

TEST(Units, ReciprocalsAndOtherDimensionsAreRefused) {
  const io::Units units("h", "deg", "kg m2");
  EXPECT_MESSAGE(units.to_core(1.0, "1/s", io::Dimension::time),
                 "\"1/s\" is not a unit of time here; expected one like h");
  EXPECT_MESSAGE(units.to_core(1.0, "h/deg", io::Dimension::rate),
                 "\"h/deg\" is not a unit of angular rate here; expected one like deg/h");
  EXPECT_MESSAGE(
      units.to_core(1.0, "kg m2 deg/h", io::Dimension::moment),
      "\"kg m2 deg/h\" is not a unit of moment of inertia here; expected one like kg m2");
}

TEST(Units, UnknownUnitsNameTheNearest) {
  const io::Units units("h");
  const auto error = [&](const char* unit) {
    return message_of([&] { units.to_core(1.0, unit, io::Dimension::time); });
  };
  EXPECT_EQ(error("hour"), "unknown unit \"hour\"; did you mean h?");
  EXPECT_EQ(error("hours"), "unknown unit \"hours\"; did you mean h?");
  EXPECT_EQ(error("degrees/h"), "unknown unit \"degrees\"; did you mean deg?");
  EXPECT_EQ(error("mim"), "unknown unit \"mim\"; did you mean min?");
  // a multiple that is not there is no slip
  for (const char* unit : {"um", "dm", "Mm", "mPa", "kPa", "KPa", "mT", "ms", "pm", "micrometre",
                           "decimeter", "millisecond", "milliseconds", "kiloyear"})
    EXPECT_EQ(error(unit).find("did you mean"), std::string::npos) << unit << ": " << error(unit);
  EXPECT_EQ(error("nTesla"), "unknown unit \"nTesla\"; did you mean nT?");
  EXPECT_EQ(error("microtesla"), "unknown unit \"microtesla\"; did you mean uT?");
  EXPECT_EQ(error("centimeter"), "unknown unit \"centimeter\"; did you mean cm?");
  EXPECT_EQ(error("milimetre"), "unknown unit \"milimetre\"; did you mean mm?");
  EXPECT_EQ(error("minutes"), "unknown unit \"minutes\"; did you mean min?");
  EXPECT_EQ(error("metre"), "unknown unit \"metre\"; did you mean m?");
  EXPECT_EQ(error("Km"), "unknown unit \"Km\"; did you mean km?");
  EXPECT_EQ(error("Nm"), "unknown unit \"Nm\"; did you mean N m?");
  EXPECT_NE(error("fortnight").find("unknown unit \"fortnight\"; expected s, min"),
            std::string::npos);
}

TEST(Units, NothingButPlainUnitsReachesTheParser) {
  const io::Units units("s");
  for (const char* unit : {"s since 2000", "lg(re s)", "s @ 3", "60 s", "s 2", "1e300 s", "PI s",
                           "s^2^2", "(s", "", "ms", "h\n", "s^999999999", "\xc2\xb5s"})
    EXPECT_THROW(units.to_core(1.0, unit, io::Dimension::time), DomainError) << unit;
  EXPECT_THROW(units.to_core(1.0, std::string(4096, '('), io::Dimension::time), DomainError);
}

TEST(Units, FilesNameSingleUnitsOfTimeAndAngle) {
  EXPECT_MESSAGE(io::Units("1/h"), "time: \"1/h\" is not a single unit such as s, h or d");
  EXPECT_MESSAGE(io::Units("deg"), "time: \"deg\" is not a unit of time");
  EXPECT_MESSAGE(io::Units("s", "h"), "angle: \"h\" is not a unit of angle");
  EXPECT_MESSAGE(io::Units("s", "rad", "kg m"),
                 "moment: \"kg m\" is not 1 (scale-free) or a unit like kg m2");
  EXPECT_MESSAGE(io::Units("s", "rad", "1", "km2"),
                 "length: \"km2\" is not a single unit such as km, m or au");
  EXPECT_MESSAGE(io::Units("s", "rad", "1", "kg"),
                 "length: \"kg\" is not 1 (scale-free) or a unit like km");
}

TEST(Units, SmallLengthsAndPressures) {
  const io::Units si("s", "rad", "kg m2", "m");
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "mm", io::Dimension::length), 1e-3);
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "Pa", io::Dimension::pressure), 1.0);
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "GPa", io::Dimension::pressure), 1e9);
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "uT", io::Dimension::magnetic_field), 1e-6);
}

TEST(Units, OfSIAreCalledByTheirNames) {
  const io::Units si("s", "rad", "kg m2", "m");
  EXPECT_EQ(si.label(io::Dimension::pressure), "N/m2");
  EXPECT_EQ(si.label(io::Dimension::density), "kg/m3");
  EXPECT_EQ(si.label(io::Dimension::magnetic_field), "T");
  EXPECT_EQ(si.label(io::Dimension::mass), "kg");
  EXPECT_EQ(si.label(io::Dimension::magnetic_tensor), "S m4");
  EXPECT_EQ(io::Units("s", "rad", "kg m2", "km").label(io::Dimension::density), "kg m2/km5");
}

TEST(Units, AUnitThatIsMissingIsNamed) {
  const auto error = [](const io::Units& units, const char* unit, io::Dimension d) {
    return message_of([&] { units.to_core(1.0, unit, d); });
  };
  EXPECT_EQ(error(io::Units("s", "rad", "1", "km"), "kg/m3", io::Dimension::density),
            "\"kg/m3\" is not a unit of density here; expected one like 1/km5; set units.moment = "
            "\"kg m2\"");
  EXPECT_EQ(error(io::Units(), "nT", io::Dimension::magnetic_field),
            "\"nT\" is not a unit of magnetic field here; expected one like 1/(A s2); set "
            "units.moment = \"kg m2\" and units.length = \"m\"");
  EXPECT_EQ(error(io::Units(), "kg/m3", io::Dimension::time),
            "\"kg/m3\" is not a unit of time here; expected one like s");
}

TEST(Units, LabelsAreUnitsThemselves) {
  for (const io::Units& units :
       {io::Units("h", "deg", "kg m2", "km"), io::Units("d", "rev", "1", "au"), io::Units(),
        io::Units("s", "rad", "kg m2", "m")})
    for (const io::Dimension d :
         {io::Dimension::time, io::Dimension::angle, io::Dimension::rate, io::Dimension::moment,
          io::Dimension::momentum, io::Dimension::energy, io::Dimension::length, io::Dimension::gm,
          io::Dimension::torque, io::Dimension::damping, io::Dimension::mass,
          io::Dimension::density, io::Dimension::pressure, io::Dimension::magnetic_field,
          io::Dimension::magnetic_tensor})
      EXPECT_EQ(units.to_core(1.0, units.label(d), d), units.to_core(1.0, d)) << units.label(d);
}

TEST(Quantity, IsANumberAndAUnit) {
  EXPECT_EQ(io::quantity_from_text("27.38 h").value, 27.38);
  EXPECT_EQ(io::quantity_from_text("  -1e3 kg m2/s ").unit, "kg m2/s");
  EXPECT_EQ(io::quantity_from_text("+5deg").value, 5.0);
  for (const char* text :
       {"", "h", "27.38", "nan h", "inf h", "1e999 h", "+-1 h", "--1 h", "one h"})
    EXPECT_THROW(io::quantity_from_text(text), DomainError) << text;
}

TEST(Units, OfTextAreReadByAnyThread) {
  std::vector<std::thread> threads;
  std::atomic<int> right = 0;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) {
        const io::Units units("h", "deg", "kg m2", "km");
        const bool refused =
            message_of([&] { units.to_core(1.0, "furlong", io::Dimension::length); }) != "";
        right += refused && units.to_core(3600.0, "km/h", io::Dimension::speed) == 3600.0;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 200);
}

}  // namespace
}  // namespace polhode
